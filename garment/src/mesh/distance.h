#pragma once
/// \file
/// Small measures that several rooms need.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// From a point to the nearest of a segment.
inline double segment_distance(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b) {
    const glm::dvec3 ab = b - a;
    const double length2 = glm::dot(ab, ab);
    const double t = length2 > 0.0 ? glm::clamp(glm::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * ab);
}

/// From a point to the nearest of a triangle.
inline double triangle_distance(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b,
                                const glm::dvec3 &c) {
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double area2 = glm::dot(normal, normal);
    const auto inside = [&](const glm::dvec3 &from, const glm::dvec3 &to) {
        return glm::dot(glm::cross(to - from, p - from), normal) >= 0.0;
    };
    if (area2 > 0.0 && inside(a, b) && inside(b, c) && inside(c, a))
        return std::abs(glm::dot(p - a, normal)) / std::sqrt(area2);
    return std::min(
        {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

/// Between two directions, radians, 0 to pi; exact near both ends too.
inline double angle_between(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace tsuya::garment
