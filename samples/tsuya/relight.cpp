#include "command.h"
namespace tsuya::program {
class Stub_relight final : public Command {
  public:
    bool called() const override { return false; }
    Status run(Console &) override { return kDone; }
};
std::unique_ptr<Command> make_relight(CLI::App &) { return std::make_unique<Stub_relight>(); }
} // namespace tsuya::program
