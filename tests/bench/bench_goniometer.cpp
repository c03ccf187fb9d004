// The virtual goniometer: run time against error, and how its answers settle as filaments are
// divided more finely and light is followed further.

#include <cmath>
#include <ctime>

#include <benchmark/benchmark.h>

#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/sdk/angle.h"

namespace {

using namespace tsuya;
using namespace tsuya::lab;

constexpr std::uint64_t kSettled = 1u << 20; // photons a light of a convergence run
constexpr std::uint64_t kLong = 1u << 23;    // of the run that others are compared with
constexpr std::uint32_t kOtherSeed = 99;     // of what is compared with

// Light at 45 degrees in the warp, bias and weft planes, and views all around.
Directions slanting() {
    Directions directions;
    for (const double phi_i : {90.0, 45.0, 0.0})
        for (double theta = 0; theta <= 80; theta += 10)
            for (double phi = 0; phi < (theta > 0 ? 360 : 1); phi += 15)
                directions.pairs.push_back(
                    {45 * kDegree, phi_i * kDegree, theta * kDegree, phi * kDegree});
    return directions;
}

// The satin; light comes out of its filaments again where transmission is above 0.
FilamentRepeat satin(double transmission = 0, const GeometryOptions &options = {}) {
    FilamentRepeat repeat = build_filaments(weave("black polyester satin"), options);
    for (FilamentOptics &optics : repeat.optics)
        optics.transmission = transmission;
    return repeat;
}

// Differences of two measurements as shares of the second, in per cent.
struct Difference {
    double error = 0;        // root of the summed squares of brdf x cos theta_r
    double noise = 0;        // what the standard errors let one expect of it
    double albedo_error = 0; // of the reflected energy, signed
    double albedo_noise = 0;
};

Difference difference(const Measurement &a, const Measurement &b) {
    double squares = 0, expected = 0, all = 0;
    for (std::size_t i = 0; i < a.table.rows.size(); ++i) {
        const ReflectanceRow &x = a.table.rows[i], &y = b.table.rows[i];
        const double weight = std::pow(std::cos(x.theta_r), 2) * std::sin(x.theta_r);
        squares += weight * std::pow(x.brdf_per_sr - y.brdf_per_sr, 2);
        expected += weight * (std::pow(x.sigma_per_sr, 2) + std::pow(y.sigma_per_sr, 2));
        all += weight * std::pow(y.brdf_per_sr, 2);
    }
    double albedo = 0, other = 0, variance = 0;
    for (std::size_t i = 0; i < a.lights.size(); ++i) {
        albedo += a.lights[i].reflected;
        other += b.lights[i].reflected;
        variance +=
            std::pow(a.lights[i].reflected_sigma, 2) + std::pow(b.lights[i].reflected_sigma, 2);
    }
    return {100 * std::sqrt(squares / all), 100 * std::sqrt(expected / all),
            100 * (albedo / other - 1), 100 * std::sqrt(variance) / other};
}

double cpu_seconds(std::clock_t start) {
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

// \param seconds of processor time, which others that run at the same time do not change
void report(benchmark::State &state, const Difference &d, double seconds) {
    state.counters["albedo_error"] = d.albedo_error;
    state.counters["albedo_noise"] = d.albedo_noise;
    state.counters["cpu_ms"] = 1e3 * seconds;
    state.counters["error"] = d.error;
    state.counters["noise"] = d.noise;
}

// Photons of light from straight above, 324 views: time, error against a long run, speed.
void run_photons(benchmark::State &state, const FilamentRepeat &repeat,
                 const Measurement &reference) {
    static const Directions directions = normal_incidence_quadrant(5);
    Measurement m;
    const std::clock_t start = std::clock();
    for (auto _ : state)
        m = measure(repeat, directions, {.photons = static_cast<std::uint64_t>(state.range(0))});
    const double seconds = cpu_seconds(start), millions = static_cast<double>(m.photons) * 1e-6;
    report(state, difference(m, reference), seconds);
    state.counters["photons_per_s"] = benchmark::Counter(millions, benchmark::Counter::kIsRate);
    state.counters["photons_per_cpu_s"] = millions / seconds;
}

Measurement long_run(const FilamentRepeat &repeat) {
    return measure(repeat, normal_incidence_quadrant(5), {.photons = kLong, .seed = kOtherSeed});
}

void photons(benchmark::State &state) {
    static const FilamentRepeat repeat = satin();
    static const Measurement reference = long_run(repeat);
    run_photons(state, repeat, reference);
}

void photons_through_silk(benchmark::State &state) { // dyed filaments, triangular and twisted
    static const FilamentRepeat repeat = build_filaments(weave("silk charmeuse"));
    static const Measurement reference = long_run(repeat);
    run_photons(state, repeat, reference);
}
BENCHMARK(photons_through_silk)
    ->RangeMultiplier(8)
    ->Range(1 << 14, 1 << 20)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK(photons)
    ->RangeMultiplier(2)
    ->Range(1 << 13, 1 << 20)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

// A run of `repeat` against `reference`, the finest of its kind.
void settle(benchmark::State &state, const FilamentRepeat &repeat, GoniometerSettings settings,
            const Measurement &reference) {
    settings.photons = kSettled;
    Measurement m;
    const std::clock_t start = std::clock();
    for (auto _ : state)
        m = measure(repeat, slanting(), settings);
    report(state, difference(m, reference), cpu_seconds(start));
}

Measurement finest(const FilamentRepeat &repeat, GoniometerSettings settings = {}) {
    settings.photons = 4 * kSettled;
    settings.seed = kOtherSeed;
    return measure(repeat, slanting(), settings);
}

void turn_per_segment(benchmark::State &state) { // thousandths of a radian
    static const Measurement reference = finest(satin(), {.turn_per_segment = 0.0025});
    settle(state, satin(), {.turn_per_segment = static_cast<double>(state.range(0)) * 1e-3},
           reference);
}

void section_points(benchmark::State &state) {
    static const FilamentRepeat silk = build_filaments(weave("shot silk"));
    static const Measurement reference = finest(silk, {.section_points = 192});
    settle(state, silk, {.section_points = static_cast<int>(state.range(0))}, reference);
}

void points_per_crossing(benchmark::State &state) {
    static const Measurement reference = finest(satin(0, {.points_per_crossing = 64}));
    settle(state, satin(0, {.points_per_crossing = static_cast<int>(state.range(0))}), {},
           reference);
}

constexpr double kSomeComesOut = 0.6;

void max_bounces(benchmark::State &state) {
    static const Measurement reference = finest(satin(kSomeComesOut));
    settle(state, satin(kSomeComesOut), {.max_bounces = static_cast<int>(state.range(0))},
           reference);
}

void energy_bound(benchmark::State &state) { // thousandths of the energy at the start
    static const Measurement reference = finest(satin(kSomeComesOut), {.energy_bound = 1e-4});
    settle(state, satin(kSomeComesOut),
           {.energy_bound = static_cast<double>(state.range(0)) * 1e-3}, reference);
}

void in_steps(benchmark::internal::Benchmark *bench, std::initializer_list<int> values) {
    for (const int value : values)
        bench->Arg(value);
    bench->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);
}
BENCHMARK(turn_per_segment)->Apply([](auto *b) {
    in_steps(b, {5, 10, 20, 40, 80, 160, 320, 640});
});
BENCHMARK(section_points)->Apply([](auto *b) { in_steps(b, {12, 15, 24, 36, 48, 96}); });
BENCHMARK(points_per_crossing)->Apply([](auto *b) { in_steps(b, {4, 6, 8, 12, 16, 24, 32}); });
BENCHMARK(max_bounces)->Apply([](auto *b) { in_steps(b, {1, 2, 3, 4, 6, 8, 12, 16, 32}); });
BENCHMARK(energy_bound)->Apply([](auto *b) { in_steps(b, {1, 10, 100, 300, 500, 1000}); });

} // namespace
