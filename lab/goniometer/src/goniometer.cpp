#include "tsuya/lab/goniometer.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include <tbb/parallel_for.h>

#include "filament_scene.h"
#include "gonio_sums.h"
#include "photon_walk.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/flush_denormals.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint64_t kBatchesPerRound = 16; // of a light, between looks at its error
constexpr double kSaveEvery = 30;              // seconds
constexpr double kLeastIndex =
    1.05; // of filaments that light goes through: views see no straight ray

void check_settings(const GoniometerSettings &s) {
    Problems problems;
    const auto expect = [&](bool good, const char *where, const char *what, const char *accepted) {
        problems.need(good, what, where, accepted);
    };
    expect(s.photons > 0, "settings.photons", "there are no photons", "expected at least 1");
    expect(s.error >= 0 && s.error < 1, "settings.error", "the error is out of range",
           "expected 0 (no limit) or a share below 1");
    expect(s.seconds >= 0 && std::isfinite(s.seconds), "settings.seconds",
           "the time is out of range", "expected 0 (no limit) or more seconds");
    expect(s.threads >= 0, "settings.threads", "the number of threads is negative",
           "expected 0 (all) or more");
    expect(s.max_bounces >= 0, "settings.max_bounces", "the number of bounces is negative",
           "expected 0 (all) or more");
    expect(s.energy_bound > 0 && s.energy_bound <= 1, "settings.energy_bound",
           "the energy bound is out of range", "expected a share above 0 and up to 1");
    expect(s.turn_per_segment >= 1e-4 && s.turn_per_segment <= 1, "settings.turn_per_segment",
           "the turn per segment is out of range", "expected 0.0001 to 1 radian");
    expect(s.section_points >= 12 && s.section_points <= 256, "settings.section_points",
           "the number of points of a section is out of range", "expected 12 to 256");
    problems.throw_if_any();
}

void check_optics(const FilamentRepeat &repeat) {
    Problems problems;
    for (std::size_t i = 0; i < repeat.optics.size(); ++i) {
        const FilamentOptics &o = repeat.optics[i];
        const std::string where = "repeat.optics[" + std::to_string(i) + "].";
        problems.need(o.surface_roughness >= 0.005 && o.surface_roughness <= 0.5,
                      "the roughness is out of range", where + "surface_roughness",
                      "expected 0.005 to 0.5 radians");
        problems.need(o.refractive_index >= 1 && std::isfinite(o.refractive_index),
                      "the refractive index is out of range", where + "refractive_index",
                      "expected 1 or more");
        problems.need(o.transmission >= 0 && o.transmission <= 1,
                      "the transmission is out of range", where + "transmission",
                      "expected 0 to 1");
        problems.need(!(o.transmission > 0) || o.refractive_index >= kLeastIndex,
                      "nothing bends the light that goes through", where + "refractive_index",
                      "expected 1.05 or more where the transmission is above 0");
        problems.need(o.scattering_length >= 0 && std::isfinite(o.scattering_length),
                      "the scattering length is out of range", where + "scattering_length",
                      "expected 0 (no delustrant) or more metres");
        problems.need(std::abs(o.scattering_anisotropy) <= 0.99, "the anisotropy is out of range",
                      where + "scattering_anisotropy", "expected -0.99 to 0.99");
        problems.need(o.corner_rounding >= 0 && o.corner_rounding <= 1,
                      "the rounding of the corners is out of range", where + "corner_rounding",
                      "expected 0 to 1");
    }
    problems.throw_if_any();
}

void check_directions(const Directions &directions) {
    if (directions.pairs.empty())
        throw Error({"there is no direction to measure", "directions", "expected at least one"});
    Problems problems;
    const auto is_above = [](double theta, double phi) {
        return theta >= 0 && theta < kPi / 2 && direction_of(theta, phi).z > 0;
    };
    for (std::size_t i = 0; i < directions.pairs.size() && !problems.full(); ++i) {
        const DirectionPair &p = directions.pairs[i];
        problems.need(is_above(p.theta_i, p.phi_i) && is_above(p.theta_r, p.phi_r) &&
                          std::isfinite(p.phi_i + p.phi_r),
                      "an angle is out of range", "directions.pairs[" + std::to_string(i) + "]",
                      "expected theta from 0 and below 90 degrees, and a finite phi");
    }
    problems.throw_if_any();
}

