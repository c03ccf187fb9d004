#pragma once
/// \file
/// Directions of view as places on disks: one hemisphere for each direction of light.

#include <optional>
#include <string>
#include <vector>

#include "drawing.h"
#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

enum class MarkShape { dot, square, cross };

/// One view.
struct HemisphereMark {
    DirectionPair directions{};
    MarkShape shape = MarkShape::dot;
    std::string colour{};
    std::string told{}; ///< where a pointer rests on it
};

/// A line of the key.
struct KeyLine {
    MarkShape shape = MarkShape::dot;
    std::string colour{};
    std::string words{};
};

/// The colours of scale_colour() with what the values at both ends are.
struct ColourScale {
    std::string low{}, high{}, words{};
};

/// The radius of a place is theta_r, its angle phi_r from the weft, which points to the right.
struct HemispherePicture {
    std::string title{};
    std::vector<HemisphereMark> marks{}; ///< of any light
    std::vector<KeyLine> key{};
    std::optional<ColourScale> scale{};
    /// A line joins the dots and squares of a light in their order.
    bool joined = false;
};

/// SVG. Crosses of one colour that would overlap are a tinted patch, and their number stands beside
/// the disk. Of more than 24 directions of light the first are drawn, which the title says.
std::string draw(const HemispherePicture &picture);

} // namespace tsuya::lab
