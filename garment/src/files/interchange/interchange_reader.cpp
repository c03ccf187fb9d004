#include "tsuya/garment/interchange.h"

#include <algorithm>
#include <cctype>

#include "files/gltf_compression.h"
#include "files/interchange/child_process.h"
#include "files/interchange/importer.h"
#include "files/interchange/mesh_bytes.h"
#include "files/interchange/stl_bytes.h"
#include "mesh/stop.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

constexpr const char *kOtherwise = "expected a file that another program has written again, best "
                                   "as .obj or .glb: garment/docs/EXPORT.md says how";

/// A small file must not take all memory, or an hour.
ChildLimits limits_for(std::size_t bytes) {
    constexpr std::uint64_t kFreeBytes = 1u << 30, kBytesPerByte = 256;
    constexpr std::size_t kBytesPerSecond = 250'000;
    constexpr int kWallPerCpu = 10; // many processes may share the processor
    const std::chrono::seconds cpu_time(20 + bytes / kBytesPerSecond);
    return {.memory_bytes = kFreeBytes + kBytesPerByte * bytes,
            .cpu_time = cpu_time,
            .wall_time = kWallPerCpu * cpu_time,
            .result_bytes = kFreeBytes / 2 + kBytesPerByte * bytes};
}

[[noreturn]] void refuse(const ChildResult &result, const ChildLimits &limits,
                         const std::string &where) {
    using End = ChildResult::End;
    switch (result.end) {
    case End::out_of_cpu_time:
        throw Error({"Assimp takes more than " + std::to_string(limits.cpu_time.count()) +
                         " s of processor time for it",
                     where, kOtherwise});
    case End::out_of_wall_time:
        throw Error({"Assimp has not ended after " +
                         std::to_string(limits.wall_time / std::chrono::seconds(1)) + " s",
                     where, kOtherwise});
    case End::killed:
        throw Error({"the process that reads the file was killed", where,
                     "expected enough free memory: a system without any kills processes"});
    case End::out_of_memory:
    case End::too_long:
        throw Error(
            {"Assimp needs more memory for it than a file of this size should", where, kOtherwise});
    default:
        throw Error({result.bytes.empty() ? "Assimp crashed when it read the file"
                                          : "Assimp cannot read the file: " + result.bytes,
                     where, kOtherwise});
    }
}

} // namespace

MeshFile read_interchange(const std::filesystem::path &path, const Progress &progress) {
    const std::string where = path.string();
    std::string bytes = read_file(path), extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const Importer &import = importer(where);
    if (extension == ".stl")
        bytes = stl_bytes(std::move(bytes), where);
    const ChildLimits limits = limits_for(bytes.size());
    const ChildResult result = run_in_child([&] { return bytes_of(import.read(bytes, extension)); },
                                            limits, where, progress);
    if (result.end != ChildResult::End::done)
        refuse(result, limits, where);
    MeshFile file = mesh_of_bytes(result.bytes, where);
    const PolygonMesh &mesh = file.mesh;
    if (mesh.face_count() == 0)
        throw Error({"the file has no face", where, "expected a mesh of polygons"});
    if (mesh.corner_position.size() > kFreeCorners + kCornersPerByte * bytes.size())
        throw Error(
            {"nodes repeat meshes too often for a file of this size", where, "expected fewer"});
    check_indices(mesh, where);
    share_equal_uvs(file.mesh);
    return file;
}

} // namespace tsuya::garment
