#pragma once
// The cloths of a scene whose yarns the camera may tell apart.

#include <string>
#include <vector>

#include "tsuya/sdk/plan.h"

namespace tsuya {

// \param fabrics those of Scene::fabrics that are used
std::vector<NearCloth> near_cloths(const Scene &scene, const std::vector<bool> &fabrics);

// From which distance its yarns appear.
std::string text_of(const NearCloth &cloth);

} // namespace tsuya
