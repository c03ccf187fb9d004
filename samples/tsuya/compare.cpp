// tsuya compare: renders under several lamps, side by side, in numbers, and as a page.

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <set>

#include "command.h"
#include "compare_report.h"
#include "json_file.h"
#include "look_options.h"
#include "same_file.h"
#include "tsuya/color/adaptation.h"
#include "tsuya/color/color_report.h"
#include "tsuya/color/compare.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/live_page.h"
#include "tsuya/color/palette.h"
#include "tsuya/color/sheet.h"
#include "tsuya/scene/compare_sheet.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/scene/own_lamps.h"
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
    Compare() { look.exposure = "metered"; }

    std::vector<std::filesystem::path> transports{};
    std::filesystem::path output{}, report{}, html{};
    std::vector<std::string> lamps{}, dyes{};
    std::string column{};
    bool json = false;
    int threads = 0, observer = 10;
    LookOptions look{};

    void options(Options &o) override {
        o.argument(&transports, "OUT.exr...", "light transport from render or tryon, one or more")
            .with_words()
            .required()
            .check([this] { check_transports(); });
        o.option(
             "--lamps", &lamps, "A,B,...",
             "two or more of `tsuya list lamps`, files of spectra, a set of lamps, or `own`: each "
             "light group has the lamp that its scene or studio gave it; the first is the "
             "reference")
            .with_commas()
            .check([this] {
                scene::check_picture_lamps(lamps);
                if (expand_lamp_sets(lamps).size() < 2)
                    throw Error({"one lamp is named", "", "expected two or more"});
            })
            .required();
        o.option(
             "--dyes", &dyes, "A,B,...",
             "dyes in place of one that was left open, a row of the sheet each: names of `tsuya "
             "list dyes`, #rrggbb, F.csv, or F.csv:* for all that are in a file")
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
        o.option(
             "--report", &report, "FILE.json",
             "report of each fabric and panel: colour, difference and inconstancy between lamps, "
             "match and metamerism of cloths; .json, .csv or .txt")
            .result({".json", ".csv", ".txt"});
        o.option("--observer", &observer, "DEG",
                 "standard observer of the differences that are printed; a report has both")
            .one_of({"2", "10"});
        o.flag("--json", &json, "print the colour differences as JSON");
        look.add_to(o, false);
        add_threads(o, threads);
        o.example("tsuya compare dress.exr --lamps D65,HP4,A -o sheet.png\n"
                  "tsuya compare dress.exr --lamps D65,A --html page.html");
        o.notes(
            "Prints CIEDE2000 between the lamps, each picture adapted to D65 by CAT02. Pictures "
            "are for 2 degrees, as displays are. L* = 100 of all figures is Y = 1, after as many "
            "stops as --exposure gives; a metered exposure is for the pictures of the sheet "
            "alone.");
    }

    Status run(Console &console) override {
        for (const std::filesystem::path &file : {output, report, html})
            if (!file.empty())
                scene::check_output_file(file);
        look.check();
        dyes = expand_palettes(dyes);
        scene::check_dyes(dyes);
        std::vector<DyedDifferences> differences;
        std::string page;
        ColorReport colours;
        double out_of_gamut = 0;
        detail::run_with_threads(threads, [&] {
            const std::vector<NamedLamp> named = scene::parse_picture_lamps(lamps, {}, column);
            for (const NamedLamp &lamp : named)
                console.warnings(lamp.warnings);
            const std::vector<PageDress> dresses = read_dresses();
            differences = compare(dresses, named, console);
            if (!report.empty() || json || !output.empty())
                colours = report_on(dresses, named);
            if (!output.empty())
                out_of_gamut = draw(dresses, named, colours);
            if (!html.empty())
                page = make_page(dresses, named);
        });
        Json numbers = json_of_differences(differences);
        numbers.update(json_of_report(colours));
        if (!report.empty())
            write_report(colours, numbers);
        if (json)
            std::cout << numbers.text() << "\n";
        else {
            for (const DyedDifferences &dyed : differences)
                if (!dyed.lamps.empty())
                    print(dyed);
            if (!output.empty())
                std::cout << output.string() << ": at most " << 100 * out_of_gamut
                          << " % of the garment's pixels are out of the gamut of sRGB\n";
            std::cout << page;
        }
        return kDone;
    }

    void write_report(const ColorReport &colours, const Json &numbers) const {
        scene::prepare_output_file(report);
        const std::string ending = report.extension().string();
        if (ending == ".csv")
            write_file(report, csv_of(colours));
        else if (ending == ".txt")
            write_file(report, text_of(colours));
        else
            write_json(report, numbers);
    }

    Observer eye() const { return observer == 2 ? Observer::cie1931 : Observer::cie1964; }

    /// The dyes of rows; one without a name where none are given.
    std::vector<std::string> shown_dyes() const {
        return dyes.empty() ? std::vector<std::string>{""} : dyes;
    }

    static std::vector<Lighting> lightings_of(const SpectralImage &image,
                                              const std::vector<NamedLamp> &named) {
        std::vector<Lighting> lightings;
        for (const NamedLamp &lamp : named)
            lightings.push_back(scene::lighting_of_picture(image, {&lamp, 1}));
        return lightings;
    }

    /// Exposure of all figures, which a metered one would make depend on the other pictures.
    double figure_stops() const { return look.look().exposure_stops; }

    ColorReport report_on(const std::vector<PageDress> &dresses,
                          const std::vector<NamedLamp> &named) const {
        ColorReporter reporter({.exposure_stops = figure_stops()});
        for (const PageDress &dress : dresses) {
            SpectralImage image = dress.image;
            for (const std::string &dye : shown_dyes()) {
                if (!dye.empty())
                    scene::show_dyes(image, {&dye, 1});
                reporter.add({dress.name, scene::file_stem_of(dye), lightings_of(image, named)},
                             image);
            }
        }
        return reporter.report();
    }

    DisplayOptions shown_look(const std::vector<PageDress> &dresses,
                              const std::vector<NamedLamp> &named) const {
        DisplayOptions display = look.look();
        if (look.metered())
            display.exposure_stops = metered_stops(dresses, named, display);
        return display;
    }

    /// Throws Error for a file that is given twice.
    void check_transports() const {
        for (auto file = transports.begin(); file != transports.end(); ++file)
            if (std::any_of(transports.begin(), file,
                            [&](const auto &other) { return is_same_file(*file, other); }))
                throw Error(
                    {"'" + file->string() + "' is given twice", "", "expected each picture once"});
    }

    /// The pictures, each called as its file, with the folder where two would have one name.
    std::vector<PageDress> read_dresses() const {
        std::vector<PageDress> dresses;
        for (const std::filesystem::path &file : transports) {
            const bool alone =
                std::ranges::count(transports, file.stem(), &std::filesystem::path::stem) == 1;
            dresses.push_back(
                {alone ? file.stem().string() : file.string(), read_spectral_exr(file)});
        }
        return dresses;
    }

    /// Writes the page. \return what to say about it
    std::string make_page(const std::vector<PageDress> &dresses,
                          const std::vector<NamedLamp> &named) const {
        PageOptions options{.title = dresses[0].name,
                            .lamps = scene::page_lamps(dresses[0].image, named),
                            .look = scene::page_look(look.look())};
        for (std::size_t i = 1; i < dresses.size(); ++i)
            options.title += ", " + dresses[i].name;
        for (const std::string &dye : dyes)
            options.dyes.push_back({scene::label_of(dye), parse_dye(dye)});
        const LivePage made = live_page(dresses, options);
        scene::prepare_output_file(html);
        write_file(html, made.html);
        return scene::page_summary(html, made);
    }

    std::vector<DyedDifferences> compare(const std::vector<PageDress> &dresses,
                                         const std::vector<NamedLamp> &named,
                                         Console &console) const {
        const CompareOptions options{.observer = eye(), .exposure_stops = figure_stops()};
        std::vector<DyedDifferences> differences;
        std::set<std::string> left_out;
        for (std::size_t i = 0; i < dresses.size(); ++i) {
            SpectralImage image = dresses[i].image;
            for (const std::string &dye : shown_dyes()) {
                if (!dye.empty())
                    console.warnings(scene::show_dyes(image, {&dye, 1}));
                std::vector<Lighting> lightings = lightings_of(image, named);
                std::erase_if(lightings, [&](const Lighting &lighting) {
                    if (can_adapt(options.adapt, adopted_white(image, lighting, options.observer)))
                        return false;
                    left_out.insert(lighting.name);
                    return true;
                });
                differences.push_back({dresses.size() > 1 ? transports[i].string() : "", dye, {}});
                if (lightings.size() >= 2)
                    differences.back().lamps = compare_lightings(image, lightings, options);
            }
        }
        for (const std::string &lamp : left_out)
            console.warning("no eye adapts to the lamp '" + lamp +
                            "', so it has no differences from others");
        return differences;
    }

    /// Writes the sheet. \return the largest share of pixels out of gamut
    double draw(const std::vector<PageDress> &dresses, const std::vector<NamedLamp> &named,
                const ColorReport &colours) const {
        scene::CompareSheet sheet(named, shown_look(dresses, named), eye(), figure_stops());
        for (std::size_t i = 0; i < dresses.size(); ++i) {
            SpectralImage image = dresses[i].image;
            for (const std::string &dye : shown_dyes()) {
                if (!dye.empty())
                    scene::show_dyes(image, {&dye, 1});
                std::vector<PartReport> parts;
                for (const PartReport &part : colours.parts)
                    if (part.picture == dresses[i].name && part.dye == scene::file_stem_of(dye))
                        parts.push_back(part);
                const bool many = !dye.empty() || dresses.size() > 1;
                sheet.add(many ? row_label(dresses, i, dye) : "", image, parts);
            }
        }
        const Image drawn = draw_sheet(sheet.sheet());
        scene::prepare_output_file(output);
        write_png(output, drawn);
        return sheet.most_out_of_gamut();
    }

    static std::string row_label(const std::vector<PageDress> &dresses, std::size_t dress,
                                 const std::string &dye) {
        const std::string of_dye = scene::label_of(dye);
        if (dresses.size() == 1)
            return of_dye;
        return dresses[dress].name + (dye.empty() ? "" : ", ") + of_dye;
    }

    /// One exposure for all pictures of the sheet, adapted and not.
    double metered_stops(const std::vector<PageDress> &dresses, const std::vector<NamedLamp> &named,
                         const DisplayOptions &display) const {
        DisplayOptions adapted = display, plain = display;
        plain.adapt = Adaptation::none;
        if (display.adapt == Adaptation::none)
            adapted.adapt = Adaptation::cat02;
        scene::ExposureMeter plain_meter(plain), adapted_meter(adapted);
        for (const PageDress &dress : dresses) {
            SpectralImage image = dress.image;
            for (const std::string &dye : shown_dyes()) {
                if (!dye.empty())
                    scene::show_dyes(image, {&dye, 1});
                for (const NamedLamp &lamp : named) {
                    plain_meter.add(image, {&lamp, 1});
                    const Lighting lighting = scene::lighting_of_picture(image, {&lamp, 1});
                    if (can_adapt(adapted.adapt, adopted_white(image, lighting)))
                        adapted_meter.add(image, {&lamp, 1});
                }
            }
        }
        return std::min(plain_meter.stops(), adapted_meter.stops());
    }

    Json json_of_differences(const std::vector<DyedDifferences> &differences) const {
        Json numbers{
            {"schema", "tsuya-compare 2"},      {"transport", transports[0].string()},
            {"measure", "CIEDE2000"},           {"observer_deg", observer},
            {"exposure_stops", figure_stops()}, {"adaptation", to_string(CompareOptions{}.adapt)},
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
