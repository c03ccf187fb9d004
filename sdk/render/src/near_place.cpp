#include "near_place.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

// Whether the triangle has places of its own on the cloth: not where its UVs lie in a point or
// line.
bool spans_cloth(const TracedScene &scene, const Hit &hit) {
    constexpr float kLeast = 1e-3f; // of the triangle's area
    const Surface &surface = scene.surface_of(hit);
    const glm::uvec3 t = surface.triangle[hit.triangle];
    const glm::vec2 a = surface.uv[t.y] - surface.uv[t.x], b = surface.uv[t.z] - surface.uv[t.x];
    const std::vector<glm::vec3> &positions = scene.accelerator.positions(hit.object);
    const glm::vec3 area =
        glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    return std::abs(a.x * b.y - a.y * b.x) > kLeast * glm::length(area);
}

} // namespace

// The place lies along the point's frame: from behind the weft runs the other way, and on the
// cloth's own back the systems change places.
std::optional<NearPlace> near_place(const TracedScene &scene, const glm::vec3 &direction,
                                    const Hit &hit, const SurfacePoint &point) {
    constexpr float kLeastFacing = 0.05f; // cosine by which a footprint is stretched
    const NearYarn *const near = scene.shading[point.cloth].near();
    if (!near)
        return std::nullopt;
    const float facing = std::max(-glm::dot(direction, point.geometric_normal), kLeastFacing);
    const float footprint = scene.camera.pixel_width(hit.distance) / std::sqrt(facing);
    const Surface &surface = scene.surface_of(hit);
    if (!(footprint < near->far_from()) || surface.uv.empty() || surface.warp.empty() ||
        !spans_cloth(scene, hit))
        return std::nullopt;
    const glm::dvec2 uv = scene.uv_at(hit);
    if (point.colours != point.cloth)
        return near->at({uv.y, uv.x}, footprint);
    const bool behind = glm::dot(hit.face_normal, direction) > 0;
    return near->at({behind ? -uv.x : uv.x, uv.y}, footprint);
}

} // namespace tsuya
