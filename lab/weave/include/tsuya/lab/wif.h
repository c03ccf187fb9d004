#pragma once
/// \file
/// Weaving Information Files, version 1.1 ([WIF]): the drafts of handweavers' programs.
///
///     const Wif wif = read_wif("draft.wif");
///     check_draft(wif.draft, "draft.wif");

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/lab/draft.h"

namespace tsuya::lab {

/// Warp or weft of a file.
struct WifYarns {
    std::optional<double> spacing{}; ///< metres between threads; the mean where each has its own
    /// Encoded sRGB, 0 to 1, one for each thread of the drawdown; empty where the file has none.
    std::vector<glm::dvec3> color{};
};

/// What a WIF file says of a cloth.
struct Wif {
    std::string title{};
    Draft drawdown{}; ///< as woven: all threads of the file, 1 to 4096 each way
    Draft draft{};    ///< its smallest repeat, not yet checked by check_draft
    WifYarns warp{}, weft{};
};

/// Reads sections WARP, WEFT, WEAVING, THREADING, TIEUP and TREADLING or else LIFTPLAN, COLOR
/// TABLE, COLOR PALETTE, WARP COLORS, WEFT COLORS, WARP SPACING, WEFT SPACING and TEXT; others are
/// ignored, and so is the case of letters. `Rising Shed` is true where absent, and where false the
/// shafts of tie-up and liftplan sink. A thread without shaft is never lifted. Throws Error with
/// file:line:column, at most 20 problems; files are at most 4 MB.
Wif read_wif(const std::filesystem::path &file);
/// The same from text; `name` stands for the file in errors.
Wif parse_wif(std::string_view text, const std::string &name);

} // namespace tsuya::lab
