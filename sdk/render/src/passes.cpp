#include "passes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <span>
#include <utility>

#include <tbb/parallel_for.h>

#include "film_aovs.h"
#include "path_tracer.h"
#include "tsuya/sdk/detail/flush_denormals.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using Clock = std::chrono::steady_clock;

// Samples that every pixel gets before any gets more: how often stop rules are looked at.
constexpr int kSamplesPerPass = 8;
// Passes before an estimate of the error is trusted.
constexpr int kLeastPasses = 2;
// Largest share of samples that are not finite: those that remain are too biased then.
constexpr double kMostNotFinite = 0.01;

void add_features(Film &film, int x, int y, const FirstHit &first) {
    if (!first.hit)
        return;
    float *to = film.features.data() + film.at(x, y) * kFeatures;
    for (const glm::vec3 &direction : {first.normal, first.warp})
        for (int c = 0; c < 3; ++c)
            *to++ += direction[c];
    for (const float band : first.dye)
        *to++ += band;
    *to++ += first.distance;
    *to += static_cast<float>(first.object + 1);
}

// All passes of one render with K channels.
template <int K> class Passes {
  public:
    Passes(const TracedScene &prepared, const RenderSettings &settings, Film &film,
           FilmKeeper &keeper, const Progress &progress)
        : prepared_(prepared), settings_(settings), film_(film), keeper_(keeper),
          progress_(progress), aovs_(prepared.scene, film) {}

    void run() {
        const Clock::time_point start = Clock::now();
        const double seconds_before = film_.seconds;
        const StopRule &stop = settings_.stop;
        for (int from = 0; from < stop.samples_per_pixel; from += kSamplesPerPass) {
            const int to = std::min(from + kSamplesPerPass, stop.samples_per_pixel);
            for (bool whole = false; !whole;) {
                whole = pass(from, to);
                film_.rays += std::exchange(rays_, {});
                film_.not_finite += not_finite_.exchange(0);
                film_.seconds =
                    seconds_before + std::chrono::duration<double>(Clock::now() - start).count();
                if (progress_.stopped())
                    return;
                keeper_.serve();
            }
            if (from == 0)
                check_finite();
            if (stop.relative_error)
                film_.find_dark();
            if (stop.seconds && film_.seconds >= *stop.seconds)
                break;
            reached_ = share_good_enough();
            if (reached_ >= 1)
                break;
        }
    }

  private:
    // Whether a tile needs no more samples. Looks at the tile alone, so that neither threads nor an
    // interruption change what is rendered.
    bool good_enough(std::size_t tile) const {
        return settings_.stop.relative_error &&
               film_.done[tile] >= kLeastPasses * kSamplesPerPass &&
               film_.relative_error(tile) <= *settings_.stop.relative_error;
    }
    double share_good_enough() const {
        std::size_t enough = 0;
        for (std::size_t t = 0; t < film_.tiles.size(); ++t)
            enough += good_enough(t) ? 1 : 0;
        return static_cast<double>(enough) / static_cast<double>(film_.tiles.size());
    }

    void check_finite() const {
        const std::uint64_t samples = film_.samples();
        if (static_cast<double>(film_.not_finite) > kMostNotFinite * static_cast<double>(samples))
            throw Error({std::to_string(film_.not_finite) + " of the first " +
                             std::to_string(samples) + " samples are not finite",
                         "scene", "expected lengths, lights and colours that float numbers hold"});
    }

    // Brings the tiles from `from` to `to` samples per pixel. Ends early, with whole tiles and at
    // least one of them done, where the render is stopped or the keeper waits.
    // \return whether all tiles are done
    bool pass(int from, int to) {
        std::atomic<std::size_t> finished{0};
        std::atomic<bool> pause{false};
        tbb::parallel_for(std::size_t{0}, film_.tiles.size(), [&](std::size_t t) {
            if (progress_.stopped() || pause.load(std::memory_order_relaxed))
                return;
            // A tile may have this pass's samples from before a pause, or have had enough
            if (film_.done[t] < to && !good_enough(t)) {
                const detail::FlushDenormals flush;
                render_tile(t, std::max(from, film_.done[t]), to);
                film_.done[t] = to;
                if (keeper_.is_due())
                    pause = true;
            }
            report(from, to, ++finished);
        });
        return finished == film_.tiles.size();
    }

    void report(int from, int to, std::size_t finished) {
        const std::unique_lock lock(reporting_, std::try_to_lock);
        if (!lock)
            return;
        const double passed =
            static_cast<double>(finished) / static_cast<double>(film_.tiles.size());
        const double of_most = (from + (to - from) * passed) / settings_.stop.samples_per_pixel;
        progress_("render", std::max(of_most, reached_));
    }

    void render_tile(std::size_t t, int from, int to) {
        const Tile &tile = film_.tiles[t];
        PathTracer<K> tracer(prepared_);
        const auto samples = static_cast<std::size_t>(to - from);
        std::vector<Channels<K>> radiance(samples * film_.groups);
        std::vector<Sampler> samplers;
        std::vector<FirstHit> first;
        const std::size_t part_count = aovs_.want_light_parts() ? radiance.size() : 0;
        std::vector<Channels<K>> direct(part_count), surface(part_count);
        LightParts<K> parts;
        if (part_count > 0)
            parts = {direct.data(), surface.data()};
        std::uint64_t not_finite = 0;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x) {
                samplers.clear();
                for (int s = from; s < to; ++s)
                    samplers.push_back(sampler_of(x, y, static_cast<std::uint32_t>(s)));
                const bool wanted = settings_.denoise || aovs_.want_first_hit();
                first.assign(wanted ? samples : 0, FirstHit{});
                std::fill(direct.begin(), direct.end(), Channels<K>{});
                std::fill(surface.begin(), surface.end(), Channels<K>{});
                tracer.trace(x, y, samplers, radiance.data(), film_.groups,
                             first.empty() ? nullptr : first.data(), parts);
                for (const FirstHit &hit : first) {
                    aovs_.add(x, y, hit);
                    if (settings_.denoise)
                        add_features(film_, x, y, hit);
                }
                for (std::size_t i = 0; i < samples; ++i) {
                    const bool even = (static_cast<std::size_t>(from) + i) % 2 == 0;
                    const std::size_t begin = i * film_.groups;
                    const auto sample =
                        std::span<const Channels<K>>(radiance).subspan(begin, film_.groups);
                    if (!add(x, y, even ? 1.0f : -1.0f, sample))
                        ++not_finite;
                    else if (part_count > 0)
                        aovs_.add(x, y, sample, parts.direct + begin, parts.surface + begin);
                }
            }
        {
            const std::lock_guard lock(counting_);
            rays_ += tracer.rays();
        }
        if (!film_.change.empty()) {
            film_.change[t] += tracer.change_by_widening();
            film_.told[t] += tracer.told();
        }
        not_finite_ += not_finite;
    }

    Sampler sampler_of(int x, int y, std::uint32_t sample) const {
        const std::uint32_t seed = hash(
            hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), settings_.seed);
        if (!film_.is_split(x, y))
            return {seed, sample};
        return {hash(seed, 1 + sample % 2), sample / 2};
    }

    // Adds one sample; false where it is left out because it is not finite.
    // \param sign in the film's difference
    bool add(int x, int y, float sign, std::span<const Channels<K>> radiance) {
        float mean = 0;
        for (const Channels<K> &c : radiance)
            mean += c.mean() / static_cast<float>(radiance.size());
        if (!std::isfinite(mean))
            return false;
        float *to = film_.pixel(x, y);
        for (const Channels<K> &c : radiance)
            for (std::size_t k = 0; k < K; ++k)
                *to++ += c.v[k];
        film_.difference[film_.at(x, y)] += sign * mean;
        if (!film_.depth_difference.empty())
            add_depths(x, y, sign, radiance);
        if (settings_.denoise && sign < 0) {
            float *odd = film_.odd_sum.data() + (film_.pixel(x, y) - film_.sum.data());
            for (const Channels<K> &c : radiance)
                for (std::size_t k = 0; k < K; ++k)
                    *odd++ += c.v[k];
        }
        return true;
    }

    // To what tells the errors at depths of dye.
    void add_depths(int x, int y, float sign, std::span<const Channels<K>> radiance) {
        for (std::size_t judged = 0; judged < kJudgedDepths; ++judged) {
            float sum = 0;
            for (const Channels<K> &c : radiance)
                sum += c.v[film_.judged_channel[judged]];
            film_.depth_difference[kJudgedDepths * film_.at(x, y) + judged] +=
                sign * sum / static_cast<float>(radiance.size());
        }
    }

    const TracedScene &prepared_;
    const RenderSettings &settings_;
    Film &film_;
    FilmKeeper &keeper_;
    const Progress &progress_;
    FilmAovs aovs_;
    std::atomic<std::uint64_t> not_finite_{0};
    RayCounts rays_{};
    std::mutex counting_; // of rays
    double reached_ = 0;  // part of the tiles that had enough before the pass
    std::mutex reporting_;
};

} // namespace

void trace_passes(const TracedScene &prepared, const RenderSettings &settings, Film &film,
                  FilmKeeper &keeper, const Progress &progress) {
    switch (settings.channels) {
    case 8:
        return Passes<8>(prepared, settings, film, keeper, progress).run();
    case 16:
        return Passes<16>(prepared, settings, film, keeper, progress).run();
    default:
        return Passes<32>(prepared, settings, film, keeper, progress).run();
    }
}

} // namespace tsuya
