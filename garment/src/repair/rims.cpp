#include "repair/rims.h"

namespace tsuya::garment {
namespace {

glm::dvec3 unit(const glm::dvec3 &v) {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

} // namespace

RimEdge rim_edge(const PolygonMesh &mesh, std::uint32_t face, std::uint32_t corner, bool forward) {
    glm::dvec3 normal(0.0);
    const auto place = [&](std::uint32_t c) { return mesh.position[mesh.corner_position[c]]; };
    for (std::uint32_t c = mesh.face_offset[face]; c < mesh.face_offset[face + 1]; ++c)
        normal += glm::cross(place(c) - place(corner), place(mesh.next(face, c)) - place(corner));
    const glm::dvec3 run = unit(place(mesh.next(face, corner)) - place(corner));
    return {forward ? run : -run, unit(glm::cross(normal, run))};
}

Contact contact_of(const std::vector<RimEdge> &a, const std::vector<RimEdge> &b) {
    constexpr double kAlong = 0.7; // cosine: 45 degrees
    Contact contact = Contact::none;
    for (const RimEdge &p : a)
        for (const RimEdge &q : b) {
            if (glm::dot(p.along, q.along) < kAlong)
                continue;
            if (glm::dot(p.inward, q.inward) < kAlong)
                return Contact::seam;
            contact = Contact::folded;
        }
    return contact;
}

} // namespace tsuya::garment
