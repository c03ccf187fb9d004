#pragma once
// Rules that several parts of a scene have.

#include <string>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

// Within kLargestLength.
bool is_length(const glm::dvec3 &v);
// 0 to kLargestRadiance.
bool is_radiance(double v);
std::string plain_number(double v);
// What would be accepted.
std::string lengths_text();
std::string radiances_text();

// Notes the broken rules of a light, but for its group.
void check_light(const RectangleLight &light, const std::string &where, Problems &problems);
void check_light(const DiskLight &light, const std::string &where, Problems &problems);
void check_light(const SphereLight &light, const std::string &where, Problems &problems);
void check_light(const PointLight &light, const std::string &where, Problems &problems);
void check_light(const SunLight &light, const std::string &where, Problems &problems);

} // namespace tsuya
