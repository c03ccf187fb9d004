#include "tsuya/sdk/render.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <numeric>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "film.h"
#include "path_tracer.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using Clock = std::chrono::steady_clock;

// Samples that every pixel gets before any gets more: how often stop rules are looked at.
constexpr int kSamplesPerPass = 8;
// Passes before an estimate of the error is trusted.
constexpr int kLeastPasses = 2;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Denormal numbers count as 0 on this thread while it lives: they are slow, and mean nothing here.
class FlushDenormals {
  public:
#if defined(__x86_64__)
    FlushDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ | 0x8040u); }
    ~FlushDenormals() { _mm_setcsr(saved_); }

  private:
    unsigned saved_;
#endif
};

void check_settings(const Scene &scene, const RenderSettings &s) {
    std::vector<Problem> problems;
    const auto need = [&](bool rule, std::string what, std::string where, std::string accepted) {
        if (!rule)
            problems.push_back({std::move(what), std::move(where), std::move(accepted)});
    };
    need(s.channels == 8 || s.channels == 16 || s.channels == 32,
         std::to_string(s.channels) + " channels", "channels", "expected 8, 16 or 32");
    need(s.stop.samples_per_pixel >= 1 && s.stop.samples_per_pixel <= 65536,
         std::to_string(s.stop.samples_per_pixel) + " samples per pixel", "spp",
         "expected 1 to 65536");
    need(!s.stop.relative_error || *s.stop.relative_error > 0, "the error is not above 0", "error",
         "expected such as 0.02");
    need(!s.stop.seconds || *s.stop.seconds > 0, "the time is not above 0", "time",
         "expected seconds");
    need(s.max_bounces >= 0 && s.max_bounces <= 4096, std::to_string(s.max_bounces) + " bounces",
         "max_bounces", "expected 0 to 4096");
    need(s.threads >= 0, std::to_string(s.threads) + " threads", "threads",
         "expected 0 for all, or a number");
    if (s.crop) {
        const auto [x0, y0, x1, y1] = *s.crop;
        need(x0 >= 0 && y0 >= 0 && x0 < x1 && y0 < y1 && x1 <= scene.camera.width &&
                 y1 <= scene.camera.height,
             "the crop lies outside the picture or is empty", "crop",
             "expected x0,y0,x1,y1 within " + std::to_string(scene.camera.width) + " x " +
                 std::to_string(scene.camera.height));
    }
    const std::vector<std::string> known = aov_names();
    for (const std::string &aov : s.aovs)
        need(std::find(known.begin(), known.end(), aov) != known.end(),
             "no further picture '" + aov + "'", "aov", accepted_names(aov, known));
    if (!problems.empty())
        throw Error(std::move(problems));
}

void add_first_hit(Film &film, const RenderSettings &settings, int x, int y,
                   const FirstHit &first) {
    if (!first.hit)
        return;
    for (std::size_t i = 0; i < settings.aovs.size(); ++i) {
        float *const to = film.aov_sums[i].pixel(x, y);
        const std::string &name = settings.aovs[i];
        const glm::vec3 direction = name == "warp" ? first.warp : first.normal;
        if (name == "coverage")
            to[0] += 1;
        else if (name == "depth")
            to[0] += first.distance;
        else if (name == "object")
            to[0] += static_cast<float>(first.object + 1);
        else
            for (int c = 0; c < 3; ++c)
                to[c] += direction[c];
    }
}

