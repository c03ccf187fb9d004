#pragma once
/// \file
/// From a scene to lamp-free light transport.

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/plan.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/scene.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// When a render is done: at the first that is reached.
struct StopRule {
    int samples_per_pixel = 64; ///< 1 to 65536; at most, where an error is given
    /// Each part of the picture is done when the mean standard error of its pixels is below this
    /// share of their mean value: smooth parts are done first.
    std::optional<double> relative_error{};
    std::optional<double> seconds{}; ///< not reproducible
};

struct RenderSettings {
    StopRule stop{};
    int channels = 16;    ///< 8, 16 or 32
    int max_bounces = 12; ///< 0: direct light only; 1 to 4096: further scattering
    int threads = 0;      ///< 0: all
    std::uint32_t seed = 0;
    std::optional<std::array<int, 4>> crop{}; ///< x0, y0, x1, y1 in pixels, half open
    std::vector<std::string> aovs{};          ///< of aov_names()
    bool skip =
        true; ///< false: do even what the plan shows to be idle; the picture must not change
    /// Where an interrupted render keeps what it has; empty: nowhere. A render finds its own file
    /// there and goes on when `resume` is set. Removed when the render is done.
    std::filesystem::path checkpoint{};
    bool resume = false;
};

/// Names for RenderSettings::aovs: coverage, depth, normal, warp, object.
std::vector<std::string> aov_names();

/// What a render did.
struct RenderStats {
    double samples_per_pixel = 0; ///< mean over the picture
    double seconds = 0;
    double build_seconds = 0; ///< of the acceleration structure and materials
    double relative_error = 0;
    std::uint64_t rays = 0;
    std::uint64_t not_finite = 0; ///< samples left out because they were NaN or infinite
    std::uint64_t triangles = 0;
    bool interrupted = false;
};

struct RenderResult {
    SpectralImage image{};
    RenderStats stats{};
};

/// Renders. On one build the picture is bit-identical for any number of threads, and after stop and
/// resume (stops by time excepted). Throws Error for a scene or settings that break their rules.
/// Where progress.stop becomes true, returns what it has with stats.interrupted set.
RenderResult render(const Scene &scene, const RenderSettings &settings,
                    const Progress &progress = {});

} // namespace tsuya
