#include "near_cloths.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

#include "tsuya/sdk/model.h"
#include "tsuya/sdk/near_yarn.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {
namespace {

// Where a pixel sees two repeats: from there on a weave is seen from far alone.
double near_within(const WeaveMap &map, const Camera &camera) {
    const double footprint = kFarFromRepeats * std::min(map.repeat.x, map.repeat.y);
    if (camera.orthographic_height)
        return *camera.orthographic_height / camera.height < footprint
                   ? std::numeric_limits<double>::infinity()
                   : 0;
    return footprint * camera.height / (2 * std::tan(0.5 * camera.vertical_angle));
}

} // namespace

std::vector<NearCloth> near_cloths(const Scene &scene, const std::vector<bool> &fabrics) {
    std::vector<NearCloth> cloths;
    for (std::size_t i = 0; i < scene.fabrics.size(); ++i) {
        const Fabric &fabric = scene.fabrics[i];
        if (fabrics[i] && model_of(fabric) == "yarn" && fabric.weave && fabric.weave->has_map())
            cloths.push_back({fabric.name, near_within(fabric.weave->map, scene.camera)});
    }
    return cloths;
}

std::string text_of(const NearCloth &cloth) {
    if (!(cloth.within > 0))
        return "'" + cloth.fabric + "' is seen from far alone";
    if (std::isinf(cloth.within))
        return "the yarns of '" + cloth.fabric + "' appear";
    std::ostringstream text;
    text << "the yarns of '" << cloth.fabric << "' appear nearer than " << std::setprecision(2)
         << cloth.within << " m";
    return text.str();
}

} // namespace tsuya
