#include <algorithm>
#include <array>
#include <cmath>

#include "limit/face_departure.h"
#include "limit/limit_surface.h"
#include "limit/tessellation_rates.h"
#include "mesh/distance.h"

namespace tsuya::garment {
namespace {

/// A corner of a triangle as the renderer has it.
struct Corner {
    glm::dvec3 p{0.0}, normal{0.0}, warp{0.0};
    bool has_normal = false, has_warp = false;
};

Corner corner_at(const LimitSurface &surface, const glm::dvec2 &at,
                 const LimitSurface::Scratch &scratch) {
    const LimitSample sample = surface.sample(at, scratch);
    Corner c{.p = sample.p};
    glm::dvec3 dp_du;
    c.has_normal = sample.normal(c.normal);
    c.has_warp = c.has_normal && scratch.has_uv && sample.cloth(dp_du, c.warp);
    if (c.has_warp)
        c.warp = glm::normalize(c.warp - glm::dot(c.warp, c.normal) * c.normal);
    return c;
}

struct Sums {
    double position2 = 0, normal2 = 0, warp2 = 0;
    std::size_t positions = 0, normals = 0, warps = 0;
};

void measure_triangle(const std::array<Corner, 3> &corner, const std::array<double, 3> &weight,
                      const Corner &truth, double pixel, TessellationError &error, Sums &sums) {
    glm::dvec3 normal(0.0), warp(0.0);
    bool has_normal = truth.has_normal, has_warp = truth.has_warp;
    for (std::size_t k = 0; k < 3; ++k) {
        normal += weight[k] * corner[k].normal;
        warp += weight[k] * corner[k].warp;
        has_normal &= corner[k].has_normal;
        has_warp &= corner[k].has_warp;
    }
    const double departure = plane_distance(truth.p, corner[0].p, corner[1].p, corner[2].p);
    error.position = std::max(error.position, departure);
    error.pixels = std::max(error.pixels, departure * pixel);
    sums.position2 += departure * departure;
    ++sums.positions;
    if (has_normal) {
        const double angle = angle_between(normal, truth.normal);
        error.normal = std::max(error.normal, angle);
        sums.normal2 += angle * angle;
        ++sums.normals;
    }
    if (has_warp) {
        const double angle = angle_between(warp, truth.warp);
        error.warp = std::max(error.warp, angle);
        sums.warp2 += angle * angle;
        ++sums.warps;
    }
}

double root_mean(double sum, std::size_t count) {
    return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

} // namespace

TessellationError measure_tessellation(const PolygonMesh &mesh, const SubdivideOptions &options,
                                       const std::optional<Camera> &camera) {
    const Progress unattended;
    const LimitSurface surface(mesh, options, unattended);
    const TessellationRates rates = choose_rates(surface, options, unattended);
    const FacePatterns patterns(surface, rates, unattended);
    TessellationError error;
    Sums sums;
    LimitSurface::Scratch scratch;
    std::vector<Corner> corners;
    const auto pixels_per_metre = [&](const glm::dvec3 &p) {
        return camera ? 1 / pixel_width(*camera, glm::distance(p + surface.centre(), camera->eye))
                      : 0.0;
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const FacePattern &pattern = patterns.of(f);
        surface.prepare(f, scratch);
        if (scratch.surface.GetParameterization().HasSubFaces()) {
            const double departure = face_departure(surface, pattern, scratch);
            error.position = std::max(error.position, departure);
            error.pixels = std::max(error.pixels, departure * pixels_per_metre(surface.point(
                                                                  pattern.coordinate[0], scratch)));
            error.triangles += pattern.triangle.size();
            continue;
        }
        corners.clear();
        for (const glm::dvec2 &at : pattern.coordinate)
            corners.push_back(corner_at(surface, at, scratch));
        for (const glm::uvec3 &t : pattern.triangle) {
            const std::array<Corner, 3> corner{corners[t.x], corners[t.y], corners[t.z]};
            const double pixel = pixels_per_metre(corner[0].p);
            for (const auto &w : kMeasuringPoints) {
                const glm::dvec2 at = w[0] * pattern.coordinate[t.x] +
                                      w[1] * pattern.coordinate[t.y] +
                                      w[2] * pattern.coordinate[t.z];
                measure_triangle(corner, w, corner_at(surface, at, scratch), pixel, error, sums);
            }
            ++error.triangles;
        }
    }
    error.position_rms = root_mean(sums.position2, sums.positions);
    error.normal_rms = root_mean(sums.normal2, sums.normals);
    error.warp_rms = root_mean(sums.warp2, sums.warps);
    return error;
}

} // namespace tsuya::garment
