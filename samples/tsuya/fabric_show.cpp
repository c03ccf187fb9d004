// tsuya fabric show: pictures of what a fabric reflects, and of what it is woven from.

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "command.h"
#include "tsuya/color/srgb.h"
#include "tsuya/lab/weave_picture.h"
#include "tsuya/scene/body_plot.h"
#include "tsuya/scene/lobe_plot.h"
#include "tsuya/scene/map_plot.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/picture_row.h"
#include "tsuya/scene/ring_plot.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "weave_name.h"

namespace tsuya::program {
namespace {

Image encoded(Image linear) {
    for (float &value : linear.data)
        value = static_cast<float>(srgb_encode(value));
    return linear;
}

class ShowCommand final : public Command {
  public:
    explicit ShowCommand(CLI::App &fabric)
        : app_(*fabric.add_subcommand("show", "Draw what a fabric reflects, or its weave")) {
        app_.footer(
            "Examples:\n  tsuya fabric show black_satin.fabric.toml -o lobes.svg\n"
            "  tsuya fabric show black_satin.fabric.toml --view rings --model takeda,half_vector "
            "--against all.csv -o rings.svg\n"
            "  tsuya fabric show --weave \"silk charmeuse\" -o charmeuse.png\n"
            "Views of a fabric, which need gnuplot: `lobes` in the warp, bias and weft planes, and "
            "the map of the measured views; `bodies`, the lobes in space from three sides; `map`, "
            "the measured views and the tilts of the facets; `rings`, around the normal at theta_r "
            "30 and 60 degrees.\n--weave draws the filaments close up, beside the draft of the "
            "same part of the cloth.");
        CLI::Option_group &what = *app_.add_option_group("What");
        CLI::Option *const lobes = what.add_option("fabric", fabric_, "F.fabric.toml");
        CLI::Option *const weave =
            what.add_option("--weave", weave_, "WEAVE.toml, DRAFT.wif or a preset, in its place");
        what.require_option(1);
        app_.add_option("-o,--output", output_, "PICTURE.svg or .png")->required();
        app_.add_option("--view", view_, "What is drawn of a fabric")
            ->check(CLI::IsMember({"lobes", "bodies", "map", "rings"}))
            ->capture_default_str()
            ->needs(lobes);
        app_.add_option("--model", models_, "Else the fabric's own; of `rings` several: A,B")
            ->delimiter(',')
            ->needs(lobes);
        app_.add_option("--theta-i", theta_i_deg_, "Degrees, of the light of `rings`")
            ->check(CLI::Range(0.0, 89.0))
            ->capture_default_str()
            ->needs(lobes);
        app_.add_option("--against", table_, "TABLE.csv, drawn as points")->needs(lobes);
        app_.add_option("--tilt", tilt_deg_, "Degrees that the weave is seen from the side")
            ->check(CLI::Range(0.0, 70.0))
            ->capture_default_str()
            ->needs(weave);
        app_.add_option("--across", across_mm_, "Millimetres of cloth in the picture; 0: a repeat")
            ->check(CLI::Range(0.0, 1000.0))
            ->capture_default_str()
            ->needs(weave);
        app_.add_option("--size", settings_.width, "Pixels of a side of the weave's picture")
            ->check(CLI::Range(64, 4096))
            ->capture_default_str()
            ->needs(weave);
    }

    bool called() const override { return app_.parsed(); }

    Status run(Console &console) override {
        weave_.empty() ? show_fabric() : show_weave(console);
        std::cout << output_.string() << "\n";
        return kDone;
    }

  private:
    void show_fabric() const {
        refuse_unused();
        scene::RingPlot plot{.fabric = read_fabric(fabric_), .models = models_};
        if (plot.models.empty())
            plot.models = {plot.fabric.model};
        if (!table_.empty())
            plot.against = read_reflectance_table(table_);
        plot.theta_i = theta_i_deg_ * kDegree;
        if (view_ == "lobes")
            scene::plot_lobes({plot.fabric, plot.models.front(), plot.against}, output_);
        else if (view_ == "bodies")
            scene::plot_bodies(plot.fabric, plot.models.front(), output_);
        else if (view_ == "map")
            scene::plot_maps(plot.fabric, output_);
        else
            scene::plot_rings(plot, output_);
    }

    // Options that the view does not look at.
    void refuse_unused() const {
        const auto refuse = [&](bool given, const char *option, const char *views) {
            if (given)
                throw Error({std::string(option) + " has no effect on --view " + view_, option,
                             std::string("expected with ") + views});
        };
        const bool rings = view_ == "rings", lobes = view_ == "lobes";
        refuse(!rings && models_.size() > 1, "--model with several names", "--view rings");
        refuse(view_ == "map" && !models_.empty(), "--model", "another view than map");
        refuse(!rings && !lobes && !table_.empty(), "--against", "--view lobes or rings");
        refuse(!rings && app_.count("--theta-i") > 0, "--theta-i", "--view rings");
    }

    void show_weave(Console &console) {
        const lab::Weave weave = weave_named(weave_);
        scene::prepare_output_file(output_, {".png", ".svg"});
        settings_.height = settings_.width;
        settings_.across = across_mm_ * 1e-3;
        settings_.tilt = tilt_deg_ * kDegree;
        std::ostringstream bar;
        bar << "the bar is " << std::round(lab::scale_bar(weave, settings_) * 1e9) * 1e-6 << " mm";
        scene::write_picture_row(
            weave.name,
            {{encoded(lab::weave_picture(weave, settings_, console.progress())), bar.str()},
             {encoded(lab::draft_picture(weave, settings_)), "dark: warp on the face"}},
            output_);
    }

    CLI::App &app_;
    std::filesystem::path fabric_{}, output_{}, table_{};
    std::vector<std::string> models_{};
    std::string view_ = "lobes", weave_{};
    double theta_i_deg_ = 45;
    double tilt_deg_ = 0, across_mm_ = 0;
    lab::WeavePictureSettings settings_{};
};

} // namespace

std::unique_ptr<Command> make_fabric_show(CLI::App &fabric) {
    return std::make_unique<ShowCommand>(fabric);
}

} // namespace tsuya::program
