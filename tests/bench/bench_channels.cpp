// Spectral channels K: render time against the colour error over dyes and lamps.

#include <algorithm>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"

namespace {

using namespace tsuya;

// A dye as it is and as light has it after meeting it twice.
std::vector<Spectrum> reflectances() {
    std::vector<Spectrum> all;
    for (const std::string &name : dye_names())
        for (const int meetings : {1, 2}) {
            Spectrum s;
            s.wavelength_nm.clear();
            s.value.clear();
            for (int nm = 360; nm <= 830; ++nm) {
                const double r = dye(name).at(nm);
                s.wavelength_nm.push_back(nm);
                s.value.push_back(meetings == 1 ? r : r * r);
            }
            all.push_back(s);
        }
    return all;
}

// CIEDE2000 of K channels against integration at 1 nm, over all dyes and lamps. The transport of
// two meetings is the product of channels, as the path tracer has it.
std::vector<double> color_errors(int channels) {
    const SpectralBasis basis = SpectralBasis::of_renders(channels);
    std::vector<double> errors;
    const std::vector<Spectrum> spectra = reflectances();
    for (const std::string &name : lamp_names()) {
        const Spectrum light = lamp(name);
        const auto matrix = lamp_matrix(light, basis);
        const glm::dvec3 white = white_of(light);
        for (std::size_t i = 0; i < spectra.size(); ++i) {
            std::vector<float> t = project(spectra[i & ~std::size_t{1}], basis);
            glm::dvec3 xyz(0);
            for (std::size_t k = 0; k < t.size(); ++k)
                xyz += matrix[k] * static_cast<double>(i % 2 ? t[k] * t[k] : t[k]);
            errors.push_back(
                ciede2000(lab_of(xyz, white), lab_of(xyz_of(light, spectra[i]), white)));
        }
    }
    std::sort(errors.begin(), errors.end());
    return errors;
}

void channels(benchmark::State &state) {
    const int count = static_cast<int>(state.range(0));
    static const Scene scene = bench::sample_scene(1, 200, 250);
    for (auto _ : state)
        render(scene, {.stop = {.samples_per_pixel = 8}, .channels = count});
    const std::vector<double> errors = color_errors(count);
    double sum = 0;
    for (const double e : errors)
        sum += e;
    state.counters["error"] = sum / static_cast<double>(errors.size());
    state.counters["error_p99"] = errors[errors.size() * 99 / 100];
}
BENCHMARK(channels)
    ->Arg(8)
    ->Arg(16)
    ->Arg(32)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

} // namespace
