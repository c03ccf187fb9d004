// tsuya fabric: fabrics from measurements, and how good they are.

#include <algorithm>
#include <vector>

#include "command.h"

namespace tsuya::program {
namespace {

class FabricCommand final : public Command {
  public:
    explicit FabricCommand(CLI::App &program)
        : app_(*program.add_subcommand("fabric", "Make fabrics, examine them")) {
        app_.require_subcommand(1);
        app_.footer("Example:\n  tsuya fabric fit black_satin.csv -o black_satin.fabric.toml");
        for (const auto make : {make_fabric_fit, make_fabric_simulate, make_fabric_evaluate,
                                make_fabric_show, make_fabric_paper})
            commands_.push_back(make(app_));
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        const auto called = std::find_if(commands_.begin(), commands_.end(),
                                         [](const auto &command) { return command->called(); });
        return called == commands_.end() ? kWrongCall : (*called)->run(console);
    }

  private:
    CLI::App &app_;
    std::vector<std::unique_ptr<Command>> commands_{};
};

} // namespace

std::unique_ptr<Command> make_fabric(CLI::App &program) {
    return std::make_unique<FabricCommand>(program);
}

} // namespace tsuya::program
