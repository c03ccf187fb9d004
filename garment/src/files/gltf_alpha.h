#pragma once
/// \file
/// Materials of glTF that let light through in places.

#include <map>

#include "files/gltf_document.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

/// Collects materials whose alphaMode is MASK or BLEND, and the panels that have them.
class GltfAlpha {
  public:
    void note(const tinygltf::Model &model, int material, const std::string &panel);
    /// A finding of each such material.
    void report(const tinygltf::Model &model, std::vector<Finding> &findings) const;

  private:
    std::map<int, std::vector<std::string>> panels_; ///< by material
};

} // namespace tsuya::garment
