#include "tsuya/sdk/render.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "denoise.h"
#include "dye_channels.h"
#include "film.h"
#include "film_keeper.h"
#include "passes.h"
#include "traced_scene.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/detail/threads.h"

namespace tsuya {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool above_zero(double v) { return v > 0 && std::isfinite(v); }

void check_settings(const Scene &scene, const RenderSettings &s) {
    Problems problems;
    problems.need(s.channels == 8 || s.channels == 16 || s.channels == 32,
                  std::to_string(s.channels) + " channels", "channels", "expected 8, 16 or 32");
    problems.need(s.stop.samples_per_pixel >= 1 && s.stop.samples_per_pixel <= 65536,
                  std::to_string(s.stop.samples_per_pixel) + " samples per pixel", "spp",
                  "expected 1 to 65536");
    problems.need(!s.denoise || s.stop.samples_per_pixel >= 2, "1 sample per pixel to be denoised",
                  "spp", "expected at least 2, whose difference tells the noise");
    problems.need(!s.stop.relative_error || above_zero(*s.stop.relative_error),
                  "the relative error is " + std::to_string(s.stop.relative_error.value_or(0)),
                  "error", "expected a number above 0, such as 0.02");
    problems.need(!s.stop.seconds || above_zero(*s.stop.seconds),
                  "the time is " + std::to_string(s.stop.seconds.value_or(0)), "time",
                  "expected seconds, above 0");
    problems.need(s.checkpoint_seconds == 0 || above_zero(s.checkpoint_seconds),
                  "the time between checkpoints is " + std::to_string(s.checkpoint_seconds),
                  "checkpoint_seconds", "expected seconds, or 0 for none but the last");
    problems.need(s.max_bounces >= 0 && s.max_bounces <= 4096,
                  std::to_string(s.max_bounces) + " bounces", "max_bounces", "expected 0 to 4096");
    problems.need(s.threads >= 0, std::to_string(s.threads) + " threads", "threads",
                  "expected 0 for all, or a number");
    if (s.crop) {
        const auto [x0, y0, x1, y1] = *s.crop;
        problems.need(x0 >= 0 && y0 >= 0 && x0 < x1 && y0 < y1 && x1 <= scene.camera.width &&
                          y1 <= scene.camera.height,
                      "the crop lies outside the picture or is empty", "crop",
                      "expected x0,y0,x1,y1 within " + std::to_string(scene.camera.width) + " x " +
                          std::to_string(scene.camera.height));
    }
    const std::vector<std::string> features = feature_names();
    for (const std::string &name : s.keep)
        problems.need(std::find(features.begin(), features.end(), name) != features.end(),
                      "no feature '" + name + "'", "keep", accepted_names(name, features));
    const std::vector<std::string> known = aov_names();
    for (const std::string &aov : s.aovs)
        problems.need(std::find(known.begin(), known.end(), aov) != known.end(),
                      "no AOV '" + aov + "'", "aov", accepted_names(aov, known));
    for (std::size_t i = 0; i < s.aovs.size(); ++i)
        problems.need(std::find(s.aovs.begin(), s.aovs.begin() + static_cast<std::ptrdiff_t>(i),
                                s.aovs[i]) == s.aovs.begin() + static_cast<std::ptrdiff_t>(i),
                      "the AOV '" + s.aovs[i] + "' is named twice", "aov", "expected each once");
    problems.throw_if_any();
}

std::string size_text(double width, double height) {
    return std::to_string(static_cast<int>(width)) + " x " +
           std::to_string(static_cast<int>(height)) + " pixels";
}

// Before any of it is taken.
void check_memory(const Scene &scene, const RenderSettings &settings) {
    const std::uint64_t bytes = Film::bytes_needed(scene, settings);
    const double width = scene.camera.width, height = scene.camera.height;
    const double scale = std::min(1.0, std::sqrt(static_cast<double>(detail::available_memory()) /
                                                 static_cast<double>(bytes)));
    detail::need_memory(bytes,
                        size_text(width, height) + " of " + std::to_string(settings.channels) +
                            " channels in " + std::to_string(scene.light_groups.size()) +
                            " light groups",
                        "camera",
                        "expected at most " + size_text(width * scale, height * scale) +
                            ", or fewer channels, light groups or AOVs");
}

RenderResult result_of(const Film &film, const Scene &scene, const RenderSettings &settings) {
    RenderResult result{.image = film.develop(scene, settings)};
    result.image.depths = depths_of(planned_dyes(scene), film.most_dye, settings.channels);
    RenderStats &stats = result.stats;
    stats.samples_per_pixel = film.samples_per_pixel();
    stats.relative_error = film.relative_error();
    stats.error_asked = settings.stop.relative_error;
    if (stats.error_asked)
        stats.error_reached_share = film.share_within(*stats.error_asked);
    stats.samples = film.samples();
    stats.widening_change = film.widening_change();
    stats.rays = film.rays;
    stats.not_finite = film.not_finite;
    for (const Object &object : scene.objects)
        stats.triangles += scene.surfaces[object.surface.value].triangle.size();
    result.image.metadata["samples_per_pixel"] = std::to_string(stats.samples_per_pixel);
    result.image.metadata["relative_error"] = std::to_string(stats.relative_error);
    if (stats.widening_change)
        result.image.metadata["widening_change"] = std::to_string(*stats.widening_change);
    result.image.metadata["seed"] = std::to_string(settings.seed);
    result.image.metadata["max_bounces"] = std::to_string(settings.max_bounces);
    result.image.metadata.merge(fabric_hashes(scene));
    if (film.not_finite > 0)
        result.warnings.push_back({std::to_string(film.not_finite) + " of " +
                                       detail::counted(film.samples(), "sample") +
                                       " left out, which are not finite",
                                   "", ""});
    return result;
}

RenderResult render_checked(const Scene &scene, const RenderSettings &settings,
                            const Progress &progress, PreparedScene *kept) {
    const Clock::time_point start = Clock::now();
    double build_seconds = 0;
    std::vector<Phase> phases;
    std::vector<Problem> of_cloths;
    PreparedScene own;
    PreparedScene &prepared = kept ? *kept : own;
    const PreparedUse before = prepared.use();
    Film film(scene, settings);
    const auto result_so_far = [&] {
        RenderResult result = result_of(film, scene, settings);
        result.stats.build_seconds = build_seconds;
        result.stats.seconds = seconds_since(start);
        result.stats.phases = phases;
        result.stats.prepared = prepared.use().since(before);
        return result;
    };
    FilmKeeper keeper(scene, settings, film, result_so_far);
    try {
        progress("prepare", 0);
        const Plan planned = plan(scene, settings);
        const TracedScene traced(scene, planned, basis_of(planned.dyes, settings.channels),
                                 prepared, kept != nullptr, progress);
        build_seconds = seconds_since(start);
        film.most_dye = traced.most_dye;
        if (const auto depths = depths_of(planned.dyes, film.most_dye, settings.channels))
            film.set_depths(*depths);
        phases = traced.phases;
        of_cloths = traced.warnings;
        const PhaseClock of_trace;
        trace_passes(traced, settings, film, keeper, progress);
        phases.push_back(of_trace.end("trace"));
    } catch (const Interrupted &) {
        // Stopped while the scene was prepared: the film has what an earlier run left
    }
    bool interrupted = progress.stopped();
    keeper.finish();
    RenderResult result = result_so_far();
    if (settings.denoise && !interrupted) {
        const PhaseClock of_denoise;
        result.stats.denoise_change = denoise(film, scene.camera, result.image, progress);
        interrupted = !result.stats.denoise_change;
        if (interrupted)
            result = result_so_far();
        else
            result.image.metadata["denoised"] = std::to_string(*result.stats.denoise_change);
        result.stats.phases.push_back(of_denoise.end("denoise"));
        result.stats.seconds = seconds_since(start);
    }
    result.stats.peak_memory_bytes = detail::peak_memory();
    result.stats.interrupted = interrupted;
    if (!interrupted && !settings.checkpoint.empty())
        result.image.metadata["render_key"] = render_key(keeper.fingerprint(), settings.stop);
    for (const Fabric &fabric : scene.fabrics)
        for (Problem &warning : fabric_warnings(fabric, "fabrics." + fabric.name))
            result.warnings.push_back(std::move(warning));
    result.warnings.insert(result.warnings.end(), of_cloths.begin(), of_cloths.end());
    if (!interrupted && result.stats.error_reached_share < 1) {
        std::ostringstream what;
        what << std::setprecision(2) << 100 * (1 - result.stats.error_reached_share)
             << " % of the picture did not reach the error of " << *settings.stop.relative_error;
        result.warnings.push_back(
            {what.str(), "", "expected more samples or time, or a larger error"});
    }
    if (keeper.problem())
        result.warnings.push_back(*keeper.problem());
    return result;
}

} // namespace

RenderResult render(const Scene &scene, const RenderSettings &asked, const Progress &progress,
                    PreparedScene *prepared) {
    check_scene(scene);
    check_settings(scene, asked);
    const RenderSettings settings = as_planned(scene, asked);
    check_memory(scene, settings);
    RenderResult result;
    detail::run_with_threads(settings.threads,
                             [&] { result = render_checked(scene, settings, progress, prepared); });
    return result;
}

} // namespace tsuya
