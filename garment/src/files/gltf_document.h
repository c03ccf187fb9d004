#pragma once
/// \file
/// A glTF document in memory, and checked access to its numbers.

#include <filesystem>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <tiny_gltf.h>

namespace tsuya::garment {

/// Parses bytes of a `.gltf` or `.glb`, and decodes what is compressed. Buffers come from the bytes
/// or from files in `folder`. Throws Error naming `name`, also for a required extension that is not
/// known.
tinygltf::Model parse_gltf_document(std::string_view bytes, const std::string &name,
                                    const std::filesystem::path &folder);

/// Whether a path, through links and dots, leads into a folder.
bool lies_inside(const std::filesystem::path &path, const std::filesystem::path &folder);

/// Bytes of a buffer. Throws Error naming `where` if the buffer has not all of them.
std::string_view buffer_bytes(const tinygltf::Model &model, int buffer, std::size_t offset,
                              std::size_t count, const std::string &where);

/// Numbers of an accessor, row by row, integers that are marked so normalised. Throws Error naming
/// `where` if the accessor names bytes that the file does not have, has not `components` a row, or
/// a number is not finite. \param rows expected number; 0: any
std::vector<double> read_accessor(const tinygltf::Model &model, int accessor, int components,
                                  std::size_t rows, const std::string &where);

/// Non-negative integers of a scalar accessor, as indices. Throws as read_accessor.
std::vector<std::uint32_t> read_indices(const tinygltf::Model &model, int accessor,
                                        const std::string &where);

} // namespace tsuya::garment
