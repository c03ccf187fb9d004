#pragma once
// The parts of what one sample adds to the transport, for AOVs: direct light, which arrives at the
// camera's vertex straight from a light, and the share that the surface of its fibres reflects.
// What the camera sees of lights is both.

#include <algorithm>
#include <vector>

#include "channels.h"
#include "coloured.h"

namespace tsuya {

// Sums of the parts, each laid out as the sum of the transport; null where they are not wanted.
template <int K> struct LightParts { Channels<K> *direct = nullptr, *surface = nullptr; };

// Follows the samples of a pixel, one after the other.
template <int K> class LightSplit {
  public:
    // \param whole the sums of the transport, of `groups` values a sample
    void start(const LightParts<K> &parts, const Channels<K> *whole, std::size_t groups) {
        parts_ = parts;
        whole_ = whole;
        groups_ = groups;
    }
    bool is_wanted() const { return parts_.direct != nullptr; }

    // The camera sees a light. \param to its place among the sums
    void add_seen(const Channels<K> *to, const Channels<K> &light, float scale) {
        add_sampled(to, light, light, scale);
    }
    // A light that was sampled at the camera's vertex arrived, scaled by `arrives`.
    void add_sampled(const Channels<K> *to, const Channels<K> &all, const Channels<K> &surface,
                     float arrives) {
        const std::ptrdiff_t place = to - whole_;
        parts_.direct[place].add(all, arrives);
        parts_.surface[place].add(surface, arrives);
    }
    // The path goes on from the camera's vertex by this response.
    void leave(const Channels<K> *sample, const Response &response, const Colours &colours,
               const Channels<K> &throughput, float pdf) {
        left_ = true;
        before_.assign(sample, sample + groups_);
        share_ = coloured_surface<K>(response, colours, 1 / pdf);
        for (std::size_t k = 0; k < K; ++k)
            share_.v[k] =
                throughput.v[k] > 0 ? std::min(share_.v[k] / throughput.v[k], 1.0f) : 0.0f;
    }
    // The ray from there met its lights.
    void add_met(const Channels<K> *sample) {
        for (std::size_t g = 0; g < groups_; ++g)
            for (std::size_t k = 0; k < K; ++k)
                parts_.direct[sample - whole_ + static_cast<std::ptrdiff_t>(g)].v[k] +=
                    sample[g].v[k] - before_[g].v[k];
    }
    // The path ended.
    void end(const Channels<K> *sample) {
        for (std::size_t g = 0; left_ && g < groups_; ++g)
            for (std::size_t k = 0; k < K; ++k)
                parts_.surface[sample - whole_ + static_cast<std::ptrdiff_t>(g)].v[k] +=
                    share_.v[k] * (sample[g].v[k] - before_[g].v[k]);
        left_ = false;
    }

  private:
    LightParts<K> parts_{};
    const Channels<K> *whole_ = nullptr;
    std::size_t groups_ = 0;
    bool left_ = false;
    std::vector<Channels<K>> before_{}; // of the sample, before its path went on
    Channels<K> share_{};               // of the surface in what the path brings after that
};

} // namespace tsuya
