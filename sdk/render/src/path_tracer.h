#pragma once
// The path tracer: one sample of one pixel.

#include <cstdint>
#include <memory>
#include <vector>

#include "accelerator.h"
#include "channels.h"
#include "lights.h"
#include "sampler.h"
#include "shading.h"
#include "tsuya/sdk/frame.h"
#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// A point on a surface as it is shaded: normals and frame on the viewer's side.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 geometric_normal;
    Frame frame;
    std::uint32_t fabric;
};

// What the camera ray met; for further pictures.
struct FirstHit {
    bool hit = false;
    float distance = 0;
    glm::vec3 normal{}, warp{};
    std::uint32_t object = 0;
};

// Of the parts of a fabric's response.
template <class T> struct Colours { T dye{}, transmittance{}, weft{}, warp{}; };

// A scene made ready: independent of the number of channels.
struct PreparedScene {
    PreparedScene(const Scene &scene, const Plan &plan, bool keep_idle_parts,
                  const SpectralBasis &basis);

    const Scene &scene;
    Plan plan;
    glm::dvec3 centre;
    Accelerator accelerator;
    Lights lights;
    std::vector<Shading> shading;                     // per fabric
    std::vector<Colours<std::vector<float>>> colours; // per fabric, values per channel
    glm::vec3 eye, forward, right, up; // camera, scaled to the image plane at distance 1

    glm::vec3 camera_direction(float x, float y) const;
    SurfacePoint point(const glm::vec3 &direction, const Hit &hit) const;
};

template <int K> class PathTracer {
  public:
    explicit PathTracer(const PreparedScene &prepared);

    // Radiance of each light group through a point of the picture.
    // \param radiance `groups` values, set
    void trace(int x, int y, const Sampler &sampler, Channels<K> *radiance, std::size_t groups,
               FirstHit *first);
    std::uint64_t rays() const { return rays_; }

  private:
    struct Vertex;
    void light_directly(const Vertex &vertex, std::size_t light, float probability,
                        const Sampler &sampler, const Channels<K> &throughput,
                        Channels<K> *radiance);
    void meet_lights(const glm::vec3 &from, const glm::vec3 &direction, float distance, bool missed,
                     float pdf, std::uint32_t depth, const Channels<K> &throughput,
                     Channels<K> *radiance) const;

    const PreparedScene &p_;
    std::vector<Colours<Channels<K>>> colours_; // per fabric
    std::uint64_t rays_ = 0;
};

extern template class PathTracer<8>;
extern template class PathTracer<16>;
extern template class PathTracer<32>;

} // namespace tsuya
