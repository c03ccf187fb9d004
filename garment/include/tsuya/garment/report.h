#pragma once
/// \file
/// What was found in a garment mesh and what was done about it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// How much a finding matters: `note` is for the record, `warning` may show in the picture and is
/// refused by `Options::strict`.
enum class Severity { note, warning };

/// One thing that was found. `key` is stable once published; the keys are listed in
/// garment/README.md.
struct Finding {
    Severity severity = Severity::note;
    std::string key{};    ///< such as `non_manifold_edges`
    std::string what{};   ///< one sentence with the number
    std::string where{};  ///< first place: `near (x, y, z)` in metres; may be empty
    std::string action{}; ///< what was done about it, or what the user can do
};

/// Where something was first found, by the key of its finding: `near (x, y, z)` in metres.
using FirstPlaces = std::map<std::string, std::string>;

/// One closed run of boundary edges.
struct BoundaryLoop {
    std::size_t edges = 0;
    double length = 0;      ///< metres
    glm::dvec3 centre{0.0}; ///< mean of its vertices, metres
};

/// Percentiles 5, 50 and 95 over faces, weighted by area; 0 where nothing was measured.
struct Percentiles {
    double p5 = 0, p50 = 0, p95 = 0;
};

/// One panel of the garment: a named one, or a UV island where the file names none.
struct PanelReport {
    std::string name{};
    PanelLabel label{}; ///< what the file calls it; also by these it can be named, see panels_named
    std::size_t faces = 0;
    double area = 0;                   ///< square metres of drape
    glm::dvec3 lower{0.0}, upper{0.0}; ///< bounding box, metres
    /// Mean direction of the warp (+v) in space, unit; 0 where the panel has no UV.
    glm::dvec3 warp{0.0};
    /// Between the warp's line and the vertical (+y), radians, 0 to pi/2, mean over the area: small
    /// for straight grain, about pi/4 for bias, near pi/2 for cross grain.
    double warp_to_vertical = 0;
};

/// What joining of the seams did.
struct SeamReport {
    double tolerance = 0;            ///< metres; what was used
    std::size_t boundary_before = 0; ///< boundary vertices before
    std::size_t boundary_after = 0;  ///< boundary vertices after
    std::size_t joined = 0;          ///< vertices that became one with another
    std::size_t splits = 0;          ///< vertices put into a neighbour's edge (T-junctions)
    std::size_t slits = 0;           ///< narrow gaps that were closed beyond the tolerance
    std::size_t collapsed_edges = 0; ///< shorter than the tolerance, that held a slit open
    std::size_t layered = 0;         ///< boundary vertices left on another layer of cloth
    double largest_gap = 0;          ///< metres; largest distance that was closed
    FirstPlaces first_place{};
    std::size_t unresolved = 0; ///< boundary vertices left that lie on another boundary edge or
                                ///< in a slit that could not be closed
};

/// What make_manifold did.
struct ManifoldReport {
    std::size_t degenerate_faces = 0;      ///< fewer than 3 different vertices; dropped
    std::size_t duplicate_faces = 0;       ///< same vertices as an earlier face; dropped
    std::size_t non_manifold_edges = 0;    ///< shared by more than two faces; taken in pairs
    std::size_t non_manifold_vertices = 0; ///< joined more than one fan of faces; split
    std::size_t flipped_faces = 0;         ///< turned over to agree with their neighbours
    std::size_t unorientable_edges = 0;    ///< no side can be told (Moebius strip); cut open
    std::size_t detached_faces = 0;        ///< could not be kept with their neighbours; cut off
    FirstPlaces first_place{};
    std::size_t isolated_vertices = 0; ///< belong to no face; dropped
};

/// All that `check` finds. Counts are of the file unless they say otherwise.
struct Report {
    std::size_t vertices = 0;
    std::size_t uvs = 0;
    std::size_t faces = 0;
    std::size_t triangles = 0;
    std::size_t quads = 0;
    std::size_t ngons = 0;                ///< faces of five corners or more
    std::size_t concave_faces = 0;        ///< cut into triangles
    std::size_t crossed_faces = 0;        ///< concave too, but cross themselves; kept
    std::size_t panels = 0;               ///< named panels; 0: none named
    std::size_t parts = 0;                ///< connected parts after joining
    std::size_t parts_before = 0;         ///< connected parts in the file
    std::size_t loops_before = 0;         ///< boundary loops in the file (panel outlines)
    std::vector<BoundaryLoop> openings{}; ///< boundary loops after joining, longest first
    ManifoldReport file{};                ///< topology of the file
    ManifoldReport joined{};              ///< topology after joining
    SeamReport seams{};
    FirstPlaces first_place{}; ///< of what concerns UVs
    std::size_t uv_islands = 0;
    std::size_t mirrored_islands = 0; ///< more than half of their area is mirrored
    std::size_t mirrored_faces = 0;   ///< against their island's majority or in a mirrored one
    std::size_t faces_without_uv = 0;
    std::size_t faces_without_uv_area = 0; ///< have UVs that enclose no area
    double area_without_uv = 0;            ///< of both kinds, square metres; plain panels left out
    Percentiles metres_per_uv_weft{};      ///< |dP/du|
    Percentiles metres_per_uv_warp{};      ///< |dP/dv|
    Percentiles warp_weft_angle{};         ///< between dP/du and dP/dv, radians; pi/2: no shear
    std::vector<PanelReport> panel{};      ///< in the order of the panels
    /// Of `check`: UV islands of panels that have several, named as split_panels_by_island does.
    std::vector<PanelReport> island{};
    double metres_per_uv = 1.0;        ///< scale that was applied to UVs
    glm::dvec3 lower{0.0}, upper{0.0}; ///< bounding box, metres
    double area = 0;                   ///< of the control faces, square metres
    // What load adds.
    std::size_t limit_points = 0; ///< vertices of the surface
    std::size_t limit_triangles = 0;
    std::size_t repaired_normals = 0; ///< limit tangents vanished; taken from the faces about
    std::size_t repaired_frames = 0;  ///< vertices whose UV is degenerate; filled from near
    double repaired_area_share = 0;   ///< share of the area that these vertices touch
    std::vector<Finding> findings{};
};

} // namespace tsuya::garment
