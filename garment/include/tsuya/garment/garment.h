#pragma once
/// \file
/// From a mesh file to a Surface in one call.
///
///     const auto dress = tsuya::garment::load("dress.obj", {.subdivide = {.level = 2}});
///     render(dress.surface);
///     for (const auto &finding : dress.report.findings) ...

#include <filesystem>
#include <optional>
#include <string_view>

#include "tsuya/garment/frames.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/garment/report.h"
#include "tsuya/garment/seams.h"
#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// Which axis of a file points upwards.
enum class UpAxis { y, z };

/// How a file is read. Everything has a usable default.
struct Options {
    double metres_per_unit = 1.0; ///< length of one unit of the file, see metres_per
    bool unit_stated = false;     ///< the user stated it: any size is right, no `unusual_size`
    /// Files with z up are turned by a quarter about x, so that their -y faces to the front.
    /// nullopt: y, with a finding `probably_z_up` where the openings of the mesh say otherwise.
    std::optional<UpAxis> up{};
    /// Metres of cloth per unit of UV. nullopt: 1 if the mesh measures 0.5 to 2 (it is in metres),
    /// else the median that the mesh measures, with a finding `uv_scale_measured`.
    std::optional<double> metres_per_uv{};
    SeamOptions seams{};
    SubdivideOptions subdivide{};
    FrameOptions frames{}; ///< its metres_per_uv is replaced by the one above
    /// False: no warp, weft and UV, and no findings about UVs (a body).
    bool want_frames = true;
    bool strict = false; ///< every finding that is a warning becomes an Error
};

/// A garment or body that is ready to be rendered.
struct LoadedGarment {
    Surface surface{};
    Report report{};
    std::vector<FabricHint> hints{}; ///< what the file's materials say about the cloth
};

/// Metres of one `unit`: `m`, `dm`, `cm`, `mm`, `in`. Throws Error for another name.
double metres_per(std::string_view unit);

/// The axis called `y` or `z`. Throws Error for another name.
UpAxis up_axis(std::string_view name);

/// A point of a file in metres, with y up.
glm::dvec3 in_metres(const Options &options, const glm::dvec3 &point);

/// Reads (see read_mesh), checks and repairs, joins the seams, subdivides, and adds frames.
/// Throws Error naming the file (and line:column), and Interrupted where `progress` says stop.
LoadedGarment load(const std::filesystem::path &path, const Options &options = {},
                   const Progress &progress = {});

/// The same for a mesh in memory. \param mesh positions in units of the file
/// \param where names the mesh in errors
LoadedGarment load(PolygonMesh mesh, const Options &options, const std::string &where,
                   const Progress &progress = {});

/// The same for what read_mesh gave. The warp of panels whose material states anisotropy is laid
/// along the threads of that hint, unless `options.frames.grain` names the panel.
LoadedGarment load(MeshFile file, const Options &options, const std::string &where,
                   const Progress &progress = {});

} // namespace tsuya::garment
