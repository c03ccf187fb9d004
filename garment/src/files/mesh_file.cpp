#include "tsuya/garment/mesh_file.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "mesh/stop.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/garment/interchange.h"
#include "tsuya/garment/obj.h"
#include "tsuya/garment/ply.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Scenes, projects and solids that hold garments, but are not read.
bool is_of_other_programs(const std::string &extension) {
    constexpr std::array<std::string_view, 11> kKnown = {".abc",  ".usd",   ".usda", ".usdc",
                                                         ".usdz", ".blend", ".zprj", ".zpac",
                                                         ".bw",   ".max",   ".ma"};
    return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

/// How to come from there to a file that is read.
std::string export_advice(const std::string &extension) {
    const bool interchange = extension == ".abc" || extension.starts_with(".usd");
    return std::string("expected .obj or .glb from the program that made it") +
           (interchange ? ", or from Blender, which opens it and exports both" : "") +
           ": garment/docs/EXPORT.md has the settings of CLO, Marvelous Designer, Blender and "
           "Browzwear";
}

} // namespace

double FabricHint::grain() const { return thread_angle - 0.5 * kPi; }

const std::vector<std::string> &mesh_extensions() {
    static const std::vector<std::string> extensions{".obj", ".gltf", ".glb", ".ply",
                                                     ".off", ".fbx",  ".dae", ".stl"};
    return extensions;
}

MeshFile read_mesh(const std::filesystem::path &path, const Progress &progress) {
    begin_stage(progress, "garment: read");
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".obj")
        return {.mesh = read_obj(path, progress)};
    if (extension == ".gltf" || extension == ".glb")
        return read_gltf(path, progress);
    if (extension == ".ply")
        return {.mesh = read_ply(path, progress)};
    if (extension == ".off")
        return {.mesh = read_off(path, progress)};
    if (extension == ".fbx" || extension == ".dae" || extension == ".stl")
        return read_interchange(path, progress);
    std::error_code code;
    if (!std::filesystem::exists(path, code))
        throw Error({"there is no such file", path.string(), "expected a mesh"});
    if (std::filesystem::is_directory(path, code))
        throw Error({"it is a folder", path.string(), "expected a mesh"});
    if (is_of_other_programs(extension))
        throw Error({"'" + extension + "' is not a mesh format that is read", path.string(),
                     export_advice(extension)});
    throw Error({extension.empty() ? std::string("the name has no extension")
                                   : "'" + extension + "' is not a mesh format that is read",
                 path.string(), accepted_names(extension, mesh_extensions())});
}

} // namespace tsuya::garment
