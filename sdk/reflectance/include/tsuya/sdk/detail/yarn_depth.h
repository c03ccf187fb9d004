#pragma once
/// \file
/// What hides yarns that lie deeper than their neighbours: those that cross them, those beside
/// them.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/spline.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// The width that two directions pass over on their way up from a depth of 1: |tan light| + |tan
/// viewer| on opposite sides, the longer on one side; without corners. It is held as a fraction:
/// tangents grow without bound at the horizon.
struct YarnSpan {
    glm::vec2 width; ///< times `up`, along the weft and along the warp
    float up;        ///< product of the two cosines, above 0

    YarnSpan(const glm::vec3 &to_light, const glm::vec3 &to_viewer);
};

/// Depths of the yarns along the weft and along the warp.
///
/// A yarn in a pit lies at the bottom of an opening between yarns that cross it. Of the opening's
/// width neither light nor viewer lose a share of 1 - pit * span to its walls, but for a rounded
/// corner at 0.
///
/// A yarn dives between its neighbours: the filaments that have a normal lie at a mean depth below
/// them, like in an opening of the width of a yarn.
class YarnDepth {
  public:
    YarnDepth() = default;
    explicit YarnDepth(const YarnLobes &lobes);

    /// What is left of the filaments of weft and warp.
    /// \param half unit half vector
    glm::vec2 in_sight(const glm::vec3 &half, const YarnSpan &span) const;

  private:
    template <class F, detail::MaybeConst<YarnDepth> T> friend void each_part(F &&f, T &t) {
        auto &[pit, dive] = t;
        f(pit, dive);
    }

    static constexpr int kNodes = 65;

    glm::vec2 pit_{0};
    /// Depth of the dive over the angle of the normal as bed_angle codes it, with a node beyond
    /// each end. A spline of the values themselves rises as they do
    std::array<std::array<float, kNodes + 2>, 2> dive_{};
};

inline YarnSpan::YarnSpan(const glm::vec3 &l, const glm::vec3 &v) {
    constexpr float kLowest = 1e-10f; // cosine: below, spans grow no more
    constexpr float kRounded = 0.03f; // tangent
    const float light_up = std::max(l.z, kLowest), viewer_up = std::max(v.z, kLowest);
    up = light_up * viewer_up;
    // |x| without its corner, and without a difference of two numbers that are nearly equal
    const FourFloats corner = four(kRounded * up);
    const auto size = [&](FourFloats x) {
        const FourFloats square = x * x;
        return square / (root_of(square + corner * corner) + corner);
    };
    const FourFloats each{l.x * viewer_up, v.x * light_up, l.y * viewer_up, v.y * light_up};
    const FourFloats between{each[0] - each[1], each[2] - each[3], 0, 0};
    const FourFloats one = size(each), other = size(between);
    width = {0.5f * (one[0] + one[1] + other[0]), 0.5f * (one[2] + one[3] + other[1])};
}

inline glm::vec2 YarnDepth::in_sight(const glm::vec3 &half, const YarnSpan &span) const {
    constexpr float kSmallest = 1e-20f;
    constexpr float kRounded = 0.05f;                         // of the width of an opening
    static constexpr float kWhole = 0.5f * (1 + 1.00124922f); // (1 + sqrt(1 + kRounded^2)) / 2
    const glm::vec2 along = glm::abs(glm::vec2(half));
    const glm::vec2 turn = along / (along + (std::max(half.z, 0.0f) + kSmallest));
    const FourFloats x{turn.x, turn.y, 0, 0};
    const SplinePlaces places(x * float(kNodes - 1), four(kNodes - 1));
    const float *const weft = &dive_[0][static_cast<std::size_t>(places.first[0])];
    const float *const warp = &dive_[1][static_cast<std::size_t>(places.first[1])];
    const FourFloats dive =
        spline_along_lines(FourFloats{weft[0], weft[1], weft[2], 0},
                           FourFloats{warp[0], warp[1], warp[2], 0}, places.from);
    // (left + sqrt(left^2 + corner^2)) / 2, in another form where it is small
    const float corner = kRounded * span.up;
    const FourFloats left{span.up - pit_.x * span.width.x, span.up - pit_.y * span.width.y, 0, 0};
    const FourFloats sum = size_of(left) + root_of(left * left + corner * corner);
    const FourFloats small = corner * (corner / sum);
    const FourFloats open = left > 0.0f ? sum : small;
    const glm::vec2 beside(dive[0] * span.width.y, dive[1] * span.width.x);
    return glm::vec2(open[0], open[1]) / (2 * kWhole * (span.up + beside));
}

} // namespace tsuya
