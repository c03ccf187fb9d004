#pragma once
// The path tracer: one sample of one pixel.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "channels.h"
#include "first_hit.h"
#include "light_split.h"
#include "rays.h"
#include "sampler.h"
#include "traced_scene.h"

namespace tsuya {

class Vertex;

template <int K> class PathTracer {
  public:
    explicit PathTracer(const TracedScene &scene) : scene_(scene), rays_(scene) {}

    // One sample in so many tells what wider lobes change.
    static constexpr std::size_t kTelling = 8;

    // Transport of each light group through random points of a pixel.
    // \param samplers one a sample; a packet of them is traced together
    // \param radiance for each sample `groups` values, set
    // \param first for each sample, set where the camera ray hits; may be null
    // \param parts of the radiance, added to
    void trace(int x, int y, std::span<const Sampler> samplers, Channels<K> *radiance,
               std::size_t groups, FirstHit *first, const LightParts<K> &parts);
    // Traced so far.
    const RayCounts &rays() const { return rays_.counts(); }
    // By how much wider lobes changed the transport of all samples that tell it: the mean over
    // channels of the sum over groups.
    double change_by_widening() const { return change_; }
    std::uint64_t told() const { return told_; }

  private:
    struct Path;
    struct Place;
    // A ray to a light, and what it brings where nothing is in its way.
    struct ShadowRay {
        glm::vec3 origin, direction;
        float distance;
        Channels<K> *to;
        Channels<K> brings;
    };
    void follow(Path &path, Hit &hit, FirstHit *first);
    void add_shadow_rays();
    bool find_next(const Path &path, Hit &hit);
    void sample_lights(const Path &path, const Place &at);
    void sample_light(const Path &path, const Place &at, const ChosenLight &chosen,
                      std::uint32_t which);
    void tell_change(const Path &path, const Channels<K> &factor, const Channels<K> &plain,
                     float scale);
    void add_lights_met(const Path &path, const Vertex &vertex, float distance, float pdf);
    float light_share(const Path &path, const Vertex &vertex, std::size_t light) const;
    bool every_light(const Path &path) const;
    std::uint32_t chosen_lights(const Path &path) const;
    bool is_last(const Path &path) const;
    bool survives(Path &path) const;

    const TracedScene &scene_;
    Rays rays_;
    std::vector<ShadowRay> shadow_rays_{}; // of the camera's vertices, to be traced in packets
    LightSplit<K> split_{};
    std::vector<Channels<K>> shadow_surface_{}; // of shadow_rays_, where the split is wanted
    double change_ = 0;
    std::uint64_t told_ = 0;
};

extern template class PathTracer<8>;
extern template class PathTracer<16>;
extern template class PathTracer<32>;

} // namespace tsuya
