#pragma once
/// \file
/// What glTF materials say about UVs and cloth.

#include <optional>

#include "files/gltf_document.h"
#include "tsuya/garment/mesh_file.h"

namespace tsuya::garment {

/// Which UVs a material uses, and how they are moved. [KhrTextureTransform]
struct GltfUv {
    std::string attribute = "TEXCOORD_0";
    glm::dvec2 offset{0.0}, scale{1.0};
    double rotation = 0; ///< radians

    glm::dvec2 apply(const glm::dvec2 &uv) const;
};

/// The UVs of the base colour texture; those of TEXCOORD_0 where there is none.
GltfUv gltf_uv(const tinygltf::Model &model, int material);

/// Anisotropy and sheen of a material; nullopt where it states neither. The thread angle is counted
/// from the tangent, to which the caller adds the tangent's own angle.
std::optional<FabricHint> gltf_hint(const tinygltf::Model &model, int material);

} // namespace tsuya::garment
