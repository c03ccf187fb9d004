#include "tsuya/sdk/lambert.h"

#include <cmath>

#include "tables/disk.h"

namespace tsuya {
namespace {
constexpr float kInversePi = 0.318309886f;
}

float LambertBrdf::evaluate(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return to_light.z > 0 && to_viewer.z > 0 ? albedo_ * kInversePi : 0.0f;
}

float LambertBrdf::evaluate_cos(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return evaluate(to_light, to_viewer) * to_light.z;
}

std::optional<SampledDirection> LambertBrdf::sample(const glm::vec3 &to_viewer,
                                                    const glm::vec3 &u) const {
    if (!(to_viewer.z > 0))
        return std::nullopt;
    const glm::vec2 p = disk_of_square({u.x, u.y});
    const float z = std::sqrt(1.0f - glm::dot(p, p));
    if (!(z > 0))
        return std::nullopt;
    return SampledDirection{{p.x, p.y, z}, albedo_, z * kInversePi};
}

std::optional<SampledDirection> LambertBrdf::sample_adjoint(const glm::vec3 &to_light,
                                                            const glm::vec3 &u) const {
    return sample(to_light, u);
}

float LambertBrdf::pdf(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return to_light.z > 0 && to_viewer.z > 0 ? kInversePi * to_light.z : 0.0f;
}

WeighedLight LambertBrdf::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return {evaluate_cos(to_light, to_viewer), pdf(to_light, to_viewer)};
}

float LambertBrdf::pdf_adjoint(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const {
    return pdf(to_viewer, to_light);
}

float LambertBrdf::albedo_of_light(const glm::vec3 &to_light) const {
    return to_light.z > 0 ? albedo_ : 0.0f;
}

float LambertBrdf::albedo_of_view(const glm::vec3 &to_viewer) const {
    return albedo_of_light(to_viewer);
}

} // namespace tsuya
