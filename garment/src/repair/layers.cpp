#include "repair/layers.h"

#include <algorithm>
#include <utility>

#include "mesh/distance.h"
#include "mesh/islands.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

/// How far layers of cloth may lie from each other, in tolerances of sewing.
constexpr double kLayerTolerances = 4.0;

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

LayeredParts::LayeredParts(const std::vector<std::uint32_t> &part, std::uint32_t parts,
                           std::set<std::pair<std::uint32_t, std::uint32_t>> pairs)
    : pairs_(std::move(pairs)) {
    if (pairs_.empty())
        return;
    sets_.resize(parts + 1);
    for (std::uint32_t p = 0; p < parts; ++p)
        sets_[p + 1] = {p};
    for (const std::uint32_t p : part)
        set_.push_back(p + 1);
}

bool LayeredParts::has(std::uint32_t a, std::uint32_t b) const {
    if (pairs_.empty())
        return false;
    for (const std::uint32_t p : sets_[set_of(a)])
        for (const std::uint32_t q : sets_[set_of(b)])
            if (pairs_.contains(std::minmax(p, q)))
                return true;
    return false;
}

void LayeredParts::join(std::uint32_t into, const std::vector<std::uint32_t> &members) {
    if (pairs_.empty())
        return;
    std::vector<std::uint32_t> parts;
    for (const std::uint32_t v : members)
        parts.insert(parts.end(), sets_[set_of(v)].begin(), sets_[set_of(v)].end());
    std::sort(parts.begin(), parts.end());
    parts.erase(std::unique(parts.begin(), parts.end()), parts.end());
    if (into >= set_.size() || parts == sets_[set_[into]])
        return;
    set_[into] = static_cast<std::uint32_t>(sets_.size());
    sets_.push_back(std::move(parts));
}

void LayeredParts::keep(const std::vector<std::uint32_t> &kept) {
    if (pairs_.empty())
        return;
    std::vector<std::uint32_t> set;
    for (const std::uint32_t v : kept)
        set.push_back(set_of(v));
    set_ = std::move(set);
}

void LayeredParts::copy(std::uint32_t vertex, std::uint32_t added) {
    if (pairs_.empty())
        return;
    const std::uint32_t set = set_of(vertex);
    set_.resize(added + 1, 0);
    set_[added] = set;
}

/// Asks each vertex of the boundary how its rim lies to the rims of other parts that pass it. Where
/// a seam of the other part ends there, one side of it may lie on the rim and one beside it: it is
/// folded if any is.
void MeshRepair::find_layers(double tolerance) {
    const SetNumbers parts = find_parts(mesh_);
    const OpenSides &open = open_sides();
    LayerVotes votes;
    std::size_t turn = 0;
    for (const std::uint32_t v : open.vertices()) {
        look_at_stop(progress_, turn++);
        const glm::dvec3 &p = mesh_.position[v];
        std::map<std::uint32_t, Contact> contacts;
        std::uint32_t last = 0;
        for (const std::uint32_t i : open.near(p)) {
            const OpenSide &side = open.sides()[i];
            if (parts.of[v] == parts.of[side.from] || i + 1 == std::exchange(last, i + 1) ||
                segment_distance(p, open.start(side), open.end(side)) > tolerance)
                continue;
            Contact &contact = contacts[parts.of[side.from]];
            contact = std::max(contact, open.contact(v, side, tolerance));
        }
        for (const auto &[other, contact] : contacts)
            votes.add({parts.of[v], other}, v, contact);
    }
    const auto candidates = votes.candidates();
    std::vector<std::vector<std::uint32_t>> faces(candidates.empty() ? 0 : parts.count);
    for (std::uint32_t f = 0; !faces.empty() && f < mesh_.face_count(); ++f)
        faces[parts.of[mesh_.corner_position[mesh_.face_offset[f]]]].push_back(f);
    std::set<LayerVotes::Parts> layers;
    std::set<std::uint32_t> layered;
    for (const LayerVotes::Parts &pair : candidates) {
        look_at_stop(progress_);
        if (!lie_on_each_other(mesh_, faces[pair.first], faces[pair.second],
                               kLayerTolerances * tolerance))
            continue;
        layers.insert(pair);
        layered.insert(votes.folded(pair).begin(), votes.folded(pair).end());
    }
    layers_ = LayeredParts(parts.of, static_cast<std::uint32_t>(parts.count), std::move(layers));
    report_.seams.layered = layered.size();
    if (!layered.empty())
        keep_place(report_.seams.first_place, "two_layers", mesh_.position[*layered.begin()]);
}

} // namespace tsuya::garment
