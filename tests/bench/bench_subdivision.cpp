// Level of subdivision: time from the mesh file to the surface, against the error of what the
// camera sees.

#include <cmath>

#include <benchmark/benchmark.h>

#include "bench/bench_scene.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"

namespace {

using namespace tsuya;

constexpr int kWidth = 400, kHeight = 500;
constexpr int kReferenceLevel = 6;

// What the camera meets first, without light.
std::vector<Image> first_hits(int level) {
    const Scene scene = bench::sample_scene(level, kWidth, kHeight);
    return render(scene, {.stop = {.samples_per_pixel = 4},
                          .channels = 8,
                          .max_bounces = 0,
                          .aovs = {"warp", "depth", "garment"}})
        .image.aovs;
}

const std::vector<Image> &reference() {
    static const std::vector<Image> images = first_hits(kReferenceLevel);
    return images;
}

void subdivision_level(benchmark::State &state) {
    const int level = static_cast<int>(state.range(0));
    const auto file = scene::data_folder() / "dress" / "dress.obj";
    std::size_t triangles = 0;
    for (auto _ : state)
        triangles = garment::load(file, {.subdivide = {.level = level}}).surface.triangle.size();

    double warp = 0, depth = 0, pixels = 0;
    const std::vector<Image> images = first_hits(level);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            // Pixels that lie wholly within the dress in both
            if (images[2].pixel(x, y)[0] != 1 || reference()[2].pixel(x, y)[0] != 1)
                continue;
            const auto vector = [&](const Image &image) {
                const float *const p = image.pixel(x, y);
                return glm::dvec3(p[0], p[1], p[2]);
            };
            const glm::dvec3 a = vector(images[0]), b = vector(reference()[0]);
            warp += std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
            depth += std::abs(images[1].pixel(x, y)[0] - reference()[1].pixel(x, y)[0]);
            ++pixels;
        }
    state.counters["error"] = warp / pixels / kDegree;
    state.counters["depth_error_mm"] = depth / pixels * 1000;
    state.counters["triangles"] = static_cast<double>(triangles);
}
BENCHMARK(subdivision_level)
    ->DenseRange(0, 4)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

const garment::PolygonMesh &prepared_dress() {
    static const garment::PolygonMesh mesh =
        garment::prepare(garment::read_mesh(scene::data_folder() / "dress" / "dress.obj").mesh)
            .mesh;
    return mesh;
}

// The whole dress in a picture 1000 pixels high.
Camera portrait() {
    return {.eye = {0, 0.75, 4}, .target = {0, 0.75, 0}, .vertical_angle = 0.42, .height = 1000};
}

// Time of tessellation, against what the triangles depart by from the true limit surface.
void tessellate(benchmark::State &state, const garment::SubdivideOptions &options) {
    for (auto _ : state)
        benchmark::DoNotOptimize(garment::subdivide(prepared_dress(), options));
    const garment::TessellationError error =
        garment::measure_tessellation(prepared_dress(), options, portrait());
    state.counters["error"] = error.pixels;
    state.counters["triangles"] = static_cast<double>(error.triangles);
    state.counters["position_mm"] = error.position * 1000;
    state.counters["position_rms_mm"] = error.position_rms * 1000;
    state.counters["normal_rms_deg"] = error.normal_rms / kDegree;
    state.counters["warp_rms_deg"] = error.warp_rms / kDegree;
}

void uniform(benchmark::State &state) {
    tessellate(state, {.level = static_cast<int>(state.range(0))});
}
BENCHMARK(uniform)->DenseRange(0, 4)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

// The number is the tolerance in hundredths of a pixel.
void adaptive(benchmark::State &state) {
    const double pixels = 0.01 * static_cast<double>(state.range(0));
    tessellate(state, {.view = garment::ViewTolerance{.camera = portrait(), .pixels = pixels}});
}
BENCHMARK(adaptive)
    ->Arg(200)
    ->Arg(100)
    ->Arg(50)
    ->Arg(25)
    ->Arg(10)
    ->Arg(5)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

} // namespace
