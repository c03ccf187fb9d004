#include "look_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

#include "tsuya/color/srgb.h"
#include "tsuya/scene/picture.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/model.h"

namespace tsuya::program {

LookOptions::LookOptions()
    : adapt(to_string(scene::default_look().adapt)), view(scene::default_look().view),
      display(scene::default_look().display) {}

void LookOptions::add_to(Options &options, bool with_display) {
    adapt_ = &options
                  .option("--adapt", &adapt, "NAME",
                          "chromatic adaptation from the lamp to the display's white")
                  .one_of(adaptation_names());
    options.option("--degree", &degree, "D", "degree of adaptation: 0 none, 1 full").range(0, 1);
    view_ = &options
                 .option("--view", &view, "NAME",
                         "display view, see `tsuya list views`; of the config where one is used")
                 .check([this] {
                     DisplayOptions shown = look();
                     const std::vector<std::string> known = display_names();
                     if (std::find(known.begin(), known.end(), display) == known.end())
                         shown.display = known.front(); // told at --display
                     if (shown.config.empty())
                         check_display_options(shown);
                 });
    if (with_display)
        display_ = &options
                        .option("--display", &display, "NAME",
                                "display, see `tsuya list displays`; of the config where one is "
                                "used")
                        .check([this] {
                            if (config().empty())
                                display_description(display);
                        });
    options.option("--ocio", &ocio, "FILE.ocio",
                   "OpenColorIO config in the place of the program's own, also without this option "
                   "where $OCIO names one; none: the program's own");
    options
        .option("--exposure", &exposure, "STOPS",
                "exposure, -20 to 20 stops, of which each doubles the light; or metered: one for "
                "all pictures, by the pixels of the garment")
        .check([this] {
            if (!metered() && !stops())
                throw Error(Problem{"'" + exposure + "' is no exposure", "",
                                    "expected a number from -20 to 20, or metered"});
        });
}

std::optional<double> LookOptions::stops() const {
    double value = 0;
    const char *const end = exposure.data() + exposure.size();
    const auto [rest, error] = std::from_chars(exposure.data(), end, value);
    if (error != std::errc{} || rest != end || !(std::abs(value) <= 20))
        return {};
    return value;
}

std::filesystem::path LookOptions::config() const {
    if (ocio == "none")
        return {};
    const char *const variable = std::getenv("OCIO");
    return ocio.empty() && variable ? variable : ocio;
}

DisplayOptions LookOptions::look() const {
    DisplayOptions look{.adapt = parse_adaptation(adapt),
                        .view = view,
                        .exposure_stops = metered() ? 0 : stops().value_or(0),
                        .degree = degree,
                        .display = display,
                        .config = config()};
    const bool bright = display.starts_with("Rec.2100");
    if (!(view_ && view_->given) && (bright || !look.config.empty()))
        look.view = "";
    if (!(display_ && display_->given) && !look.config.empty())
        look.display = "";
    return look;
}

void LookOptions::check() const {
    const Image pixel{1, 1, {"X", "Y", "Z"}, {0.1f, 0.1f, 0.1f}};
    tsuya::display(pixel, srgb_white(), look());
}

void add_sewing_tolerance(Options &options, std::optional<double> &metres) {
    options
        .option("--sewing-tolerance", &metres, "METRES",
                "largest gap over which the edges of panels are joined, 0.0005 where none is given")
        .range(0, 1);
}

void add_uv_scale(Options &options, std::optional<double> &metres_per_uv) {
    options
        .option("--metres-per-uv", &metres_per_uv, "METRES",
                "metres of cloth in a unit of UV; measured where none is given")
        .positive();
}

const Option &add_unit(Options &options, std::string &unit, std::string help) {
    return options.option("--unit", &unit, "UNIT", std::move(help))
        .one_of({"m", "dm", "cm", "mm", "in"});
}

void add_up(Options &options, std::string &up) {
    options.option("--up", &up, "AXIS", "axis of the file that points upwards; y if not given")
        .one_of({"y", "z"});
}

std::optional<garment::UpAxis> stated_up(const std::string &up) {
    return up.empty() ? std::nullopt : std::optional(garment::up_axis(up));
}

void add_cache(Options &options, bool &no_cache) {
    options.flag("--no-cache", &no_cache,
                 "neither read nor write the tables of fabrics in $XDG_CACHE_HOME/tsuya or "
                 "~/.cache/tsuya");
}

Option &add_video(Options &options, int &fps) {
    return options
        .option("--video", &fps, "FPS",
                "also make each sequence of pictures an MP4 of so many frames per second; needs "
                "ffmpeg")
        .range(1, 240);
}

TableCache cache_unless(bool no_cache) {
    return {.folder = no_cache ? std::filesystem::path() : user_cache_folder()};
}

void add_column(Options &options, std::string &column) {
    options.option("--column", &column, "NAME",
                   "column or sample of files that hold several spectra; FILE:NAME names one of a "
                   "single file");
}

void add_threads(Options &options, int &threads) {
    options.option("--threads", &threads, "N", "number of threads; 0 uses all processors")
        .range(0, 4096);
}

std::vector<std::string> model_choices(const std::string &more) {
    std::vector<std::string> names;
    for (const ModelName &model : model_names())
        names.emplace_back(model.name);
    if (!more.empty())
        names.push_back(more);
    return names;
}

} // namespace tsuya::program
