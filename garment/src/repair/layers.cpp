#include "repair/layers.h"

#include <algorithm>

#include "mesh/distance.h"

namespace tsuya::garment {
namespace {

glm::dvec3 middle_of(const PolygonMesh &mesh, std::uint32_t face) {
    glm::dvec3 middle(0.0);
    for (std::uint32_t c = mesh.face_offset[face]; c < mesh.face_offset[face + 1]; ++c)
        middle +=
            mesh.position[mesh.corner_position[c]] / static_cast<double>(mesh.face_size(face));
    return middle;
}

bool is_near(const PolygonMesh &mesh, const glm::dvec3 &p, std::uint32_t face, double distance) {
    const auto place = [&](std::uint32_t c) { return mesh.position[mesh.corner_position[c]]; };
    glm::dvec3 lower = place(mesh.face_offset[face]), upper = lower;
    for (std::uint32_t c = mesh.face_offset[face] + 1; c < mesh.face_offset[face + 1]; ++c) {
        lower = glm::min(lower, place(c));
        upper = glm::max(upper, place(c));
    }
    if (glm::any(glm::lessThan(p, lower - distance)) ||
        glm::any(glm::greaterThan(p, upper + distance)))
        return false;
    const glm::dvec3 a = place(mesh.face_offset[face]);
    for (std::uint32_t c = mesh.face_offset[face] + 1; c + 1 < mesh.face_offset[face + 1]; ++c)
        if (triangle_distance(p, a, place(c), place(c + 1)) <= distance)
            return true;
    return false;
}

} // namespace

bool lie_on_each_other(const PolygonMesh &mesh, std::vector<std::uint32_t> faces,
                       std::vector<std::uint32_t> others, double distance) {
    constexpr std::size_t kMostSamples = 64;
    constexpr double kShare = 0.8;
    if (others.size() < faces.size())
        std::swap(faces, others);
    const std::size_t samples = std::min(kMostSamples, faces.size());
    std::size_t near = 0;
    for (std::size_t i = 0; i < samples; ++i) {
        const glm::dvec3 p = middle_of(mesh, faces[i * faces.size() / samples]);
        near += std::any_of(others.begin(), others.end(),
                            [&](std::uint32_t other) { return is_near(mesh, p, other, distance); });
    }
    return static_cast<double>(near) >= kShare * static_cast<double>(samples);
}

} // namespace tsuya::garment
