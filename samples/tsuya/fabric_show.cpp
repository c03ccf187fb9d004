// tsuya fabric show: pictures of what a fabric reflects.

#include <iostream>

#include "command.h"
#include "tsuya/scene/lobe_plot.h"

namespace tsuya::program {
namespace {

class ShowCommand final : public Command {
  public:
    explicit ShowCommand(CLI::App &fabric)
        : app_(*fabric.add_subcommand("show", "Draw what a fabric reflects")) {
        app_.footer("Example:\n  tsuya fabric show black_satin.fabric.toml -o lobes.svg\n"
                    "Draws the lobes in the warp, bias and weft planes, and the map of the "
                    "measured views. Needs gnuplot.");
        app_.add_option("fabric", fabric_, "F.fabric.toml")->required();
        app_.add_option("-o,--output", output_, "PLOT.svg or .png")->required();
        app_.add_option("--model", model_, "Of the curves")->capture_default_str();
        app_.add_option("--against", table_, "TABLE.csv, drawn as points");
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &) override {
        scene::LobePlot plot{.fabric = read_fabric(fabric_), .model = model_};
        if (!table_.empty())
            plot.against = read_reflectance_table(table_);
        scene::plot_lobes(plot, output_);
        std::cout << output_.string() << "\n";
        return kDone;
    }

  private:
    CLI::App &app_;
    std::filesystem::path fabric_{}, output_{}, table_{};
    std::string model_ = "takeda";
};

} // namespace

std::unique_ptr<Command> make_fabric_show(CLI::App &fabric) {
    return std::make_unique<ShowCommand>(fabric);
}

} // namespace tsuya::program
