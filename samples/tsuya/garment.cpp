#include "command.h"
namespace tsuya::program {
class Stub_garment final : public Command {
  public:
    bool called() const override { return false; }
    Status run(Console &) override { return kDone; }
};
std::unique_ptr<Command> make_garment(CLI::App &) { return std::make_unique<Stub_garment>(); }
} // namespace tsuya::program
