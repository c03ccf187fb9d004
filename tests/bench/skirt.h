#pragma once
// A scene of the sdk alone on which the renderer is measured.

#include "tsuya/sdk/scene.h"

namespace tsuya::bench {

// A pleated skirt of 50,000 quads on a plane.
// \param lights square lamps of .3 m on an arc in front of the skirt
Scene skirt(const Fabric &fabric, int lights, int size);

} // namespace tsuya::bench
