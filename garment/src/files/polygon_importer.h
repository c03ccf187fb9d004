#pragma once
/// \file
/// What OpenMesh's readers find, kept as polygons: half-edges would drop what is not manifold.

#include <OpenMesh/Core/IO/importer/BaseImporter.hh>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Collects vertices, faces and UVs. A face that names a missing vertex throws Error; Interrupted.
class PolygonImporter final : public OpenMesh::IO::BaseImporter {
  public:
    /// \param progress must outlive this
    PolygonImporter(std::string name, const Progress &progress)
        : name_(std::move(name)), progress_(progress) {}

    /// The mesh; throws Error where it has no face.
    PolygonMesh take();

    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3f &p) override;
    OpenMesh::VertexHandle add_vertex(const OpenMesh::Vec3d &p) override;
    OpenMesh::VertexHandle add_vertex() override;
    OpenMesh::FaceHandle add_face(const VHandles &vertices) override;
    void set_point(OpenMesh::VertexHandle v, const OpenMesh::Vec3f &p) override;
    void set_texcoord(OpenMesh::VertexHandle v, const OpenMesh::Vec2f &t) override;
    void set_texcoord(OpenMesh::VertexHandle v, const OpenMesh::Vec3f &t) override;
    size_t n_vertices() const override { return mesh_.position.size(); }
    size_t n_faces() const override { return mesh_.face_count(); }
    size_t n_edges() const override { return 0; }

    // What meshes of polygons do not have.
    OpenMesh::HalfedgeHandle add_edge(OpenMesh::VertexHandle, OpenMesh::VertexHandle) override {
        return OpenMesh::HalfedgeHandle();
    }
    OpenMesh::FaceHandle add_face(OpenMesh::HalfedgeHandle) override {
        return OpenMesh::FaceHandle();
    }
    void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                            const std::vector<OpenMesh::Vec2f> &) override {}
    void add_face_texcoords(OpenMesh::FaceHandle, OpenMesh::VertexHandle,
                            const std::vector<OpenMesh::Vec3f> &) override {}
    void set_face_texindex(OpenMesh::FaceHandle, int) override {}
    void set_halfedge(OpenMesh::VertexHandle, OpenMesh::HalfedgeHandle) override {}
    void set_next(OpenMesh::HalfedgeHandle, OpenMesh::HalfedgeHandle) override {}
    void set_face(OpenMesh::HalfedgeHandle, OpenMesh::FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec2f &) override {}
    void set_texcoord(OpenMesh::HalfedgeHandle, const OpenMesh::Vec3f &) override {}
    void add_texture_information(int, std::string) override {}

    // Normals come from the limit surface, and colours from the fabric.
    void set_normal(OpenMesh::VertexHandle, const OpenMesh::Vec3f &) override {}
    void set_normal(OpenMesh::VertexHandle, const OpenMesh::Vec3d &) override {}
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3f &) override {}
    void set_normal(OpenMesh::FaceHandle, const OpenMesh::Vec3d &) override {}
    void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec3uc &) override {}
    void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec4uc &) override {}
    void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec3f &) override {}
    void set_color(OpenMesh::VertexHandle, const OpenMesh::Vec4f &) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3uc &) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4uc &) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec3f &) override {}
    void set_color(OpenMesh::EdgeHandle, const OpenMesh::Vec4f &) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3uc &) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4uc &) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec3f &) override {}
    void set_color(OpenMesh::FaceHandle, const OpenMesh::Vec4f &) override {}
    void set_status(OpenMesh::VertexHandle, const OpenMesh::Attributes::StatusInfo &) override {}
    void set_status(OpenMesh::HalfedgeHandle, const OpenMesh::Attributes::StatusInfo &) override {}
    void set_status(OpenMesh::EdgeHandle, const OpenMesh::Attributes::StatusInfo &) override {}
    void set_status(OpenMesh::FaceHandle, const OpenMesh::Attributes::StatusInfo &) override {}

  private:
    std::string name_;
    const Progress &progress_;
    PolygonMesh mesh_;
    std::vector<bool> has_uv_;
};

} // namespace tsuya::garment
