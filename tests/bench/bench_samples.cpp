// Samples per pixel: render time against the error of the picture.

#include <cmath>

#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"

namespace {

using namespace tsuya;

constexpr int kWidth = 120, kHeight = 150;
constexpr int kReferenceSamples = 2048;

const Scene &the_scene() {
    static const Scene scene = bench::sample_scene(1, kWidth, kHeight);
    return scene;
}

// Other random numbers than those that are measured
const SpectralImage &reference() {
    static const SpectralImage image =
        render(the_scene(), {.stop = {.samples_per_pixel = kReferenceSamples}, .seed = 77}).image;
    return image;
}

// Root mean square difference over root mean square of the reference, in per cent.
double relative_error(const SpectralImage &image) {
    double differences = 0, squares = 0;
    for (std::size_t i = 0; i < image.transport.size(); ++i) {
        const double r = reference().transport[i];
        differences += std::pow(image.transport[i] - r, 2);
        squares += r * r;
    }
    return 100 * std::sqrt(differences / squares);
}

void samples_per_pixel(benchmark::State &state) {
    const RenderSettings settings{.stop = {.samples_per_pixel = static_cast<int>(state.range(0))}};
    the_scene();
    SpectralImage image;
    for (auto _ : state)
        image = render(the_scene(), settings).image;
    state.counters["error"] = relative_error(image);
}
BENCHMARK(samples_per_pixel)
    ->RangeMultiplier(2)
    ->Range(1, 256)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

} // namespace
