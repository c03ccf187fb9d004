#include "limit/face_departure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/distance.h"

namespace tsuya::garment {
namespace {

/// Limit points along each side of a sub-face that are compared with the triangles.
constexpr int kSubFaceGrid = 6;

double triangle_distance(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b,
                         const glm::dvec3 &c) {
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const bool over = glm::dot(glm::cross(b - a, p - a), n) >= 0.0 &&
                      glm::dot(glm::cross(c - b, p - b), n) >= 0.0 &&
                      glm::dot(glm::cross(a - c, p - c), n) >= 0.0;
    if (over && glm::dot(n, n) > 0.0)
        return plane_distance(p, a, b, c);
    return std::min(
        {segment_distance(p, a, b), segment_distance(p, b, c), segment_distance(p, c, a)});
}

double sub_face_departure(const LimitSurface &surface, const FacePattern &pattern,
                          const std::vector<glm::dvec3> &p, const LimitSurface::Scratch &scratch) {
    const auto parameterization = scratch.surface.GetParameterization();
    double worst = 0.0;
    for (int sub = 0; sub < parameterization.GetFaceSize(); ++sub)
        for (int i = 0; i < kSubFaceGrid * kSubFaceGrid; ++i) {
            const glm::dvec2 local = (glm::dvec2(i % kSubFaceGrid, i / kSubFaceGrid) + 0.5) /
                                     static_cast<double>(kSubFaceGrid);
            glm::dvec2 at;
            parameterization.ConvertNormalizedSubFaceToCoord(sub, &local.x, &at.x);
            const glm::dvec3 limit = surface.point(at, scratch);
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::uvec3 &t : pattern.triangle)
                nearest = std::min(nearest, triangle_distance(limit, p[t.x], p[t.y], p[t.z]));
            worst = std::max(worst, nearest);
        }
    return worst;
}

} // namespace

double plane_distance(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b,
                      const glm::dvec3 &c) {
    const glm::dvec3 plane = glm::cross(b - a, c - a);
    const double area = glm::length(plane);
    return area > 0.0 ? std::abs(glm::dot(p - a, plane)) / area : 0.0;
}

double face_departure(const LimitSurface &surface, const FacePattern &pattern,
                      const LimitSurface::Scratch &scratch) {
    std::vector<glm::dvec3> p;
    for (const glm::dvec2 &at : pattern.coordinate)
        p.push_back(surface.point(at, scratch));
    if (scratch.surface.GetParameterization().HasSubFaces())
        return sub_face_departure(surface, pattern, p, scratch);
    double worst = 0.0;
    for (const glm::uvec3 &t : pattern.triangle)
        for (const auto &w : kMeasuringPoints) {
            const glm::dvec2 at = w[0] * pattern.coordinate[t.x] + w[1] * pattern.coordinate[t.y] +
                                  w[2] * pattern.coordinate[t.z];
            worst =
                std::max(worst, plane_distance(surface.point(at, scratch), p[t.x], p[t.y], p[t.z]));
        }
    return worst;
}

double edge_departure(const LimitSurface &surface, int e, int pieces,
                      const LimitSurface::Scratch &scratch) {
    const auto parameterization = scratch.surface.GetParameterization();
    const auto coordinate = [&](double t) {
        glm::dvec2 at;
        parameterization.GetEdgeCoord(e, t / pieces, &at.x);
        return at;
    };
    glm::dvec3 start = surface.point(coordinate(0.0), scratch);
    double worst = 0.0;
    for (int i = 0; i < pieces; ++i) {
        const glm::dvec3 end = surface.point(coordinate(i + 1.0), scratch);
        const LimitSample middle = surface.sample(coordinate(i + 0.5), scratch);
        glm::dvec3 normal;
        if (middle.normal(normal))
            worst = std::max(worst, std::abs(glm::dot(middle.p - 0.5 * (start + end), normal)));
        start = end;
    }
    return worst;
}

} // namespace tsuya::garment
