#include "tsuya/sdk/yarn_optics.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

// Of all cloths alike; found on five weaves, see sdk/docs/REFLECTANCE_STUDY.md
constexpr double kFlank = 0.35;        // of the filaments of a yarn
constexpr double kSecond = 0.6;        // light that meets a second filament, of what meets one
constexpr double kSecondCosine = 0.75; // mean cosine of both meetings, in the plane across
// The grooves across the yarn are this much flatter than those that would mask at the half vector:
// they bound what grazing rays see, beyond 80 degrees, and change little before
constexpr float kGrazingGroove = 6;
constexpr double kLargestIndex = 1000; // stands for f0 = 1
constexpr float kSmallest = 1e-20f;

// [Walter] Eq. 22
double dielectric(double cosine, double index) {
    const double c = std::clamp(cosine, 1e-9, 1.0);
    const double g = std::sqrt(index * index - 1 + c * c);
    const double s = (g - c) / (g + c), p = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * s * s * (1 + p * p);
}

template <std::size_t kSize> float look_up(const std::array<float, kSize> &table, float share) {
    const float x = std::clamp(share, 0.0f, 1.0f) * static_cast<float>(kSize - 1);
    const auto i = std::min(static_cast<std::size_t>(x), kSize - 2);
    const float t = x - static_cast<float>(i);
    return (1 - t) * table[i] + t * table[i + 1];
}

// A yarn at the bottom of an opening between yarns that cross it: the share of the opening's width
// that neither light nor viewer lose to its walls.
float open_share(float pit, const glm::vec2 &light, const glm::vec2 &viewer) {
    const float l = light.x / std::max(light.y, kSmallest);
    const float v = viewer.x / std::max(viewer.y, kSmallest);
    return std::max(1 - pit * (std::max({l, v, 0.0f}) - std::min({l, v, 0.0f})), 0.0f);
}

} // namespace

YarnOptics::YarnOptics(double f0) : bed_(kFlank) {
    const double root = std::sqrt(f0);
    const double index = std::min((1 + root) / std::max(1 - root, 1e-9), kLargestIndex);
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double x = static_cast<double>(i) / (kNodes - 1);
        const double twice = dielectric(kSecondCosine * std::sqrt(1 - x), index);
        fresnel_[i] = static_cast<float>(dielectric(x, index));
        second_[i] = static_cast<float>(kSecond * twice * twice);
    }
}

YarnHalf YarnOptics::half(const glm::vec3 &l, const glm::vec3 &v) const {
    const float length = std::sqrt(std::max(2 * (1 + glm::dot(l, v)), kSmallest));
    const float cosine = std::clamp(0.5f * length, 1e-10f, 1.0f);
    return {(l + v) / length, cosine, look_up(fresnel_, cosine),
            0.5f * (glm::abs(glm::vec2(l)) + glm::abs(glm::vec2(v)))};
}

YarnReach YarnOptics::reach(int axis, float pit, const YarnHalf &h, const glm::vec3 &l,
                            const glm::vec3 &v) const {
    const int across = 1 - axis;
    // The yarn's normal (along the yarn, up)
    const glm::vec2 part(h.half[axis], h.half.z);
    const glm::vec2 normal = part / std::sqrt(std::max(glm::dot(part, part), kSmallest));
    const glm::vec2 light(l[axis], l.z), viewer(v[axis], v.z);
    const float n_l = glm::dot(light, normal), n_v = glm::dot(viewer, normal);
    const float bed = bed_.at(bed_angle(l[across], n_l), bed_angle(v[across], n_v));
    const float axial = h.axial_mean[axis];
    float value = h.fresnel * bed + look_up(second_, axial * axial);
    if (pit > 0)
        value *= open_share(pit, light, viewer);
    const float grazing = kGrazingGroove * std::max(h.half.z, 0.0f) / h.cosine;
    const float grooves = 2 * normal.y;
    return {value, std::min(grooves / std::max(n_l, kSmallest), grazing),
            std::min(grooves / std::max(n_v, kSmallest), grazing)};
}

} // namespace tsuya
