// Nanoseconds of one call of the reflectance models on one core with the error of their tables, the
// variance of their draws, and the time and error of fits by the number of views.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/brdf.h"
#include "tsuya/sdk/model.h"

#if defined(__x86_64__) && !defined(__clang__)
#define TSUYA_FOR_EVERY_PROCESSOR                                                                  \
    __attribute__((flatten, target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define TSUYA_FOR_EVERY_PROCESSOR
#endif

namespace {

using namespace tsuya;

constexpr std::size_t kDirections = 4096;
constexpr double kDegree = std::numbers::pi / 180;
constexpr float kPi = 3.14159265f;

// Even over the upper hemisphere.
std::vector<glm::vec3> even_directions(unsigned seed, std::size_t count = kDirections) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> uniform;
    std::vector<glm::vec3> made;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = uniform(generator), phi = 2 * kPi * uniform(generator);
        const float s = std::sqrt(1 - z * z);
        made.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
    }
    return made;
}

const std::vector<glm::vec3> &lights() {
    static const auto all = even_directions(1);
    return all;
}
const std::vector<glm::vec3> &views() {
    static const auto all = even_directions(2);
    return all;
}
std::vector<glm::vec3> random_points() {
    std::mt19937 generator(3);
    std::uniform_real_distribution<float> uniform;
    std::vector<glm::vec3> made;
    for (std::size_t i = 0; i < kDirections; ++i)
        made.emplace_back(uniform(generator), uniform(generator), uniform(generator));
    return made;
}

const Bard &satin() {
    static const Bard bard = test::bard_of(test::satin_cloth());
    return bard;
}
const TakedaBrdf &takeda() {
    static const TakedaBrdf model(satin(), 0.05);
    return model;
}
const GgxBrdf &ggx() {
    static const GgxBrdf model({.alpha_weft = 0.42, .alpha_warp = 0.12});
    return model;
}

// Root mean square of the relative error of the tables against the surface they were made of, for
// light from straight above, and the largest: what resolution and precision cost.
void report_table_error(benchmark::State &state) {
    double squares = 0, largest = 0;
    for (const glm::vec3 &view : views()) {
        const double exact = satin().at(view);
        const double error = takeda().evaluate({0, 0, 1}, view) / exact - 1;
        squares += error * error;
        largest = std::max(largest, std::abs(error));
    }
    state.counters["error"] = std::sqrt(squares / kDirections);
    state.counters["error_max"] = largest;
    state.counters["table_bytes"] = static_cast<double>(takeda().table_bytes());
}

// The loops below make a call for every direction.
void report_one_call(benchmark::State &state) {
    // The CSV of Google Benchmark takes no columns that its first line has not
    for (const char *column : {"error", "error_max", "table_bytes"})
        state.counters[column] = NAN;
    state.counters["ns_a_call"] = benchmark::Counter(static_cast<double>(kDirections) * 1e-9,
                                                     benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

// Sums over all directions; `ns_a_call` is the time of one.
template <class Call> void each(benchmark::State &state, const Call &call) {
    call(0); // the models are made at their first use
    for (auto _ : state) {
        float sum = 0;
        for (std::size_t i = 0; i < kDirections; ++i)
            sum += call(i);
        benchmark::DoNotOptimize(sum);
    }
    report_one_call(state);
}

void takeda_evaluate(benchmark::State &state) {
    each(state, [](std::size_t i) { return takeda().evaluate_cos(lights()[i], views()[i]); });
    report_table_error(state);
}

template <class Model> void in_batches(benchmark::State &state, const Model &model) {
    const auto size = static_cast<std::size_t>(state.range(0));
    std::vector<float> f_cos(kDirections);
    for (auto _ : state) {
        for (std::size_t i = 0; i < kDirections; i += size)
            model(std::span(lights()).subspan(i, size), std::span(views()).subspan(i, size),
                  std::span(f_cos).subspan(i, size));
        benchmark::ClobberMemory();
    }
    report_one_call(state);
}
void takeda_evaluate_batch(benchmark::State &state) {
    in_batches(state, [](auto l, auto v, auto f) { takeda().evaluate_cos(l, v, f); });
    report_table_error(state);
}

void takeda_weigh(benchmark::State &state) {
    each(state, [](std::size_t i) { return takeda().weigh(lights()[i], views()[i]).pdf_per_sr; });
}

template <class Draw> void draws(benchmark::State &state, const Draw &draw) {
    const auto u = random_points();
    each(state, [&](std::size_t i) {
        const auto s = draw(views()[i], u[i]);
        return s ? s->weight : 0.0f;
    });
}
void takeda_sample(benchmark::State &state) {
    draws(state, [](const auto &v, const auto &u) { return takeda().sample(v, u); });
}
void takeda_sample_adjoint(benchmark::State &state) {
    draws(state, [](const auto &l, const auto &u) { return takeda().sample_adjoint(l, u); });
}
void ggx_sample(benchmark::State &state) {
    draws(state, [](const auto &v, const auto &u) { return ggx().sample(v, u); });
}
void ggx_evaluate(benchmark::State &state) {
    each(state, [](std::size_t i) { return ggx().evaluate_cos(lights()[i], views()[i]); });
}

// The same model in a loop that the compiler vectorises, from the same arrays of directions.
TSUYA_FOR_EVERY_PROCESSOR
void ggx_block(const glm::vec3 *light, const glm::vec3 *view, float *f_cos, std::size_t count) {
    constexpr std::size_t kBlock = 16;
    constexpr float ax = 0.42f, ay = 0.12f, f0 = 0.05f;
    float lx[kBlock]{}, ly[kBlock]{}, lz[kBlock]{}, vx[kBlock]{}, vy[kBlock]{}, vz[kBlock]{};
    float result[kBlock];
    for (std::size_t i = 0; i < count; ++i) {
        lx[i] = light[i].x, ly[i] = light[i].y, lz[i] = light[i].z;
        vx[i] = view[i].x, vy[i] = view[i].y, vz[i] = view[i].z;
    }
    for (std::size_t i = 0; i < kBlock; ++i) {
        const float hx = lx[i] + vx[i], hy = ly[i] + vy[i], hz = lz[i] + vz[i];
        const float hh = hx * hx + hy * hy + hz * hz;
        const float x = hx * (1 / ax), y = hy * (1 / ay);
        const float t = hh / (x * x + y * y + hz * hz + 1e-30f);
        const float m = 1 - 0.5f * std::sqrt(hh), m2 = m * m;
        const float sl =
            std::sqrt(ax * ax * lx[i] * lx[i] + ay * ay * ly[i] * ly[i] + lz[i] * lz[i]);
        const float sv =
            std::sqrt(ax * ax * vx[i] * vx[i] + ay * ay * vy[i] * vy[i] + vz[i] * vz[i]);
        result[i] = 0.5f / (kPi * ax * ay) * t * t * (f0 + (1 - f0) * m2 * m2 * m) * lz[i] /
                    (lz[i] * sv + vz[i] * sl + 1e-30f);
    }
    std::copy_n(result, count, f_cos);
}
void ggx_evaluate_batch(benchmark::State &state) {
    in_batches(state,
               [](auto l, auto v, auto f) { ggx_block(l.data(), v.data(), f.data(), f.size()); });
}

// One addition after the other: what a nanosecond is worth on this machine at this moment.
void one_addition(benchmark::State &state) {
    for (auto _ : state) {
        std::size_t x = 1;
        for (std::size_t i = 0; i < kDirections; ++i) {
            x += i;
            benchmark::DoNotOptimize(x);
        }
    }
    report_one_call(state);
}

// Relative variance of the weights for a fixed direction at so many degrees, in the weft plane and
// in the warp plane: 0 where every draw tells all.
template <class Model>
void report_variance(benchmark::State &state, const Model &model, bool adjoint) {
    const auto u = random_points();
    const double theta = static_cast<double>(state.range(0)) * kDegree;
    const char *const names[] = {"variance_weft", "variance_warp"};
    const glm::vec3 fixed[] = {{std::sin(theta), 0, std::cos(theta)},
                               {0, std::sin(theta), std::cos(theta)}};
    for (auto _ : state)
        for (int plane = 0; plane < 2; ++plane) {
            double sum = 0, squares = 0;
            for (int turn = 0; turn < 16; ++turn)
                for (const glm::vec3 &point : u) {
                    const glm::vec3 moved = glm::fract(point + glm::vec3(0.618f, 0.414f, 0.732f) *
                                                                   static_cast<float>(turn));
                    const auto s = adjoint ? model.sample_adjoint(fixed[plane], moved)
                                           : model.sample(fixed[plane], moved);
                    sum += s ? s->weight : 0;
                    squares += s ? double(s->weight) * s->weight : 0;
                }
            const double n = 16.0 * static_cast<double>(u.size());
            state.counters[names[plane]] = squares * n / (sum * sum) - 1;
        }
}
void takeda_fixed_view(benchmark::State &state) { report_variance(state, takeda(), false); }
void takeda_fixed_light(benchmark::State &state) { report_variance(state, takeda(), true); }

// |f(a, b) - f(b, a)| over the larger, for random pairs: mean, and the value that one in twenty
// exceeds. And how far the energy of light from one direction had to be limited.
template <class Model> void report_reciprocity(benchmark::State &state, const Model &model) {
    std::vector<double> off;
    for (auto _ : state) {
        off.clear();
        for (std::size_t i = 0; i < kDirections; ++i) {
            const double a = model.evaluate(lights()[i], views()[i]);
            const double b = model.evaluate(views()[i], lights()[i]);
            off.push_back(std::abs(a - b) / std::max({a, b, 1e-30}));
        }
    }
    std::sort(off.begin(), off.end());
    state.counters["violation"] = std::accumulate(off.begin(), off.end(), 0.0) / kDirections;
    state.counters["violation_p95"] = off[kDirections * 95 / 100];
    state.counters["unlimited_albedo"] = model.unlimited_albedo();
}
void takeda_reciprocity(benchmark::State &state) { report_reciprocity(state, takeda()); }
void half_vector_reciprocity(benchmark::State &state) {
    static const HalfVectorBrdf model(satin(), 0.05);
    report_reciprocity(state, model);
}

// Views every so many tenths of a degree in theta and phi: time of the fit; error of the surface,
// and of the model under light at 45 degrees, both as l2_cos against the truth they were made of.
void bard_fit(benchmark::State &state) {
    const double step = static_cast<double>(state.range(0)) / 10;
    const test::Cloth cloth = test::satin_cloth();
    const ReflectanceTable table = test::normal_table(cloth, test::even_grid(step, step));
    Fabric fabric{.name = "satin", .f0 = cloth.f0};
    for (auto _ : state)
        fabric.bard = Bard::fit(table, "satin");
    const auto error = [&](double theta_i, const BrdfFunction &f) {
        ReflectanceTable truth{.symmetry = Symmetry::none};
        for (double theta = 1; theta < 90; theta += 3)
            for (double phi = 2; phi < 360; phi += 7)
                for (const double phi_i : {0.0, 45.0, 90.0})
                    truth.rows.push_back({theta_i * kDegree, phi_i * kDegree, theta * kDegree,
                                          phi * kDegree,
                                          test::reflectance(cloth, test::direction(theta_i, phi_i),
                                                            test::direction(theta, phi))});
        return *measure_accuracy(truth, f).mean.l2_cos;
    };
    state.counters["views"] = static_cast<double>(table.rows.size());
    state.counters["error"] =
        error(0, [&](const auto &, const auto &v) { return fabric.bard->at(v); });
    state.counters["model_error"] = error(45, make_model("half_vector", fabric, "satin"));
}

BENCHMARK(takeda_evaluate);
BENCHMARK(one_addition);
BENCHMARK(takeda_evaluate_batch)->Arg(8)->Arg(16);
BENCHMARK(takeda_weigh);
BENCHMARK(takeda_sample);
BENCHMARK(takeda_sample_adjoint);
BENCHMARK(ggx_evaluate);
BENCHMARK(ggx_evaluate_batch)->Arg(8)->Arg(16);
BENCHMARK(ggx_sample);
BENCHMARK(takeda_fixed_view)->Arg(0)->Arg(30)->Arg(60)->Arg(75)->Arg(85)->Arg(89)->Iterations(1);
BENCHMARK(takeda_fixed_light)->Arg(0)->Arg(30)->Arg(60)->Arg(75)->Arg(85)->Arg(89)->Iterations(1);
BENCHMARK(takeda_reciprocity)->Iterations(1);
BENCHMARK(half_vector_reciprocity)->Iterations(1);
BENCHMARK(bard_fit)
    ->Arg(25)
    ->Arg(50)
    ->Arg(75)
    ->Arg(100)
    ->Arg(150)
    ->Arg(200)
    ->Arg(300)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->Iterations(1);

} // namespace
