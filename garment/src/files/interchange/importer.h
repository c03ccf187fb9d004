#pragma once
/// \file
/// Assimp is a library of 10 MB, which few calls need: so it is behind a module that is loaded when
/// the first file of its formats is read.

#include <string>
#include <string_view>

#include "tsuya/garment/mesh_file.h"

namespace tsuya::garment {

/// What the module does.
class Importer {
  public:
    virtual ~Importer() = default;
    /// A mesh from the bytes of a file. Throws std::exception; of a damaged file it may crash, or
    /// not end, so it is called in a process of its own. \param extension `.fbx`, `.dae` or `.stl`
    virtual MeshFile read(std::string_view bytes, const std::string &extension) const = 0;
};

/// Loads the module at the first call. Throws Error naming `where` where it cannot be loaded.
const Importer &importer(const std::string &where);

} // namespace tsuya::garment
