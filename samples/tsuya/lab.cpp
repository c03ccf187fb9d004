#include "command.h"
namespace tsuya::program {
class Stub_lab final : public Command {
  public:
    bool called() const override { return false; }
    Status run(Console &) override { return kDone; }
};
std::unique_ptr<Command> make_lab(CLI::App &) { return std::make_unique<Stub_lab>(); }
} // namespace tsuya::program
