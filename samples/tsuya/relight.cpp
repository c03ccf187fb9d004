// tsuya relight: a picture under a lamp, from one render.

#include <iostream>

#include "command.h"
#include "look_options.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/relight.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/picture.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya::program {
namespace {

struct Relight final : Command {
    std::filesystem::path transport{}, output{};
    std::vector<std::string> lamps{}, dyes{};
    std::string column{};
    int bits = 8, threads = 0;
    LookOptions look{};

    void options(Options &o) override {
        o.argument(&transport, "OUT.exr", "light transport from render or tryon").required();
        o.option("--lamp", &lamps, "LAMP",
                 "name of `tsuya list lamps`, a file of spectra or a mixture such as "
                 "0.7*A+0.3*D65, for all light groups, or `own`: each has the lamp that its scene "
                 "or studio gave it; GROUP=LAMP for one of them; may be repeated")
            .check([this] { scene::check_group_or_own_lamps(lamps); })
            .required();
        o.option(
            "--dye", &dyes, "DYE",
            "another dye where it was left open: a name of `tsuya list dyes`, #rrggbb or F.csv; "
            "FABRIC=DYE where several are open; may be repeated");
        add_column(o, column);
        o.option("-o,--output", &output, "OUT.png", "the picture").required().result({".png"});
        o.option("--bits", &bits, "N", "bits of a sample of the PNG").one_of({"8", "16"});
        look.add_to(o);
        add_threads(o, threads);
        o.example("tsuya relight dress.exr --lamp key=A --lamp fill=0.5*D65 -o dress.png");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        DisplayOptions display = look.look();
        detail::run_with_threads(threads, [&] {
            SpectralImage image = read_spectral_exr(transport);
            console.warnings(scene::show_dyes(image, dyes));
            const std::vector<NamedLamp> named =
                scene::parse_group_or_own_lamps(lamps, image, column);
            for (const NamedLamp &lamp : named)
                console.warnings(lamp.warnings);
            if (look.metered()) {
                scene::ExposureMeter meter(display);
                meter.add(image, named);
                display.exposure_stops = meter.stops();
            }
            const Image picture = scene::picture_under(image, named, display);
            scene::prepare_output_file(output);
            write_png(output, picture, bits);
        });
        std::cout << output.string() << "\n";
        return kDone;
    }
};

} // namespace

std::unique_ptr<Command> make_relight() { return std::make_unique<Relight>(); }

} // namespace tsuya::program
