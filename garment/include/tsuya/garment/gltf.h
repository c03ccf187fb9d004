#pragma once
/// \file
/// glTF 2.0 files, `.gltf` and `.glb`.

#include <filesystem>
#include <string_view>

#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// Reads the triangles of the scene (all root nodes where there is none), in the world of the
/// file: y up, metres. Nodes that mirror (negative scale) turn their triangles over. UVs are those
/// of the base colour texture after KHR_texture_transform, else TEXCOORD_0, with v turned to run
/// upwards (glTF counts it down), so that UVs that are not mirrored stay so. A panel is one
/// primitive of one node; vertices of a panel at exactly one place are one vertex. Morph targets
/// are shapes with one target at full weight. Skins are applied as the joints stand in the file.
/// Anisotropy and sheen are read as hints; where the file has TANGENT, the direction is counted
/// from it, else from +u. Meshes that stand in no node are findings (`unplaced_meshes`), read where
/// no mesh stands in one. The alpha of materials of the alphaMode MASK or BLEND is read as opacity
/// (`alpha_opacity`), or a finding says why not (`alpha_not_shown`). Quantised attributes, Draco
/// and meshopt compression are read; another required extension, unless it is one of materials,
/// textures or lights, is an Error. Other images, animations (`animations_not_read`), cameras,
/// lines and points are left aside.
///
/// Counts are checked against the bytes that the file has before anything is allocated; buffers
/// may come from the file's own folder alone.
/// Throws Error naming the file, and the accessor or node.
MeshFile read_gltf(const std::filesystem::path &path, const Progress &progress = {});

/// The same from bytes in memory. \param name stands for the file in errors \param folder may
/// hold further buffers; empty: no other file is read
MeshFile parse_gltf(std::string_view bytes, const std::string &name,
                    const std::filesystem::path &folder = {}, const Progress &progress = {});

/// How a viewer shades panels: metallic-roughness without metal, double-sided, with
/// KHR_materials_ior and KHR_materials_anisotropy [KhrAnisotropy].
struct GltfMaterial {
    std::string name{};
    glm::dvec3 colour{0.5};         ///< linear Rec. 709, 0 to 1
    double roughness = 0.5;         ///< 0 to 1; the GGX width across the highlight is its square
    double anisotropy_strength = 0; ///< 0 to 1
    double anisotropy_rotation = 0; ///< of the long axis of the highlight, radians from the weft
    double ior = 1.5;               ///< index of refraction, 1 or more
};

/// Writes a surface as GLB by atomic replacement: a primitive for each panel, with normals,
/// tangents along the weft and UVs in metres (v counted down, as glTF does). \param
/// material_of_panel into `materials`, one for each panel Throws Error naming the path if it cannot
/// be written; Interrupted.
void write_glb(const std::filesystem::path &path, const Surface &surface,
               const std::vector<GltfMaterial> &materials,
               const std::vector<std::size_t> &material_of_panel, const Progress &progress = {});

} // namespace tsuya::garment
