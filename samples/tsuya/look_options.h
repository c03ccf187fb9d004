#pragma once
/// \file
/// Options that several commands have.

#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "tsuya/color/config.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/table_cache.h"

namespace tsuya::program {

/// --adapt, --view and --exposure: how a picture is shown.
struct LookOptions {
    LookOptions();
    void add_to(Options &options);
    /// With an exposure of 0 where it is metered.
    DisplayOptions look() const;
    bool metered() const { return exposure == "metered"; }

    /// --adapt was given.
    bool adapt_given() const { return adapt_ && adapt_->given; }

    std::string adapt, view;
    std::string exposure = "0"; ///< stops, or `metered`

  private:
    std::optional<double> stops() const;

    const Option *adapt_ = nullptr;
};

/// `--sewing-tolerance`, see garment::SeamOptions; shows the default that `metres` has.
void add_sewing_tolerance(Options &options, std::optional<double> &metres);

/// `--metres-per-uv`
void add_uv_scale(Options &options, std::optional<double> &metres_per_uv);

/// `--unit`. \param help what has the unit
void add_unit(Options &options, std::string &unit, std::string help);

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