class Goniometer {
  public:
    Goniometer(const FilamentRepeat &repeat, const Directions &directions,
               const GoniometerSettings &settings, const Progress &progress)
        : repeat_(repeat), directions_(directions), settings_(settings), progress_(progress),
          scene_(FilamentCell(repeat, settings.turn_per_segment, settings.section_points, progress),
                 progress) {
        for (const FilamentOptics &optics : repeat.optics)
            matter_.emplace_back(optics);
        group_by_light();
    }

    Measurement run();

  private:
    struct Group {
        double theta, phi;
        std::vector<std::size_t> rows;
        std::optional<LightViews> views;
    };
    struct Task {
        std::size_t light;
        std::uint64_t batch;
        Sums sums;
        std::uint64_t rays = 0;
        bool done = false;
    };

    void group_by_light();
    bool finished(const LightSums &light) const;
    bool round();
    double fraction() const;
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }
    bool out_of_time() const { return settings_.seconds > 0 && seconds() >= settings_.seconds; }
    void save();
    void report(Measurement &result) const;

    const FilamentRepeat &repeat_;
    const Directions &directions_;
    const GoniometerSettings &settings_;
    const Progress &progress_;
    FilamentScene scene_;
    std::vector<FilamentMatter> matter_;
    std::vector<Group> groups_;
    std::vector<LightSums> lights_;
    std::uint64_t photons_ = 0, rays_ = 0;
    Clock::time_point start_ = Clock::now();
    double saved_ = 0;
};

void Goniometer::group_by_light() {
    std::map<std::pair<double, double>, std::size_t> known;
    for (std::size_t i = 0; i < directions_.pairs.size(); ++i) {
        const DirectionPair &p = directions_.pairs[i];
        const auto [entry, is_new] = known.try_emplace({p.theta_i, p.phi_i}, groups_.size());
        if (is_new)
            groups_.push_back({p.theta_i, p.phi_i, {}, {}});
        groups_[entry->second].rows.push_back(i);
    }
    for (Group &group : groups_) {
        std::vector<glm::vec3> views;
        for (const std::size_t row : group.rows)
            views.emplace_back(
                direction_of(directions_.pairs[row].theta_r, directions_.pairs[row].phi_r));
        lights_.push_back({0, Sums(views.size())});
        group.views.emplace(glm::vec3(direction_of(group.theta, group.phi)), std::move(views),
                            matter_);
    }
}

bool Goniometer::finished(const LightSums &light) const {
    if (light.photons() >= settings_.photons)
        return true;
    return settings_.error > 0 && light.batches > 0 && light.batches % kBatchesPerRound == 0 &&
           light.relative_error() <= settings_.error;
}

// Some batches of every light that is not finished; false if there is none.
bool Goniometer::round() {
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (finished(lights_[i]))
            continue;
        const std::uint64_t all = (settings_.photons + kPhotonsPerBatch - 1) / kPhotonsPerBatch;
        const std::uint64_t first = lights_[i].batches;
        // Ends on a multiple, wherever an earlier run has stopped
        const std::uint64_t end = std::min(all, (first / kBatchesPerRound + 1) * kBatchesPerRound);
        for (std::uint64_t b = first; b < end; ++b)
            tasks.push_back({i, b, Sums()});
    }
    const WalkRules rules{settings_.max_bounces, settings_.energy_bound, settings_.part};
    tbb::parallel_for(std::size_t{0}, tasks.size(), [&](std::size_t t) {
        Task &task = tasks[t];
        if (progress_.stopped() || out_of_time())
            return;
        const tsuya::detail::FlushDenormals flush;
        task.sums = Sums(groups_[task.light].rows.size());
        const Random random(settings_.seed, static_cast<std::uint32_t>(task.light),
                            static_cast<std::uint32_t>(task.batch));
        task.rays = walk(scene_, matter_, *groups_[task.light].views, rules, random, task.sums);
        task.done = true;
    });
    // In the order of the batches; what comes after one that is missing is made again
    for (const Task &task : tasks) {
        LightSums &light = lights_[task.light];
        if (!task.done || light.batches != task.batch)
            continue;
        light.sums.add(task.sums);
        ++light.batches;
        photons_ += kPhotonsPerBatch;
        rays_ += task.rays;
    }
    return !tasks.empty();
}

