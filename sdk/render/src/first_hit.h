#pragma once
// What the camera sees at a sample of a pixel: for AOVs, alpha and the denoiser.

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "traced_scene.h"

namespace tsuya {

struct FirstHit {
    bool hit = false;
    float distance = 0;
    glm::vec3 normal{}, warp{}, weft{};
    glm::vec2 uv{};
    std::array<float, 3> dye{}; // of the diffuse part, in three bands of wavelength
    ChannelValues albedo{};     // of the coloured part
    std::uint32_t object = 0, fabric = 0, panel = 0; // of the scene; of the object's surface
};

// \param point of the surface at the hit, with its colours in so many channels
FirstHit first_hit_of(const TracedScene &scene, const Hit &hit, const SurfacePoint &point,
                      const Colours &colours, int channels);

} // namespace tsuya
