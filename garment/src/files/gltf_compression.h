#pragma once
/// \file
/// Compressed parts of a glTF document, decoded so that accessors read as those of any other.

#include <optional>

#include "files/gltf_document.h"

namespace tsuya::garment {

/// Corners, or vertices, that any file may ask for, and how many more a byte of it: a small file
/// must not become a huge mesh.
inline constexpr std::size_t kFreeCorners = 1u << 22;
inline constexpr std::size_t kCornersPerByte = 64;

/// Decodes primitives with KHR_draco_mesh_compression: they get accessors of their own. Throws
/// Error naming the primitive if the data is damaged, or larger than a file of this size may be.
void decode_draco(tinygltf::Model &model, const std::string &name);

/// Decodes buffer views with EXT_meshopt_compression. Throws as decode_draco.
void decode_meshopt(tinygltf::Model &model, const std::string &name);

/// The document without valid parts that the parser refuses. What only stands for compressed data
/// and has no bytes goes: indices of primitives that Draco has, and empty buffers in place of
/// meshopt's. Skins without inverse bind matrices get -1. nullopt for documents without any.
std::optional<std::string> adapted_to_parser(std::string_view bytes);

/// Appends a buffer and a view of all of it; its number.
int add_buffer_view(tinygltf::Model &model, std::vector<unsigned char> bytes);

} // namespace tsuya::garment
