// tsuya compare: one render under several lamps, side by side and in numbers.

#include <iomanip>
#include <iostream>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "tsuya/color/compare.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/sheet.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/picture.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya::program {
namespace {

/// The differences of a picture in one dye.
struct DyedDifferences {
    std::string dye{}; ///< empty: that of the file
    std::vector<LampDifference> lamps{};
};

void print(const DyedDifferences &dyed) {
    std::cout << "CIEDE2000 after adaptation" << (dyed.dye.empty() ? "" : ", ") << dyed.dye << "\n"
              << std::left << std::setw(12) << "first" << std::setw(12) << "second" << std::right
              << std::setw(8) << "mean" << std::setw(8) << "p95" << std::setw(8) << "max"
              << std::setw(10) << "pixels"
              << "\n"
              << std::fixed << std::setprecision(2);
    for (const LampDifference &d : dyed.lamps)
        std::cout << std::left << std::setw(12) << d.first << std::setw(12) << d.second
                  << std::right << std::setw(8) << d.mean << std::setw(8) << d.p95 << std::setw(8)
                  << d.max << std::setw(10) << d.pixels << "\n";
}

struct Compare final : Command {
    std::filesystem::path transport{}, output{}, report{};
    std::vector<std::string> lamps{}, dyes{};
    std::string column{};
    bool json = false;
    int threads = 0;
    LookOptions look{};

    void options(Options &o) override {
        o.argument(&transport, "OUT.exr", "light transport from render or tryon").required();
        o.option("--lamps", &lamps, "A,B,...",
                 "two or more of `tsuya list lamps`, files of spectra, or a set of lamps")
            .with_commas()
            .check([this] {
                scene::check_lamps(lamps);
                if (expand_lamp_sets(lamps).size() < 2)
                    throw Error({"one lamp is named", "", "expected two or more"});
            })
            .required();
        o.option(
             "--dyes", &dyes, "A,B,...",
             "dyes in place of one that was left open, a row of the sheet each: names of `tsuya "
             "list dyes`, #rrggbb, F.csv")
            .with_commas()
            .check([this] { scene::check_dyes(dyes); });
        add_column(o, column);
        o.option("-o,--output", &output, "SHEET.png", "the pictures side by side")
            .required()
            .result({".png"});
        o.option("--report", &report, "FILE.json", "file for the colour differences")
            .result({".json"});
        o.flag("--json", &json, "print the colour differences as JSON");
        look.add_to(o);
        add_threads(o, threads);
        o.example("tsuya compare dress.exr --lamps D65,HP4,A -o sheet.png");
        o.notes("Prints CIEDE2000 between the lamps, each picture adapted to D65 by CAT02.");
    }

    Status run(Console &console) override {
        scene::check_output_file(output);
        if (!report.empty())
            scene::check_output_file(report);
        std::vector<DyedDifferences> differences;
        detail::run_with_threads(threads, [&] { differences = compare(console); });
        const Json numbers = json_of_differences(differences);
        if (!report.empty())
            write_json(report, numbers);
        if (json)
            std::cout << numbers.text() << "\n";
        else
            for (const DyedDifferences &dyed : differences)
                print(dyed);
        return kDone;
    }

    /// Draws the sheet.
    std::vector<DyedDifferences> compare(Console &console) const {
        const DisplayOptions display = look.look();
        const std::vector<NamedLamp> named = scene::parse_lamps(lamps, {}, column);
        for (const NamedLamp &lamp : named)
            console.warnings(lamp.warnings);
        SpectralImage image = read_spectral_exr(transport);
        std::vector<DyedDifferences> differences;
        Sheet sheet{.columns = static_cast<int>(named.size())};
        const std::vector<std::string> rows = dyes.empty() ? std::vector<std::string>{""} : dyes;
        for (const std::string &dye : rows) {
            if (!dye.empty()) {
                console.warnings(scene::show_dyes(image, {&dye, 1}));
                sheet.row_labels.push_back(scene::file_stem_of(dye));
            }
            differences.push_back(
                {dye, compare_lamps(image, named, {.exposure_stops = display.exposure_stops})});
            for (const NamedLamp &lamp : named)
                sheet.pictures.push_back(
                    {scene::picture_under(image, {&lamp, 1}, display), lamp.caption});
        }
        const Image drawn = draw_sheet(sheet);
        scene::prepare_output_file(output);
        if (!report.empty())
            scene::prepare_output_file(report);
        write_png(output, drawn);
        return differences;
    }

    Json json_of_differences(const std::vector<DyedDifferences> &differences) const {
        Json numbers{{"schema", "tsuya-compare 1"},
                     {"transport", transport.string()},
                     {"measure", "CIEDE2000"},
                     {"adaptation", to_string(CompareOptions{}.adapt)},
                     {"differences", Json::array()}};
        for (const DyedDifferences &dyed : differences)
            for (const LampDifference &d : dyed.lamps) {
                Json one{{"first", d.first}, {"second", d.second}, {"mean", d.mean},
                         {"p95", d.p95},     {"max", d.max},       {"pixels", d.pixels}};
                if (!dyed.dye.empty())
                    one["dye"] = dyed.dye;
                numbers["differences"].push_back(std::move(one));
            }
        return numbers;
    }
};

} // namespace

std::unique_ptr<Command> make_compare() { return std::make_unique<Compare>(); }

} // namespace tsuya::program
