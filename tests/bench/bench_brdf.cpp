// Nanoseconds of one call of the reflectance models, on one core, and the time of a fit.

#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/brdf.h"

namespace {

using namespace tsuya;

constexpr std::size_t kDirections = 4096;

// Even over the upper hemisphere.
const std::vector<glm::vec3> &directions() {
    static const std::vector<glm::vec3> all = [] {
        std::mt19937 generator(1);
        std::uniform_real_distribution<float> uniform;
        std::vector<glm::vec3> made;
        for (std::size_t i = 0; i < kDirections; ++i) {
            const float z = uniform(generator), phi = 6.2831853f * uniform(generator);
            const float s = std::sqrt(1 - z * z);
            made.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
        }
        return made;
    }();
    return all;
}

const TakedaBrdf &takeda() {
    static const TakedaBrdf model(test::satin_bard(), 0.05);
    return model;
}

template <class Call> void call(benchmark::State &state, Call &&model) {
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            model(directions()[i % kDirections], directions()[(i * 7 + 3) % kDirections]));
        ++i;
    }
}

void takeda_evaluate(benchmark::State &state) {
    call(state, [](const glm::vec3 &l, const glm::vec3 &v) { return takeda().evaluate_cos(l, v); });
}
void takeda_pdf(benchmark::State &state) {
    call(state, [](const glm::vec3 &l, const glm::vec3 &v) { return takeda().pdf(l, v); });
}
void takeda_sample(benchmark::State &state) {
    call(state,
         [](const glm::vec3 &u, const glm::vec3 &v) { return takeda().sample(v, glm::abs(u)); });
}
void takeda_sample_adjoint(benchmark::State &state) {
    call(state, [](const glm::vec3 &u, const glm::vec3 &l) {
        return takeda().sample_adjoint(l, glm::abs(u));
    });
}
void bard_fit(benchmark::State &state) {
    for (auto _ : state)
        benchmark::DoNotOptimize(test::satin_bard());
}
BENCHMARK(takeda_evaluate);
BENCHMARK(takeda_pdf);
BENCHMARK(takeda_sample);
BENCHMARK(takeda_sample_adjoint);
BENCHMARK(bard_fit)->Unit(benchmark::kMillisecond);

} // namespace
