#pragma once
/// \file
/// From the mesh of a file to one that can be subdivided.

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/edges.h"
#include "repair/half_edges.h"
#include "repair/layers.h"
#include "repair/open_sides.h"
#include "repair/pairing.h"
#include "repair/vertex_set.h"
#include "tsuya/garment/check.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// What is kept about a mesh while it is being sewn. `origin` tells, per corner, its vertex before
/// anything was joined, so that edges which were laid onto each other can be told apart. A new
/// corner gets a new number, the same on both sides of an edge inside a panel.
struct Sewing {
    std::vector<std::uint32_t> origin{};
    std::uint32_t next_origin = 0;
    bool triangles = false; ///< all faces are, and shall stay, triangles
};

/// A mesh under repair, with what was found and how its positions follow from those of the file.
/// Member functions are the steps, listed in the order in which they run. Edges and half-edges are
/// built when a step first asks for them and stand until a step changes the faces: once for a mesh
/// that needs no repair.
class MeshRepair {
  public:
    /// \param metres a mesh with valid indices, positions in metres
    /// \param cloth false: nobody looks at the UVs (a body), so there are no findings about them
    /// \param plain names of panels of whose UVs there are no findings
    MeshRepair(PolygonMesh metres, const SeamOptions &options, bool cloth,
               std::set<std::string> plain, Progress progress)
        : mesh_(std::move(metres)), options_(options), cloth_(cloth), plain_(std::move(plain)),
          progress_(std::move(progress)) {}

    /// The report lists the UV islands of the file's panels, too.
    MeshRepair &list_islands() {
        lists_islands_ = true;
        return *this;
    }
    /// The unit of the file was stated: a mesh of any size is no finding.
    MeshRepair &state_unit(bool stated) {
        unit_stated_ = stated;
        return *this;
    }
    /// All steps.
    Prepared run();
    /// `make_manifold` alone.
    Prepared run_make_manifold();

  private:
    // The mesh as the file has it (measure.cpp).
    void measure_file();
    /// What a scene names is counted before anything is changed.
    void measure_islands();

    // What half-edges need; after the file, and wherever sewing changed the faces (manifold.cpp,
    // fans.cpp).
    void make_manifold();
    void drop_faces();
    void drop_isolated_vertices();
    void orient_faces();
    void count_non_manifold_edges();
    /// Joins the sides of each edge in pairs of opposite directions and gives each fan of faces
    /// about a vertex that follows from it a vertex of its own. Where more than two faces meet in
    /// an edge (the layers of a pleat, a pocket), sides that are neighbours around an end of the
    /// edge are paired first, then sides of different panels, then the flattest; what is left over
    /// stays open. Returns the number of new vertices.
    std::size_t split_fans();
    /// Gives faces whose edges are still not manifold vertices of their own. Returns their number.
    std::size_t detach_faces();

    // The panels by themselves (mesh_repair.cpp).
    void name_panels();
    void measure_panels();

    // The garment: panels joined along their seams (seams.cpp, layers.cpp, pairing.cpp, sewing.cpp,
    // slits.cpp).
    void join_seams();
    /// Finds parts that lie on each other as layers, which are not sewn together.
    void find_layers(double tolerance);
    /// Joins what lies within the tolerance.
    void sew(double tolerance, const VertexSet &allowed);
    /// Joins vertices and puts vertices into edges.
    void apply(Pairing pairing);
    /// Where joining laid an edge inside a panel onto another edge (a fold one edge deep), the edge
    /// gets a vertex in its middle, so that the two stay different.
    void halve_coincident_edges();
    /// Puts vertices into edges: triangles become more triangles, other faces get corners.
    /// \param insertions sorted by corner, then t
    void insert_vertices(const std::vector<Insertion> &insertions);
    void rename_vertices(const std::vector<std::uint32_t> &into);
    /// Returns the number of vertices in slits that remain.
    std::size_t close_slits(double tolerance);
    /// Boundary loops that are nowhere wider than the slit width.
    Slits find_slits();
    /// Joins the ends of edges between `allowed` vertices that are no longer than the tolerance;
    /// their triangles are left without area. Returns the number of edges.
    std::size_t collapse_short_edges(double tolerance, const VertexSet &allowed);

    /// Where a UV island folds over itself, its mirrored faces become islands of their own: across
    /// the fold the surface's derivatives would be those of neither side (mirrored_uv.cpp).
    void cut_folded_islands();

    // Faces that subdivision would fold (concave.cpp).
    void divide_concave_faces();
    using Divided = std::vector<std::pair<std::size_t, std::vector<std::array<std::uint32_t, 3>>>>;
    /// Vertices of one face alone are corners of the hem, also where its triangles meet in them.
    void keep_hem_corners(const Divided &divided);
    /// Edges between triangles of nearly one plane.
    void keep_straight_edges(const Divided &divided);
    void replace_faces(const Divided &divided);

    // The result (measure.cpp, findings.cpp).
    void measure_joined();
    void measure_uv();
    void list_findings();

    const EdgeTable &edges();
    const OpenSides &open_sides();
    /// Of a manifold mesh.
    const HalfEdgeMesh &half_edges();
    void faces_changed();
    /// Appends a copy of a vertex. Returns its number.
    std::uint32_t copy_vertex(std::uint32_t vertex);
    /// Keeps the place of the first finding of a key.
    static void keep_place(FirstPlaces &places, const std::string &key, const glm::dvec3 &p);
    glm::dvec3 first_point(std::size_t face) const;
    ManifoldReport &manifold() { return joining_ ? report_.joined : report_.file; }

    PolygonMesh mesh_;
    Report report_{};
    PositionRecipe recipe_{};
    SeamOptions options_;
    bool cloth_;
    std::set<std::string> plain_;
    Progress progress_;
    bool lists_islands_ = false, unit_stated_ = false;
    std::map<std::string, std::string> island_of_panel_{}; ///< where a panel has only one
    bool joining_ = false; ///< findings about the topology belong to the joined mesh
    bool settled_ = false; ///< make_manifold would find nothing to do
    Sewing sewing_{};
    LayeredParts layers_{};
    double reach_ = 0.0; ///< metres; the farthest that sides are looked for
    std::optional<EdgeTable> edges_{};
    std::optional<OpenSides> open_sides_{};
    std::optional<HalfEdgeMesh> half_edges_{};
};

/// The scale of UVs that applies, metres a unit; where it had to be measured, with a finding.
double choose_uv_scale(const std::optional<double> &stated, Report &report);

} // namespace tsuya::garment
