#include "repair/mesh_repair.h"

#include <sstream>

#include "mesh/islands.h"
#include "mesh/stop.h"
#include "mesh/valence.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

Prepared MeshRepair::run() {
    begin_stage(progress_, "garment: repair");
    check_sizes(mesh_);
    measure_file();
    measure_islands();
    make_manifold();
    if (mesh_.face_count() == 0)
        throw Error({"no face is left after degenerate faces were dropped", "mesh",
                     "expected faces of 3 different vertices or more"});
    name_panels();
    measure_panels();

    begin_stage(progress_, "garment: join seams");
    joining_ = true;
    join_seams();
    if (mesh_.face_count() == 0)
        throw Error({"no face is left after seams were joined", "mesh",
                     "expected faces larger than the tolerance of seams"});

    begin_stage(progress_, "garment: measure");
    measure_joined();
    measure_uv();
    cut_folded_islands();
    divide_concave_faces();
    list_findings();
    return {std::move(mesh_), std::move(report_), std::move(recipe_)};
}

Prepared MeshRepair::run_make_manifold() {
    check_sizes(mesh_);
    make_manifold();
    return {std::move(mesh_), std::move(report_), std::move(recipe_)};
}

void MeshRepair::name_panels() {
    // Above this number UV islands do not stand for panels (a file with one UV a corner).
    constexpr std::uint32_t kMaxIslandPanels = 256;
    if (!mesh_.panel_name.empty() || mesh_.uv.empty())
        return;
    const SetNumbers islands = find_islands(mesh_, edges());
    if (islands.count <= kMaxIslandPanels)
        name_islands(mesh_, islands);
}

void MeshRepair::measure_panels() {
    check_valence(mesh_);
    report_.parts_before = find_parts(mesh_).count;
    report_.loops_before = boundary_runs(half_edges()).size();
}

const EdgeTable &MeshRepair::edges() {
    if (!edges_) {
        look_at_stop(progress_);
        edges_.emplace(mesh_);
    }
    return *edges_;
}

const OpenSides &MeshRepair::open_sides() {
    if (!open_sides_)
        open_sides_.emplace(mesh_, edges(), reach_);
    return *open_sides_;
}

const HalfEdgeMesh &MeshRepair::half_edges() {
    if (!half_edges_)
        half_edges_.emplace(make_half_edges(mesh_, progress_));
    return *half_edges_;
}

void MeshRepair::faces_changed() {
    edges_.reset();
    open_sides_.reset();
    half_edges_.reset();
    settled_ = false;
}

std::uint32_t MeshRepair::copy_vertex(std::uint32_t vertex) {
    recipe_.append_middle(mesh_.position, vertex, vertex);
    const auto added = static_cast<std::uint32_t>(mesh_.position.size() - 1);
    layers_.copy(vertex, added);
    return added;
}

void MeshRepair::keep_place(FirstPlaces &places, const std::string &key, const glm::dvec3 &p) {
    if (places.contains(key))
        return;
    std::ostringstream text;
    text.precision(6);
    text << "near (" << p.x << ", " << p.y << ", " << p.z << ")";
    places.emplace(key, text.str());
}

glm::dvec3 MeshRepair::first_point(std::size_t face) const {
    return mesh_.position[mesh_.corner_position[mesh_.face_offset[face]]];
}

Prepared prepare(PolygonMesh metres, const SeamOptions &options, const Progress &progress) {
    check_indices(metres, "mesh");
    return MeshRepair(std::move(metres), options, true, {}, progress).run();
}

Prepared make_manifold(PolygonMesh mesh) {
    check_indices(mesh, "mesh");
    return MeshRepair(std::move(mesh), {}, true, {}, {}).run_make_manifold();
}

Report check(PolygonMesh metres, const SeamOptions &options, const Progress &progress,
             const std::optional<double> &metres_per_uv, bool unit_stated) {
    check_indices(metres, "mesh");
    Report report = MeshRepair(std::move(metres), options, true, {}, progress)
                        .list_islands()
                        .state_unit(unit_stated)
                        .run()
                        .report;
    report.metres_per_uv = choose_uv_scale(metres_per_uv, report);
    return report;
}

} // namespace tsuya::garment
