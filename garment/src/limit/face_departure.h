#pragma once
/// \file
/// How far the triangles of one face lie from the limit surface.

#include <array>

#include "limit/limit_numbering.h"

namespace tsuya::garment {

/// Points of a triangle at which it is compared with the limit surface, barycentric.
inline constexpr std::array<std::array<double, 3>, 4> kMeasuringPoints{
    {{1.0 / 3, 1.0 / 3, 1.0 / 3}, {0.5, 0.5, 0.0}, {0.0, 0.5, 0.5}, {0.5, 0.0, 0.5}}};

/// From `p` to the plane of a triangle, metres; 0 where that has no area. What moves a point within
/// the plane does not show.
double plane_distance(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b,
                      const glm::dvec3 &c);

/// Largest departure, metres: of the planes of the triangles at their measuring points; of faces
/// that are divided into sub-faces, whose coordinates do not join, of a grid of limit points from
/// the nearest triangle. \param scratch is set to the face
double face_departure(const LimitSurface &surface, const FacePattern &pattern,
                      const LimitSurface::Scratch &scratch);

/// Largest departure of the chords of edge `e`, cut into `pieces`, along the surface's normal.
double edge_departure(const LimitSurface &surface, int e, int pieces,
                      const LimitSurface::Scratch &scratch);

} // namespace tsuya::garment