double Goniometer::fraction() const {
    double least = 1;
    for (const LightSums &light : lights_) {
        double done = static_cast<double>(light.photons()) / static_cast<double>(settings_.photons);
        if (settings_.error > 0 && light.batches > 0)
            done = std::max(done, std::pow(settings_.error / light.relative_error(), 2));
        least = std::min(least, done);
    }
    if (settings_.seconds > 0)
        least = std::max(least, seconds() / settings_.seconds);
    return std::min(least, 1.0);
}

void Goniometer::save() {
    save_sums(lights_, fingerprint(repeat_, directions_, settings_), settings_.checkpoint);
    saved_ = seconds();
}

Measurement Goniometer::run() {
    const bool keeps = !settings_.checkpoint.empty();
    if (keeps && settings_.resume && std::filesystem::exists(settings_.checkpoint))
        load_sums(lights_, fingerprint(repeat_, directions_, settings_), settings_.checkpoint);
    Measurement result;
    while (round()) {
        progress_("measure", fraction());
        result.interrupted = progress_.stopped();
        if (result.interrupted || out_of_time())
            break;
        if (keeps && seconds() - saved_ > kSaveEvery)
            save();
    }
    const bool complete = std::all_of(lights_.begin(), lights_.end(),
                                      [&](const LightSums &light) { return finished(light); });
    if (keeps && !complete)
        save();
    result.interrupted = result.interrupted && !complete;
    report(result);
    return result;
}

void Goniometer::report(Measurement &result) const {
    result.table.symmetry = directions_.symmetry;
    std::vector<ReflectanceRow> rows(directions_.pairs.size());
    std::vector<bool> measured(rows.size());
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        const LightSums &light = lights_[g];
        for (std::size_t k = 0; k < groups_[g].rows.size(); ++k) {
            const DirectionPair &p = directions_.pairs[groups_[g].rows[k]];
            const Estimate e = estimate(light.sums.value[k], light.sums.square[k], light.photons());
            rows[groups_[g].rows[k]] = {p.theta_i, p.phi_i, p.theta_r, p.phi_r, e.mean, e.sigma};
            measured[groups_[g].rows[k]] = light.batches > 0;
        }
        const Estimate up =
            estimate(light.sums.reflected, light.sums.reflected_square, light.photons());
        const Estimate down =
            estimate(light.sums.transmitted, light.sums.transmitted_square, light.photons());
        result.lights.push_back({groups_[g].theta, groups_[g].phi, light.photons(), up.mean,
                                 up.sigma, down.mean, down.sigma, light.relative_error()});
    }
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (measured[i])
            result.table.rows.push_back(rows[i]);
    std::uint64_t most = 0;
    for (const LightSums &light : lights_)
        most = std::max(most, light.photons());
    auto &keys = result.table.keys;
    keys["instrument"] = "virtual goniometer of tsuya";
    keys["provenance"] = "simulated from the filaments of " +
                         (repeat_.name.empty() ? "an unnamed weave" : repeat_.name);
    keys["photons"] = std::to_string(most) + " per direction of light at most";
    keys["seed"] = std::to_string(settings_.seed);
    result.photons = photons_;
    result.rays = rays_;
    result.seconds = seconds();
}

} // namespace

Measurement measure(const FilamentRepeat &repeat, const Directions &directions,
                    const GoniometerSettings &settings, const Progress &progress) {
    check_settings(settings);
    check_directions(directions);
    check_repeat(repeat, "repeat");
    check_optics(repeat);
    Measurement result;
    tsuya::detail::run_with_threads(settings.threads, [&] {
        result = Goniometer(repeat, directions, settings, progress).run();
    });
    return result;
}

} // namespace tsuya::lab
