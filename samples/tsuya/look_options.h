#pragma once
/// \file
/// Options that several commands have.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "tsuya/color/config.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya::program {

/// --adapt, --degree, --view, --display, --ocio and --exposure: how a picture is shown.
struct LookOptions {
    LookOptions();
    /// \param with_display false: pictures are for sRGB, and there is no --display
    void add_to(Options &options, bool with_display = true);
    /// The file that `--ocio` names, else that of the variable OCIO of the environment; empty:
    /// ours.
    std::filesystem::path config() const;
    /// Throws Error where no picture can be shown so; reads the config where one is named.
    void check() const;
    /// With an exposure of 0 where it is metered.
    DisplayOptions look() const;
    bool metered() const { return exposure == "metered"; }

    /// --adapt was given.
    bool adapt_given() const { return adapt_ && adapt_->given; }

    std::string adapt, view, display, ocio;
    double degree = 1;
    std::string exposure = "0"; ///< stops, or `metered`

  private:
    std::optional<double> stops() const;

    const Option *adapt_ = nullptr, *view_ = nullptr, *display_ = nullptr;
};

/// `--sewing-tolerance`, see garment::SeamOptions; shows the default that `metres` has.
void add_sewing_tolerance(Options &options, std::optional<double> &metres);

/// `--metres-per-uv`
void add_uv_scale(Options &options, std::optional<double> &metres_per_uv);

/// `--unit`. \param help what has the unit \return the option, which says whether it was given
const Option &add_unit(Options &options, std::string &unit, std::string help);

/// `--up y|z`, empty where it is not stated
void add_up(Options &options, std::string &up);
/// What `--up` says; nullopt where it is not given.
std::optional<garment::UpAxis> stated_up(const std::string &up);

/// The names of models, for Option::one_of. \param more one more value, where not empty
std::vector<std::string> model_choices(const std::string &more = {});

/// `--column`, which spectrum files with several have
void add_column(Options &options, std::string &column);

/// `--threads`, 0 for all processors
void add_threads(Options &options, int &threads);

/// `--no-cache`.
void add_cache(Options &options, bool &no_cache);
/// `--video`, frames per second; 0: none
Option &add_video(Options &options, int &fps);

/// The user's cache of tables, or none.
TableCache cache_unless(bool no_cache);

} // namespace tsuya::program
