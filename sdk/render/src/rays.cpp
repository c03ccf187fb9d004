#include "rays.h"

#include <limits>

namespace tsuya {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

} // namespace

void Rays::meet_first(const RayPacket &rays, std::array<Hit, RayPacket::kMost> &hits) {
    counts_.camera += rays.count;
    scene_.accelerator.intersect(rays, hits);
}

bool Rays::pass_holes_first(const Sampler &sampler, const glm::vec3 &direction, Hit &hit) {
    return !scene_.has_holes() || pass_holes(sampler, direction, true, counts_.camera, hit);
}

bool Rays::meet_next(const Sampler &sampler, const glm::vec3 &origin, const glm::vec3 &direction,
                     Hit &hit) {
    ++counts_.bounce;
    return scene_.accelerator.intersect(origin, direction, kInfinity, hit) &&
           (!scene_.has_holes() || pass_holes(sampler, direction, false, counts_.bounce, hit));
}

bool Rays::meets_any(const glm::vec3 &origin, const glm::vec3 &direction) {
    ++counts_.bounce;
    return scene_.accelerator.occluded(origin, direction, kInfinity);
}

bool Rays::pass_holes(const Sampler &sampler, const glm::vec3 &direction, bool from_camera,
                      std::uint64_t &count, Hit &hit) {
    float distance = 0;
    for (std::uint32_t layer = 0; layer < kMostHoles; ++layer) {
        distance += hit.distance;
        const float opacity =
            scene_.opacity(hit, from_camera ? scene_.camera.pixel_width(distance) : 0);
        if (opacity >= 1 ||
            sampler.lone_pair(from_camera ? layer : kMostHoles + layer).x < opacity) {
            hit.distance = distance;
            return true;
        }
        const glm::vec3 origin = scene_.behind(direction, hit);
        ++count;
        if (!scene_.accelerator.intersect(origin, direction, kInfinity, hit))
            return false;
    }
    return false;
}

float Rays::transmission(glm::vec3 origin, const glm::vec3 &direction, float distance) {
    ++counts_.shadow;
    if (!scene_.has_holes())
        return scene_.accelerator.occluded(origin, direction, distance) ? 0.0f : 1.0f;
    float passed = 1;
    Hit hit;
    for (std::uint32_t layer = 0; layer < kMostHoles; ++layer) {
        if (!scene_.accelerator.intersect(origin, direction, distance, hit))
            return passed;
        passed *= 1 - scene_.opacity(hit, 0);
        if (!(passed > 0))
            return 0;
        origin = scene_.behind(direction, hit);
        distance -= hit.distance;
        ++counts_.shadow;
    }
    return 0;
}

void Rays::occluded(const RayPacket &rays, std::array<bool, RayPacket::kMost> &occluded) {
    counts_.shadow += rays.count;
    scene_.accelerator.occluded(rays, occluded);
}

} // namespace tsuya
