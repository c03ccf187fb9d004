// One lamp more: from light transport of a megapixel in 16 channels to the codes of a display and
// to a PNG, on one thread.

#include <filesystem>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/shown_picture.h"
#include "tsuya/sdk/detail/threads.h"

namespace {

using namespace tsuya;

const SpectralImage &megapixel(std::size_t groups) {
    static const auto make = [](std::vector<std::string> names) {
        SpectralImage image = SpectralImage::make(1000, 1000, {.count = 16}, std::move(names));
        std::mt19937 random(1);
        std::uniform_real_distribution<float> uniform(0.0f, 1.2f);
        for (float &t : image.transport)
            t = uniform(random);
        return image;
    };
    static const SpectralImage one = make({"key"}), two = make({"key", "fill"});
    return groups == 1 ? one : two;
}

Lighting warm() { return lighting_of({.name = "A", .spectrum = lamp("A")}); }

DisplayOptions look() { return {.adapt = Adaptation::cat02, .view = "Soft"}; }

template <class Work> void on_one_thread(benchmark::State &state, const Work &work) {
    detail::run_with_threads(1, [&] {
        for (auto _ : state)
            work();
    });
}

/// Relighting and display in one pass.
void shown(benchmark::State &state) {
    const SpectralImage &image = megapixel(static_cast<std::size_t>(state.range(0)));
    on_one_thread(state, [&] { benchmark::DoNotOptimize(shown_picture(image, warm(), look())); });
}

/// The same in two.
void relit_displayed(benchmark::State &state) {
    const SpectralImage &image = megapixel(static_cast<std::size_t>(state.range(0)));
    on_one_thread(state, [&] {
        benchmark::DoNotOptimize(
            display(relight(image, warm()), adopted_white(image, warm()), look()));
    });
}

void png(benchmark::State &state) {
    const Image picture = shown_picture(megapixel(1), warm(), look());
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "bench_relight.png";
    on_one_thread(state, [&] { write_png(file, picture); });
    state.counters["bytes"] = static_cast<double>(std::filesystem::file_size(file));
    std::filesystem::remove(file);
}

BENCHMARK(shown)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK(relit_displayed)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond);
BENCHMARK(png)->Unit(benchmark::kMillisecond);

} // namespace
