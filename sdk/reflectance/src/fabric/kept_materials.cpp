#include "tsuya/sdk/kept_materials.h"

#include <algorithm>

namespace tsuya {

Material KeptMaterials::resolve(const Fabric &fabric, const std::string &where,
                                const Progress &progress) {
    const auto known = std::find_if(kept_.begin(), kept_.end(),
                                    [&](const Kept &k) { return k.specular == fabric.specular; });
    if (known == kept_.end()) {
        Material made = tsuya::resolve(fabric, where, progress);
        kept_.push_back({fabric.specular, made});
        return made;
    }
    Material made = tsuya::resolve(fabric, where, known->material, progress);
    // One with a body, so that the next dye need not make it again
    if (made.body && !known->material.body)
        known->material = made;
    return made;
}

} // namespace tsuya
