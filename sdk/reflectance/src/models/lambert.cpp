#include "tsuya/sdk/lambert.h"

#include <cmath>

#include "tables/disk.h"

namespace tsuya {
namespace {
constexpr float kInversePi = 0.318309886f;
}

WeighedLight LambertCore::weigh(const glm::vec3 &to_light, const glm::vec3 &) const {
    return {albedo_ * kInversePi * to_light.z, kInversePi * to_light.z};
}

glm::vec3 LambertCore::draw(const glm::vec3 &, const glm::vec3 &u) const {
    const glm::vec2 p = disk_of_square({u.x, u.y});
    return {p, std::sqrt(1.0f - glm::dot(p, p))};
}

LambertCore::LambertCore(detail::TableReader &from) { each_part(from, *this); }

template class Model<LambertCore>;

} // namespace tsuya
