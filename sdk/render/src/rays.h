#pragma once
// Rays through a scene, each with what it meets and where cloth with holes lets it through; counted
// by their kind. The short rays by which a vertex finds its smooth surface are not among them.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "accelerator.h"
#include "sampler.h"
#include "traced_scene.h"
#include "tsuya/sdk/render.h"

namespace tsuya {

// The rays of one thread.
class Rays {
  public:
    explicit Rays(const TracedScene &scene) : scene_(scene) {}

    // Behind as many layers of holes a ray meets nothing.
    static constexpr std::uint32_t kMostHoles = 64;
    // As many lone pairs of a vertex are those of holes: of its camera ray, and of its next ray.
    static constexpr std::uint32_t kLonePairs = 2 * kMostHoles;

    // What rays of the camera meet, holes or not.
    void meet_first(const RayPacket &rays, std::array<Hit, RayPacket::kMost> &hits);
    // From a hit of a camera ray on through holes, each by chance; false where it meets nothing.
    // \param sampler of the path, at its first vertex
    bool pass_holes_first(const Sampler &sampler, const glm::vec3 &direction, Hit &hit);
    // What a ray from a path's vertex meets, past holes; false where it meets nothing.
    bool meet_next(const Sampler &sampler, const glm::vec3 &origin, const glm::vec3 &direction,
                   Hit &hit);
    // Whether a ray from a path's vertex meets anything, in a scene without holes.
    bool meets_any(const glm::vec3 &origin, const glm::vec3 &direction);
    // The share of light that arrives from a distance.
    float transmission(glm::vec3 origin, const glm::vec3 &direction, float distance);
    // Whether light is kept from arriving, in a scene without holes.
    void occluded(const RayPacket &rays, std::array<bool, RayPacket::kMost> &occluded);

    // Traced so far.
    const RayCounts &counts() const { return counts_; }

  private:
    // \param from_camera the ray is the camera's, whose numbers are its own
    // \param count of the rays that it takes
    bool pass_holes(const Sampler &sampler, const glm::vec3 &direction, bool from_camera,
                    std::uint64_t &count, Hit &hit);

    const TracedScene &scene_;
    RayCounts counts_{};
};

} // namespace tsuya
