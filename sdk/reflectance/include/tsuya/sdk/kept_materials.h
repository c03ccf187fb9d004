#pragma once
/// \file
/// What models tabulate, made once for a cloth and kept: for its other dyes, and for later renders.

#include <cstddef>
#include <deque>
#include <string>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

/// Materials by the specular part of their fabrics. One that is given to several renders makes each
/// cloth's tables once, whatever its dyes; it is used by one render at a time.
///
///     KeptMaterials kept;
///     for (const Spectrum &dye : dyes) {
///         scene.fabrics[0].colours.dye_all(dye);
///         results.push_back(render(scene, settings, {}, &kept));
///     }
class KeptMaterials {
  public:
    /// As resolve (fabric.h), with the tables of a fabric before that has the same specular part.
    Material resolve(const Fabric &fabric, const std::string &where, const Progress &progress = {});
    /// Of cloths: fabrics that differ in their colours alone are one.
    std::size_t size() const { return kept_.size(); }
    /// Forgets all: their tables have about a megabyte each.
    void clear() { kept_.clear(); }

  private:
    struct Kept {
        Specular specular;
        Material material;
    };
    std::deque<Kept> kept_{};
};

} // namespace tsuya
