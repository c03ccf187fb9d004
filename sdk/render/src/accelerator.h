#pragma once
// The BVH: the one file of the renderer that knows Embree.

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// Where a ray hit a surface.
struct Hit {
    float distance;        // infinite for none, where packets are traced
    glm::vec3 barycentric; // weights of the three vertices
    glm::vec3 face_normal; // of the triangle's winding, not normalised
    std::uint32_t object;
    std::uint32_t triangle;
};

// Rays that lie close to each other.
struct RayPacket {
    static constexpr std::size_t kMost = 8;
    std::size_t count = 0;
    std::array<glm::vec3, kMost> origin{}, direction{};
    std::array<float, kMost> farthest{};
};

class Accelerator {
  public:
    Accelerator();
    ~Accelerator();
    Accelerator(const Accelerator &) = delete;
    Accelerator &operator=(const Accelerator &) = delete;

    // Makes it that of a scene. Throws Interrupted where progress.stop becomes true, and Error for
    // a scene too large.
    // \param centre subtracted from every position before it becomes a float
    // \param keep the next update takes over the objects that are equal in both scenes; it need not
    // find this one. Else the scene must outlive the rays
    void update(const Scene &scene, const glm::dvec3 &centre, bool keep, const Progress &progress);
    // By all updates.
    std::size_t objects_built() const;
    std::size_t objects_kept() const;

    // Nearest hit nearer than `farthest`; false where there is none.
    bool intersect(const glm::vec3 &origin, const glm::vec3 &direction, float farthest,
                   Hit &hit) const;
    bool occluded(const glm::vec3 &origin, const glm::vec3 &direction, float farthest) const;
    // The same of a packet.
    void intersect(const RayPacket &rays, std::array<Hit, RayPacket::kMost> &hits) const;
    void occluded(const RayPacket &rays, std::array<bool, RayPacket::kMost> &occluded) const;

    const std::vector<glm::vec3> &positions(std::uint32_t object) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tsuya
