// tsuya aovs: the AOVs of a render as pictures on a sheet.

#include <algorithm>
#include <iostream>

#include "command.h"
#include "look_options.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/sheet.h"
#include "tsuya/scene/aov_picture.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya::program {
namespace {

struct Aovs final : Command {
    std::filesystem::path transport{}, output{};
    std::string lamp = "D65";
    int columns = 4, threads = 0;

    void options(Options &o) override {
        o.argument(&transport, "OUT.exr", "light transport with AOVs, from render --aov")
            .required();
        o.option("-o,--output", &output, "SHEET.png", "the pictures side by side")
            .required()
            .result({".png"});
        o.option("--lamp", &lamp, "LAMP",
                 "lamp of the parts of the light and of the albedo: name of `tsuya list lamps`, "
                 "or F.csv")
            .check([this] { scene::check_lamps({{lamp}}); });
        o.option("--columns", &columns, "N", "pictures in a row").range(1, 100);
        add_threads(o, threads);
        o.example("tsuya aovs dress.exr -o aovs.png");
    }

    Status run(Console &) override {
        scene::check_output_file(output);
        detail::run_with_threads(threads, [&] { draw(); });
        std::cout << output.string() << "\n";
        return kDone;
    }

    void draw() const {
        const std::vector<NamedLamp> named = scene::parse_lamps({{lamp}});
        const SpectralImage image = read_spectral_exr(transport);
        if (image.aovs.empty())
            throw Error({"the picture has no AOVs", transport.string(),
                         "expected one of `tsuya render --aov`"});
        Sheet sheet{.columns = columns};
        for (std::size_t i = 0; i < image.aovs.size(); ++i)
            sheet.pictures.push_back(
                {scene::aov_picture(image, i, named.front()), image.aov_names[i]});
        const Image drawn = draw_sheet(sheet);
        scene::prepare_output_file(output);
        write_png(output, drawn);
    }
};

} // namespace

std::unique_ptr<Command> make_aovs() { return std::make_unique<Aovs>(); }

} // namespace tsuya::program
