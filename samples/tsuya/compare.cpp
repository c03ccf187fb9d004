// tsuya compare: renders under several lamps, side by side, in numbers, and as a page.

#include <iomanip>
#include <iostream>

#include "command.h"
#include "json_file.h"
#include "look_options.h"
#include "tsuya/color/compare.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/live_page.h"
#include "tsuya/color/sheet.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/picture.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

/// The differences of a picture in one dye.
struct DyedDifferences {
    std::string transport{}; ///< the file; empty where there is one alone
    std::string dye{};       ///< empty: that of the file
    std::vector<LampDifference> lamps{};
};

void print(const DyedDifferences &dyed) {
    std::cout << dyed.transport << (dyed.transport.empty() ? "" : ": ")
              << "CIEDE2000 after adaptation" << (dyed.dye.empty() ? "" : ", ") << dyed.dye << "\n"
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
    std::vector<std::filesystem::path> transports{};
    std::filesystem::path output{}, report{}, html{};
    std::vector<std::string> lamps{}, dyes{};
    std::string column{};
    bool json = false;
    int threads = 0;
    LookOptions look{};

    void options(Options &o) override {
        o.argument(&transports, "OUT.exr...", "light transport from render or tryon, one or more")
            .with_words()
            .required();
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
            .result({".png"})
            .check([this] {
                if (output.empty() && report.empty() && html.empty() && !json)
                    throw Error({"nothing is asked for", "",
                                 "expected a sheet (-o), --html, --report or --json"});
            });
        o.option("--html", &html, "PAGE.html",
                 "page that shows the pictures under any lamp, and in any dye where it was left "
                 "open; one file, which needs no network")
            .result({".html"});
        o.option("--report", &report, "FILE.json", "file for the colour differences")
            .result({".json"});
        o.flag("--json", &json, "print the colour differences as JSON");
        look.add_to(o);
        add_threads(o, threads);
        o.example("tsuya compare dress.exr --lamps D65,HP4,A -o sheet.png\n"
                  "tsuya compare dress.exr --lamps D65,A --html page.html");
        o.notes("Prints CIEDE2000 between the lamps, each picture adapted to D65 by CAT02.");
    }

    Status run(Console &console) override {
        for (const std::filesystem::path &file : {output, report, html})
            if (!file.empty())
                scene::check_output_file(file);
        std::vector<DyedDifferences> differences;
        std::string page;
        detail::run_with_threads(threads, [&] {
            const std::vector<NamedLamp> named = scene::parse_lamps(lamps, {}, column);
            for (const NamedLamp &lamp : named)
                console.warnings(lamp.warnings);
            const std::vector<PageDress> dresses = read_dresses();
            differences = compare(dresses, named, console);
            if (!html.empty())
                page = make_page(dresses, named);
        });
        const Json numbers = json_of_differences(differences);
        if (!report.empty())
            write_json(report, numbers);
        if (json)
            std::cout << numbers.text() << "\n";
        else {
            for (const DyedDifferences &dyed : differences)
                print(dyed);
            std::cout << page;
        }
        return kDone;
    }

    /// The pictures, each called as its file.
    std::vector<PageDress> read_dresses() const {
        std::vector<PageDress> dresses;
        for (const std::filesystem::path &file : transports)
            dresses.push_back({file.stem().string(), read_spectral_exr(file)});
        return dresses;
    }

    /// Writes the page. \return what to say about it
    std::string make_page(const std::vector<PageDress> &dresses,
                          const std::vector<NamedLamp> &named) const {
        PageOptions options{.title = dresses[0].name, .lamps = named, .look = look.look()};
        for (std::size_t i = 1; i < dresses.size(); ++i)
            options.title += ", " + dresses[i].name;
        for (const std::string &dye : dyes)
            options.dyes.push_back({scene::label_of(dye), parse_dye(dye)});
        const LivePage made = live_page(dresses, options);
        scene::prepare_output_file(html);
        write_file(html, made.html);
        return scene::page_summary(html, made);
    }

    /// Draws the sheet where one is asked for.
    std::vector<DyedDifferences> compare(const std::vector<PageDress> &dresses,
                                         const std::vector<NamedLamp> &named,
                                         Console &console) const {
        DisplayOptions display = look.look();
        const std::vector<std::string> rows = dyes.empty() ? std::vector<std::string>{""} : dyes;
        if (look.metered())
            display.exposure_stops = metered_stops(dresses, rows, named, display);
        std::vector<DyedDifferences> differences;
        Sheet sheet{.columns = static_cast<int>(named.size())};
        for (std::size_t i = 0; i < dresses.size(); ++i) {
            SpectralImage image = dresses[i].image;
            for (const std::string &dye : rows) {
                if (!dye.empty())
                    console.warnings(scene::show_dyes(image, {&dye, 1}));
                if (!dye.empty() || dresses.size() > 1)
                    sheet.row_labels.push_back(row_label(dresses, i, dye));
                differences.push_back(
                    {dresses.size() > 1 ? transports[i].string() : "", dye,
                     compare_lamps(image, named, {.exposure_stops = display.exposure_stops})});
                if (output.empty())
                    continue;
                for (const NamedLamp &lamp : named)
                    sheet.pictures.push_back(
                        {scene::picture_under(image, {&lamp, 1}, display), lamp.caption});
            }
        }
        if (!report.empty())
            scene::prepare_output_file(report);
        if (!output.empty()) {
            const Image drawn = draw_sheet(sheet);
            scene::prepare_output_file(output);
            write_png(output, drawn);
        }
        return differences;
    }

    static std::string row_label(const std::vector<PageDress> &dresses, std::size_t dress,
                                 const std::string &dye) {
        const std::string of_dye = scene::label_of(dye);
        if (dresses.size() == 1)
            return of_dye;
        return dresses[dress].name + (dye.empty() ? "" : ", ") + of_dye;
    }

    static double metered_stops(const std::vector<PageDress> &dresses,
                                const std::vector<std::string> &rows,
                                const std::vector<NamedLamp> &named,
                                const DisplayOptions &display) {
        scene::ExposureMeter meter(display);
        for (const PageDress &dress : dresses) {
            SpectralImage image = dress.image;
            for (const std::string &dye : rows) {
                if (!dye.empty())
                    scene::show_dyes(image, {&dye, 1});
                for (const NamedLamp &lamp : named)
                    meter.add(image, {&lamp, 1});
            }
        }
        return meter.stops();
    }

    Json json_of_differences(const std::vector<DyedDifferences> &differences) const {
        Json numbers{{"schema", "tsuya-compare 1"},
                     {"transport", transports[0].string()},
                     {"measure", "CIEDE2000"},
                     {"adaptation", to_string(CompareOptions{}.adapt)},
                     {"differences", Json::array()}};
        for (const DyedDifferences &dyed : differences)
            for (const LampDifference &d : dyed.lamps) {
                Json one{{"first", d.first}, {"second", d.second}, {"mean", d.mean},
                         {"p95", d.p95},     {"max", d.max},       {"pixels", d.pixels}};
                if (!dyed.dye.empty())
                    one["dye"] = dyed.dye;
                if (!dyed.transport.empty())
                    one["transport"] = dyed.transport;
                numbers["differences"].push_back(std::move(one));
            }
        return numbers;
    }
};

} // namespace

std::unique_ptr<Command> make_compare() { return std::make_unique<Compare>(); }

} // namespace tsuya::program
