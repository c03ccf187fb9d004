#include "repair/rims.h"

#include <cmath>

namespace tsuya::garment {
namespace {

glm::dvec3 unit(const glm::dvec3 &v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

} // namespace

RimEdge rim_edge(const PolygonMesh &mesh, std::uint32_t face, std::uint32_t corner, bool forward) {
    glm::dvec3 middle(0.0), normal(0.0);
    const auto place = [&](std::uint32_t c) { return mesh.position[mesh.corner_position[c]]; };
    for (std::uint32_t c = mesh.face_offset[face]; c < mesh.face_offset[face + 1]; ++c) {
        middle += place(c) / static_cast<double>(mesh.face_size(face));
        normal += glm::cross(place(c) - place(corner), place(mesh.next(face, c)) - place(corner));
    }
    const glm::dvec3 run = unit(place(mesh.next(face, corner)) - place(corner));
    normal = unit(normal);
    return {forward ? run : -run, unit(glm::cross(normal, run)), normal, middle};
}

Contact contact_of(const std::vector<RimEdge> &a, const std::vector<RimEdge> &b, double tolerance) {
    constexpr double kAlong = 0.7; // cosine: 45 degrees
    Contact contact = Contact::none;
    for (const RimEdge &p : a)
        for (const RimEdge &q : b) {
            if (glm::dot(p.along, q.along) < kAlong)
                continue;
            const double sides = glm::dot(p.inward, q.inward);
            const glm::dvec3 apart = q.middle - p.middle;
            if (sides < kAlong)
                return Contact::seam;
            if (std::abs(glm::dot(apart, p.normal)) <= tolerance &&
                std::abs(glm::dot(apart, q.normal)) <= tolerance)
                contact = Contact::layers;
        }
    return contact;
}

} // namespace tsuya::garment
