#pragma once
/// \file
/// The few directions in which the channels of a picture's pixels differ where an eye can see it.

#include <vector>

#include "page/judged_looks.h"

namespace tsuya {

/// The shape of a pixel is its channels divided by their mean. Shapes are near
/// `mean + sum_i b_i direction[i]` with b_i = `reading[i]` . (shape - mean). A change of a b_i by 1
/// is at most one CIELAB unit at the brightness of a channel mean of 1, in the root mean square
/// over the looks: codes of an sRGB display count, too, which also show what no eye sees.
struct ShapeBasis {
    std::vector<double> mean{};
    std::vector<std::vector<double>> direction{}; ///< by falling importance, as many as channels
    std::vector<std::vector<double>> reading{};
    std::vector<double> spread{}; ///< root mean square of b_i over the pixels
};

/// How much a CIELAB difference grows with the brightness of a pixel whose mean channel is `mean`:
/// its cube root, and 1 from a mean of 1 on, which displays show as white.
double shape_weight(double mean);

/// Weighted principal components of the light group's shapes at some pixels.
ShapeBasis make_shape_basis(const SpectralImage &image, std::size_t group,
                            const std::vector<std::size_t> &pixels,
                            const std::vector<JudgedLook> &looks);

} // namespace tsuya
