#pragma once
/// \file
/// Light transport in few numbers of 16 bits a pixel, from which a page makes every colour.

#include <cstdint>
#include <string>
#include <vector>

#include "page/shape_basis.h"
#include "tsuya/color/live_page.h"

namespace tsuya {

/// A plane of whole numbers, row by row: code x step + offset is the value.
struct CodePlane {
    double offset = 0;
    double step = 1;
    std::vector<std::uint16_t> codes{};
};

/// A light group. With a the level of a pixel, e_i its shape values and h = shape_weight(a), its
/// channels are a mean + a / h sum_i e_i direction[i]; the level is kLevelScale (exp(value) - 1).
struct PackedGroup {
    std::vector<double> mean{};
    std::vector<std::vector<double>> direction{};
    std::vector<CodePlane> planes{}; ///< the level, then one for each direction
};

/// A picture that is packed.
struct PackedPicture {
    std::vector<PackedGroup> groups{}; ///< as those of the picture
    PackingError error{};
};

/// Level from which codes go from linear to logarithmic.
inline constexpr double kLevelScale = 0.05;

/// Packs with the fewest directions and the coarsest steps whose error is at most `most`; with the
/// finest there are where even they miss it. Pixels that are not finite become black.
PackedPicture pack_picture(const SpectralImage &image, const PackingError &most);

} // namespace tsuya
