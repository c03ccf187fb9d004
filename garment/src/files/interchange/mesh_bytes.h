#pragma once
/// \file
/// A mesh on its way from one process to another of the same program.

#include <string>
#include <string_view>

#include "tsuya/garment/mesh_file.h"

namespace tsuya::garment {

/// Mesh and findings as bytes; hints and morph targets stay behind.
std::string bytes_of(const MeshFile &file);

/// The reverse. Throws Error naming `where` for bytes that bytes_of does not write.
MeshFile mesh_of_bytes(std::string_view bytes, const std::string &where);

} // namespace tsuya::garment
