// One render whose channels are depths of the dye: every dye under every lamp from it, against a
// render of each dye over wavelengths, and those against each other with another seed.

#include <algorithm>
#include <ctime>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"

namespace {

using namespace tsuya;

constexpr int kSamples = 64;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

RenderResult rendered(const Scene &scene, int channels, std::uint32_t seed,
                      PreparedScene &prepared) {
    return scene::render_try_on(
        scene, {.stop = {.samples_per_pixel = kSamples}, .channels = channels, .seed = seed}, {},
        &prepared);
}

// CIEDE2000 of the dress's pixels under all lamps, and of their mean colours.
struct Differences {
    std::vector<double> pixels{}, means{};

    void add(const SpectralImage &a, const SpectralImage &b) {
        const Image &coverage = b.aovs.at(0);
        for (const std::string &name : lamp_names()) {
            const Spectrum light = lamp(name);
            const glm::dvec3 white = white_of(light);
            const Image of_a = relight(a, light), of_b = relight(b, light);
            glm::dvec3 sum_a(0), sum_b(0);
            for (int y = 0; y < b.height; ++y)
                for (int x = 0; x < b.width; ++x) {
                    if (*coverage.pixel(x, y) < 1)
                        continue;
                    const float *const p = of_a.pixel(x, y), *const q = of_b.pixel(x, y);
                    const glm::dvec3 from(p[0], p[1], p[2]), to(q[0], q[1], q[2]);
                    pixels.push_back(ciede2000(lab_of(from, white), lab_of(to, white)));
                    sum_a += from;
                    sum_b += to;
                }
            // The mean colour, as bright as a grey of half of white
            const double scale = 0.5 / std::max(sum_b.y, 1e-9);
            means.push_back(ciede2000(lab_of(scale * sum_a, white), lab_of(scale * sum_b, white)));
        }
    }
};

double mean(const std::vector<double> &values) {
    double sum = 0;
    for (const double v : values)
        sum += v;
    return sum / static_cast<double>(values.size());
}

double p99(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() * 99 / 100];
}

void dyes(benchmark::State &state) {
    for (auto _ : state) {
        Scene scene = bench::sample_scene(1, 160, 200);
        PreparedScene prepared;
        scene.open_dyes = {FabricIndex{0}};
        rendered(scene, 8, 0, prepared); // the tables
        double start = processor_seconds();
        RenderResult open = rendered(scene, 8, 0, prepared);
        const double open_seconds = processor_seconds() - start;
        scene.open_dyes.clear();
        scene.fabrics[0].colours.dye_all(dye("white"));
        start = processor_seconds();
        rendered(scene, 16, 0, prepared);
        state.counters["time_over_white"] = open_seconds / (processor_seconds() - start);
        Differences from_real, of_seeds;
        for (const std::string &name : dye_names()) {
            scene.fabrics[0].colours.dye_all(dye(name));
            set_dye(*open.image.depths, "", dye(name));
            const RenderResult real = rendered(scene, 32, 1, prepared);
            from_real.add(open.image, real.image);
            of_seeds.add(rendered(scene, 32, 2, prepared).image, real.image);
        }
        state.counters["error"] = mean(from_real.pixels);
        state.counters["error_p99"] = p99(from_real.pixels);
        state.counters["seeds"] = mean(of_seeds.pixels);
        state.counters["seeds_p99"] = p99(of_seeds.pixels);
        state.counters["error_of_mean"] = mean(from_real.means);
        state.counters["seeds_of_mean"] = mean(of_seeds.means);
    }
}
BENCHMARK(dyes)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

} // namespace
