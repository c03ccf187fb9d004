#pragma once
/// \file
/// A mesh of polygons as a file holds it: positions and UVs with separate indices, and panels.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// What the file calls the faces of a panel; empty where it does not say.
struct PanelLabel {
    std::string object{}, group{}, material{};
    std::string island{}; ///< see panels.h

    bool operator==(const PanelLabel &) const = default;
};

/// Polygons of any size. A corner is one vertex of one face; the corners of face f are
/// `face_offset[f]` up to `face_offset[f + 1]`, counter-clockwise seen from outside.
struct PolygonMesh {
    std::vector<glm::dvec3> position{};           ///< metres
    std::vector<glm::dvec2> uv{};                 ///< metres of cloth unless a scale is stated
    std::vector<std::uint32_t> face_offset{0};    ///< faces + 1 entries, the first 0
    std::vector<std::uint32_t> corner_position{}; ///< per corner, into `position`
    std::vector<std::int32_t> corner_uv{};        ///< per corner, into `uv`; -1: no UV
    std::vector<std::uint32_t> face_panel{};      ///< per face, into `panel_name`
    std::vector<std::string> panel_name{};        ///< no two alike; empty: the file names none
    std::vector<PanelLabel> panel_label{};        ///< as `panel_name`, or empty
    /// What concave faces leave where they were cut into triangles (see prepare): vertices of the
    /// hem that stay sharp corners, and edges between triangles of one plane, which stay straight.
    std::vector<std::uint32_t> hem_corner{};
    std::vector<glm::uvec2> straight_edge{};

    /// Number of faces.
    std::size_t face_count() const { return face_offset.size() - 1; }
    /// Number of corners of face `f`.
    std::uint32_t face_size(std::size_t f) const { return face_offset[f + 1] - face_offset[f]; }
    /// The corner after `c` around face `f`.
    std::uint32_t next(std::size_t f, std::uint32_t c) const {
        return c + 1 == face_offset[f + 1] ? face_offset[f] : c + 1;
    }
    /// The corner before `c` around face `f`.
    std::uint32_t previous(std::size_t f, std::uint32_t c) const {
        return c == face_offset[f] ? face_offset[f + 1] - 1 : c - 1;
    }
    /// Appends a face; the two arrays are equally long.
    void add_face(const std::vector<std::uint32_t> &positions, const std::vector<std::int32_t> &uvs,
                  std::uint32_t panel);
};

/// Throws Error naming `where` unless every index is in range, every face has 3 corners or more,
/// every number is finite and the arrays have lengths that fit.
void check_indices(const PolygonMesh &mesh, const std::string &where);

/// True if all corners of face `f` have a UV.
bool has_uv(const PolygonMesh &mesh, std::size_t f);

/// The UV island of each face.
struct UvIslands {
    std::vector<std::uint32_t> of_face{};
    std::uint32_t count = 0;
};

/// Faces are of one island if they are joined by edges whose UV indices agree on both sides. Faces
/// without UV are islands of their own, one for each connected set.
UvIslands uv_islands(const PolygonMesh &mesh);

/// Gives corners of one vertex and panel whose UVs have exactly equal values the same UV index, so
/// that files with one UV a corner are continuous.
void share_equal_uvs(PolygonMesh &mesh);

} // namespace tsuya::garment