// One render of one number of channels.
template <int K> class Job {
  public:
    Job(const PreparedScene &prepared, const RenderSettings &settings, Film &film,
        const Progress &progress)
        : prepared_(prepared), settings_(settings), film_(film), progress_(progress) {}

    void run() {
        const Clock::time_point start = Clock::now();
        // More threads than processors only where they are asked for
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                        static_cast<std::size_t>(std::max(
                                            settings_.threads, tbb::info::default_concurrency())));
        tbb::task_arena arena(settings_.threads > 0 ? settings_.threads
                                                    : tbb::task_arena::automatic);
        const StopRule &stop = settings_.stop;
        for (int from = 0; from < stop.samples_per_pixel && !progress_.stopped();
             from += kSamplesPerPass) {
            const int to = std::min(from + kSamplesPerPass, stop.samples_per_pixel);
            arena.execute([&] { pass(from, to); });
            film_.rays += rays_.exchange(0);
            film_.not_finite += not_finite_.exchange(0);
            if (stop.seconds && seconds_since(start) >= *stop.seconds)
                break;
            if (all_good_enough())
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
    bool all_good_enough() const {
        for (std::size_t t = 0; t < film_.tiles.size(); ++t)
            if (!good_enough(t))
                return false;
        return true;
    }

    void pass(int from, int to) {
        std::atomic<std::size_t> finished{0};
        tbb::parallel_for(std::size_t{0}, film_.tiles.size(), [&](std::size_t t) {
            if (progress_.stopped())
                return;
            const FlushDenormals flush;
            // A tile may have this pass's samples from a checkpoint, or have had enough before
            if (film_.done[t] < to && !good_enough(t)) {
                render_tile(film_.tiles[t], std::max(from, film_.done[t]), to);
                film_.done[t] = to;
            }
            const std::size_t n = ++finished;
            if (const std::unique_lock lock(reporting_, std::try_to_lock); lock)
                progress_("render", (from + (to - from) * static_cast<double>(n) /
                                                static_cast<double>(film_.tiles.size())) /
                                        settings_.stop.samples_per_pixel);
        });
    }

    void render_tile(const Tile &tile, int from, int to) {
        PathTracer<K> tracer(prepared_);
        std::vector<Channels<K>> radiance(film_.groups);
        std::uint64_t not_finite = 0;
        for (int y = tile.y0; y < tile.y1; ++y)
            for (int x = tile.x0; x < tile.x1; ++x)
                for (int s = from; s < to; ++s) {
                    const std::uint32_t seed =
                        hash(hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)),
                             settings_.seed);
                    FirstHit first;
                    tracer.trace(x, y, Sampler(seed, static_cast<std::uint32_t>(s)),
                                 radiance.data(), radiance.size(),
                                 settings_.aovs.empty() ? nullptr : &first);
                    add_first_hit(film_, settings_, x, y, first);
                    not_finite += add(x, y, radiance) ? 0 : 1;
                }
        rays_ += tracer.rays();
        not_finite_ += not_finite;
    }

    // Adds one sample; false where it is left out because it is not finite.
    bool add(int x, int y, const std::vector<Channels<K>> &radiance) {
        float mean = 0;
        for (const Channels<K> &c : radiance)
            mean += c.mean() / static_cast<float>(radiance.size());
        if (!std::isfinite(mean))
            return false;
        float *to = film_.pixel(x, y);
        for (const Channels<K> &c : radiance)
            for (std::size_t k = 0; k < K; ++k)
                *to++ += c.v[k];
        film_.sum_of_squares[film_.at(x, y)] += mean * mean;
        return true;
    }

    const PreparedScene &prepared_;
    const RenderSettings &settings_;
    Film &film_;
    const Progress &progress_;
    std::atomic<std::uint64_t> rays_{0}, not_finite_{0};
    std::mutex reporting_;
};

void run_job(const PreparedScene &prepared, const RenderSettings &settings, Film &film,
             const Progress &progress) {
    switch (settings.channels) {
    case 8:
        return Job<8>(prepared, settings, film, progress).run();
    case 16:
        return Job<16>(prepared, settings, film, progress).run();
    default:
        return Job<32>(prepared, settings, film, progress).run();
    }
}

} // namespace

std::vector<std::string> aov_names() { return {"coverage", "depth", "normal", "warp", "object"}; }

RenderResult render(const Scene &scene, const RenderSettings &settings, const Progress &progress) {
    check_scene(scene);
    check_settings(scene, settings);
    const Clock::time_point start = Clock::now();
    Film film(scene, settings);
    const bool keeps = !settings.checkpoint.empty();
    const std::uint64_t print = keeps ? fingerprint(scene, settings) : 0;
    if (keeps && settings.resume && std::filesystem::exists(settings.checkpoint))
        load_checkpoint(film, print, settings.checkpoint);

    progress("prepare", 0);
    const PreparedScene prepared(scene, plan(scene, settings), !settings.skip,
                                 {.count = settings.channels});
    RenderResult result;
    result.stats.build_seconds = seconds_since(start);
    run_job(prepared, settings, film, progress);

    RenderStats &stats = result.stats;
    stats.interrupted = progress.stopped();
    stats.samples_per_pixel = std::accumulate(film.done.begin(), film.done.end(), 0.0) /
                              static_cast<double>(film.done.size());
    stats.relative_error = film.relative_error();
    stats.rays = film.rays;
    stats.not_finite = film.not_finite;
    for (const Object &object : scene.objects)
        stats.triangles += scene.surfaces[object.surface.value].triangle.size();
    if (keeps && stats.interrupted)
        save_checkpoint(film, print, settings.checkpoint);
    else if (keeps)
        std::filesystem::remove(settings.checkpoint);
    result.image = film.develop(scene, settings);
    result.image.metadata["samples_per_pixel"] = std::to_string(stats.samples_per_pixel);
    result.image.metadata["seed"] = std::to_string(settings.seed);
    stats.seconds = seconds_since(start);
    return result;
}

} // namespace tsuya
