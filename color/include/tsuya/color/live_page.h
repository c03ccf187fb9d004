#pragma once
/// \file
/// A page that relights pictures live: one HTML file, which needs no network and no other file.
///
///     const LivePage made = live_page(dresses, {.lamps = {{"D65", lamp("D65")}}});
///     write_file("page.html", made.html);

#include <span>
#include <string>
#include <vector>

#include "tsuya/color/compare.h"
#include "tsuya/color/config.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/spectral_image.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// A picture of a page. Its dyes may be changed in the page where they are open, see DyeVariable.
struct PageDress {
    std::string name{}; ///< shown as it is, UTF-8
    SpectralImage image{};
};

/// By how much colours in a page differ from those of the file: CIEDE2000 over at most 4000 pixels
/// of the garment (AOV `coverage`, else all that are lit), five lamps (D65, A, FL11, HP4, LED-B3),
/// and where a dye is open all dyes of dye_names() and a white.
struct PackingError {
    double mean = 0;
    double p99 = 0; ///< 99th percentile
};

/// What a page shows first, and how exact it is.
struct PageOptions {
    std::string title = "Tsuya"; ///< UTF-8
    /// At least one: the first is shown, the second is the right side of the split view, all are
    /// rows of the report. Those of lamp_names() can be chosen as well.
    std::vector<NamedLamp> lamps{};
    /// The first is shown where dyes are open. Those of dye_names() can be chosen as well.
    std::vector<NamedDye> dyes{};
    DisplayOptions look{};
    Observer observer = Observer::cie1931;
    PackingError most_error{.mean = 0.035, .p99 = 0.15}; ///< coarser packing is not used
};

/// A page that is made.
struct LivePage {
    std::string html{};
    std::vector<PackingError> errors{}; ///< one a dress, as measured
};

/// Makes the page. Packs each light group of a dress into a few planes of 16 bits, as many and as
/// fine as `most_error` asks for; where even the finest miss it, these. A dress of 800 x 1000
/// pixels and two light groups takes about 3 MB, more where it is noisy. Pixels that are not finite
/// are black. Throws Error at `dresses`, `lamps`, `dyes` or `view` for no dress, no lamp, a name
/// used twice, a lamp without visible power, a reflectance beyond 0..1, a picture without pixels,
/// light groups or channels or whose sizes do not agree, a view that is unknown, an exposure that
/// is not finite, and as check_pictures (whose module compresses).
LivePage live_page(std::span<const PageDress> dresses, const PageOptions &options);

} // namespace tsuya
