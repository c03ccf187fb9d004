#include "files/polygon_importer.h"

#include <cmath>

#include "mesh/stop.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

PolygonMesh PolygonImporter::take() {
    if (mesh_.face_count() == 0)
        throw Error({"the file has no face", name_, "expected polygons"});
    // UVs are given per vertex, so a UV has the number of its vertex.
    if (!mesh_.uv.empty()) {
        mesh_.uv.resize(mesh_.position.size(), glm::dvec2(0.0));
        has_uv_.resize(mesh_.position.size(), false);
        for (std::size_t c = 0; c < mesh_.corner_position.size(); ++c)
            if (const std::uint32_t v = mesh_.corner_position[c]; has_uv_[v])
                mesh_.corner_uv[c] = static_cast<std::int32_t>(v);
    }
    check_indices(mesh_, name_);
    return std::move(mesh_);
}

OpenMesh::VertexHandle PolygonImporter::add_vertex(const OpenMesh::Vec3f &p) {
    return add_vertex(OpenMesh::Vec3d(p[0], p[1], p[2]));
}

OpenMesh::VertexHandle PolygonImporter::add_vertex(const OpenMesh::Vec3d &p) {
    look_at_stop(progress_, mesh_.position.size());
    mesh_.position.emplace_back(p[0], p[1], p[2]);
    return OpenMesh::VertexHandle(static_cast<int>(mesh_.position.size()) - 1);
}

OpenMesh::VertexHandle PolygonImporter::add_vertex() {
    return add_vertex(OpenMesh::Vec3d(0.0, 0.0, 0.0));
}

OpenMesh::FaceHandle PolygonImporter::add_face(const VHandles &vertices) {
    const std::size_t face = mesh_.face_count();
    look_at_stop(progress_, face);
    if (vertices.size() < 3)
        throw Error(
            {"face " + std::to_string(face) + " has " + detail::counted(vertices.size(), "corner"),
             name_, "expected 3 or more"});
    for (const OpenMesh::VertexHandle v : vertices) {
        if (v.idx() < 0 || static_cast<std::size_t>(v.idx()) >= mesh_.position.size())
            throw Error(
                {"face " + std::to_string(face) + " names vertex " + std::to_string(v.idx()), name_,
                 "expected an index below " + std::to_string(mesh_.position.size())});
        mesh_.corner_position.push_back(static_cast<std::uint32_t>(v.idx()));
        mesh_.corner_uv.push_back(-1);
    }
    mesh_.face_offset.push_back(static_cast<std::uint32_t>(mesh_.corner_position.size()));
    mesh_.face_panel.push_back(0);
    return OpenMesh::FaceHandle(static_cast<int>(face));
}

void PolygonImporter::set_point(OpenMesh::VertexHandle v, const OpenMesh::Vec3f &p) {
    mesh_.position.at(static_cast<std::size_t>(v.idx())) = {p[0], p[1], p[2]};
}

void PolygonImporter::set_texcoord(OpenMesh::VertexHandle v, const OpenMesh::Vec2f &t) {
    const auto index = static_cast<std::size_t>(v.idx());
    if (mesh_.uv.size() <= index) {
        mesh_.uv.resize(index + 1, glm::dvec2(0.0));
        has_uv_.resize(index + 1, false);
    }
    mesh_.uv[index] = {t[0], t[1]};
    has_uv_[index] = true;
}

void PolygonImporter::set_texcoord(OpenMesh::VertexHandle v, const OpenMesh::Vec3f &t) {
    set_texcoord(v, OpenMesh::Vec2f(t[0], t[1]));
}

} // namespace tsuya::garment
