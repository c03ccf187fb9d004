// tsuya relight: a picture under a lamp, from one render.

#include <iostream>

#include "command.h"
#include "look_options.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/shown_picture.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
#include "tsuya/scene/picture.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"

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
        o.option("-o,--output", &output, "OUT.png",
                 "the picture; .png, .tif, .jpg, or .exr: linear light of Rec. 709, adapted and "
                 "exposed, without a view")
            .required()
            .result({".png", ".tif", ".tiff", ".jpg", ".jpeg", ".exr"})
            .check([this] {
                if (output.extension() != ".exr")
                    check_picture_file(output, file_options());
            });
        Option &depth =
            o.option("--bits", &bits, "N", "bits of a sample, 16 for PNG and TIFF alone");
        depth.one_of({"8", "16"}).check([this, &depth] {
            if (depth.given && output.extension() == ".exr")
                throw Error({"an EXR has 32 bits a sample", "", "expected no --bits beside it"});
        });
        look.add_to(o);
        add_threads(o, threads);
        o.example("tsuya relight dress.exr --lamp key=A --lamp fill=0.5*D65 -o dress.png");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        look.check();
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
            write(image, scene::lighting_of_picture(image, named), display);
        });
        std::cout << output.string() << "\n";
        return kDone;
    }
    PictureFileOptions file_options() const {
        return {.bits = bits, .display = look.look().config.empty() ? look.display : ""};
    }

    void write(const SpectralImage &image, const Lighting &lighting,
               const DisplayOptions &display) const {
        if (output.extension() == ".exr") {
            const Image linear = linear_picture(image, lighting, display);
            scene::prepare_output_file(output);
            return write_exr(output, linear, {.primaries = kRec709});
        }
        check_picture_file(output, file_options(), image.alpha.has_value());
        const Image picture = shown_picture(image, lighting, display);
        scene::prepare_output_file(output);
        write_picture(output, picture, file_options());
    }
};

} // namespace

std::unique_ptr<Command> make_relight() { return std::make_unique<Relight>(); }

} // namespace tsuya::program
