// tsuya fabric show: pictures of what a fabric reflects, and of what it is woven from.

#include <cmath>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "command.h"
#include "look_options.h"
#include "table_input.h"
#include "tsuya/color/image_file.h"
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
#include "tsuya/sdk/model.h"
#include "weave_name.h"

namespace tsuya::program {
namespace {

Image encoded(Image linear) {
    for (float &value : linear.data)
        value = static_cast<float>(srgb_encode(value));
    return linear;
}

struct FabricShow final : Command {
    std::filesystem::path fabric{}, output{}, table{};
    std::vector<std::string> models{};
    std::string view = "lobes", weave_name{};
    std::optional<double> theta_i_deg{};
    double tilt_deg = 0, across_mm = 0;
    lab::WeavePictureSettings settings{};

    void options(Options &o) override {
        Option &of_fabric = o.argument(&fabric, "F.fabric.toml", "fabric");
        Option &of_weave = o.option("--weave", &weave_name, "WEAVE",
                                    "WEAVE.toml, DRAFT.wif or a preset, in place of a fabric")
                               .check([this] { check_weave_name(weave_name); });
        o.one_of(of_fabric, of_weave);
        o.option("-o,--output", &output, "PICTURE", "PICTURE.svg or .png")
            .required()
            .result({".svg", ".png"});
        o.option("--view", &view, "VIEW", "what is drawn of a fabric")
            .one_of({"lobes", "bodies", "map", "rings"})
            .needs(of_fabric);
        o.option("--model", &models, "A,B,...",
                 "model, several for `rings`; without it, the fabric's own")
            .with_commas()
            .one_of(model_choices())
            .needs(of_fabric)
            .check([this] {
                refuse_unless(view == "rings" || models.size() < 2, "several names have",
                              "--view rings");
                refuse_unless(view != "map" || models.empty(), "it has", "another view than map");
            });
        o.option("--theta-i", &theta_i_deg, "DEGREES",
                 "polar angle of the light of `rings`; 45 without it")
            .range(0, 89)
            .needs(of_fabric)
            .check([this] {
                refuse_unless(view == "rings" || !theta_i_deg, "it has", "--view rings");
            });
        o.option("--against", &table, "TABLE.csv", "measured reflectance, drawn as points")
            .needs(of_fabric)
            .check([this] {
                refuse_unless(view == "rings" || view == "lobes" || table.empty(), "it has",
                              "--view lobes or rings");
            });
        o.option("--tilt", &tilt_deg, "DEGREES",
                 "angle by which the view of the weave is tilted from its normal")
            .range(0, 70)
            .needs(of_weave);
        o.option("--across", &across_mm, "MM",
                 "millimetres of cloth in the picture; 0 is one repeat")
            .range(0, 1000)
            .needs(of_weave);
        o.option("--size", &settings.width, "PIXELS", "width and height of the weave's picture")
            .range(64, 4096)
            .needs(of_weave);
        o.example("tsuya fabric show black_satin.fabric.toml -o lobes.svg\n"
                  "tsuya fabric show black_satin.fabric.toml --view rings --against all.csv -o "
                  "rings.svg\n"
                  "tsuya fabric show --weave \"silk charmeuse\" -o charmeuse.png");
        o.notes(
            "Views of a fabric, which need gnuplot: `lobes` in the warp, bias and weft planes, and "
            "the map of the measured views; `bodies`, the lobes in space from three sides; `map`, "
            "the measured views and the tilts of the facets; `rings`, around the normal at theta_r "
            "30 and 60 degrees.\n--weave shows the filaments, beside the draft of the same part "
            "of the cloth.");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        weave_name.empty() ? show_fabric(console) : show_weave(console);
        std::cout << output.string() << "\n";
        return kDone;
    }

    void show_fabric(Console &console) const {
        scene::RingPlot plot{.fabric = read_fabric(fabric), .models = models};
        if (plot.models.empty())
            plot.models = {std::string(model_of(plot.fabric))};
        if (!table.empty())
            plot.against = read_single_table(table, console);
        plot.theta_i = theta_i_deg.value_or(45) * kDegree;
        if (view == "lobes")
            scene::plot_lobes({plot.fabric, plot.models.front(), plot.against}, output);
        else if (view == "bodies")
            scene::plot_bodies(plot.fabric, plot.models.front(), output);
        else if (view == "map")
            scene::plot_maps(plot.fabric, output);
        else
            scene::plot_rings(plot, output);
    }

    /// For an option that the view does not look at.
    void refuse_unless(bool rule, const std::string &what, const std::string &views) const {
        if (!rule)
            throw Error(Problem{what + " no effect on --view " + view, "", "expected " + views});
    }

    void show_weave(Console &console) {
        const lab::Weave weave = weave_named(weave_name);
        scene::prepare_output_file(output);
        check_pictures();
        settings.height = settings.width;
        settings.across = across_mm * 1e-3;
        settings.tilt = tilt_deg * kDegree;
        std::ostringstream bar;
        bar << "the bar is " << std::round(lab::scale_bar(weave, settings) * 1e9) * 1e-6 << " mm";
        scene::write_picture_row(
            weave.name,
            {{encoded(lab::weave_picture(weave, settings, console.progress())), bar.str()},
             {encoded(lab::draft_picture(weave, settings)), "dark: warp on the face"}},
            output);
    }
};

} // namespace

std::unique_ptr<Command> make_fabric_show() { return std::make_unique<FabricShow>(); }

} // namespace tsuya::program
