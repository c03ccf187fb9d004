// Every model in the same terms: nanoseconds of one call on one core with the error of its tables,
// the variance of its draws, reciprocity, energy; and the time and error of fits by the number of
// views.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/allocated_bytes.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
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
constexpr double kF0 = 0.05;

// Even over the upper hemisphere.
std::vector<glm::vec3> even_directions(unsigned seed, std::size_t count = kDirections) {
    std::mt19937 generator(seed);
    std::uniform_real_distribution<float> uniform;
    std::vector<glm::vec3> made;
    for (std::size_t i = 0; i < count; ++i) {
        const float z = uniform(generator), phi = 2 * kPiF * uniform(generator);
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
const std::vector<glm::vec3> &random_points() {
    static const auto all = [] {
        std::mt19937 generator(3);
        std::uniform_real_distribution<float> uniform;
        std::vector<glm::vec3> made;
        for (std::size_t i = 0; i < kDirections; ++i)
            made.emplace_back(uniform(generator), uniform(generator), uniform(generator));
        return made;
    }();
    return all;
}

const Bard &satin() {
    static const Bard bard = test::bard_of(test::satin_cloth());
    return bard;
}

// What a model's tables stand for under light from straight above, reckoned without them: the
// surface through the views; of the yarn model the sum over its slopes; nothing where a model has
// no table, or only the measured one.
using Plain = std::function<double(const glm::vec3 &to_viewer)>;
template <class Model> Plain without_tables(const Model &) {
    return [](const glm::vec3 &view) { return satin().at(view); };
}
Plain without_tables(const GgxBrdf &) { return {}; }
Plain without_tables(const LambertBrdf &) { return {}; }
Plain without_tables(const TabulatedBrdf &) { return {}; }
Plain without_tables(const YarnBrdf &model) {
    return [lobes = model.lobes(),
            optics = YarnOptics(model.lobes().f0, model.lobes().roughness)](const glm::vec3 &view) {
        const glm::vec3 up(0, 0, 1);
        const YarnHalf half = optics.half(up, view);
        double sum = lobes.even / std::numbers::pi +
                     lobes.loose * half.fresnel / (2 * std::numbers::pi * (1 + view.z));
        const glm::vec2 seen =
            optics.reach(half, up, view) * YarnDepth(lobes).in_sight(half.half, YarnSpan(up, view));
        for (int axis = 0; axis < 2; ++axis)
            sum += yarn_facets(lobes, axis, half.half) * seen[axis];
        return sum;
    };
}

// Root mean square of the relative error of the tables, and the largest: what resolution and
// precision cost. NaN where there are none: the CSV takes no columns that its first line has not.
template <class Model> void report_table_error(benchmark::State &state, const Model &model) {
    double squares = 0, largest = 0;
    if (const Plain plain = without_tables(model))
        for (const glm::vec3 &view : views()) {
            const double error = model.evaluate({0, 0, 1}, view) / plain(view) - 1;
            squares += error * error;
            largest = std::max(largest, std::abs(error));
        }
    else
        squares = largest = NAN;
    state.counters["error"] = std::sqrt(squares / kDirections);
    state.counters["error_max"] = largest;
    const std::size_t before = allocated_bytes();
    const Model copy = model;
    benchmark::DoNotOptimize(&copy);
    state.counters["bytes"] = static_cast<double>(sizeof(Model) + allocated_bytes() - before);
}

// The loops below make a call for every direction; `ns_a_call` is the time of one.
void report_one_call(benchmark::State &state) {
    for (const char *column : {"error", "error_max", "bytes"})
        state.counters[column] = NAN;
    state.counters["ns_a_call"] = benchmark::Counter(static_cast<double>(kDirections) * 1e-9,
                                                     benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

template <class Call> void each(benchmark::State &state, const Call &call) {
    for (auto _ : state) {
        float sum = 0;
        for (std::size_t i = 0; i < kDirections; ++i)
            sum += call(i);
        benchmark::DoNotOptimize(sum);
    }
    report_one_call(state);
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

template <class Batch>
void in_batches(benchmark::State &state, std::size_t size, const Batch &batch) {
    std::vector<float> f_cos(kDirections);
    for (auto _ : state) {
        for (std::size_t i = 0; i < kDirections; i += size)
            batch(std::span(lights()).subspan(i, size), std::span(views()).subspan(i, size),
                  std::span(f_cos).subspan(i, size));
        benchmark::ClobberMemory();
    }
    report_one_call(state);
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
        result[i] = 0.5f / (kPiF * ax * ay) * t * t * (f0 + (1 - f0) * m2 * m2 * m) * lz[i] /
                    (lz[i] * sv + vz[i] * sl + 1e-30f);
    }
    std::copy_n(result, count, f_cos);
}

template <class Model>
concept InBatches = requires(const Model &m, std::span<const glm::vec3> d, std::span<float> f) {
    m.evaluate_cos(d, d, f);
};

void add(const std::string &name, const std::function<void(benchmark::State &)> &run) {
    benchmark::RegisterBenchmark(name.c_str(), run);
}
void add_once(const std::string &name, const std::function<void(benchmark::State &)> &run) {
    benchmark::RegisterBenchmark(name.c_str(), run)->Iterations(1);
}

template <class Model> void add_times(const std::string &name, const Model &model) {
    add("evaluate/" + name, [&model](benchmark::State &state) {
        each(state, [&](std::size_t i) { return model.evaluate_cos(lights()[i], views()[i]); });
        report_table_error(state, model);
    });
    if constexpr (InBatches<Model>)
        for (const std::size_t size : {8u, 16u})
            add("evaluate-" + std::to_string(size) + "/" + name,
                [&model, size](benchmark::State &state) {
                    in_batches(state, size,
                               [&](auto l, auto v, auto f) { model.evaluate_cos(l, v, f); });
                });
    add("weigh/" + name, [&model](benchmark::State &state) {
        each(state, [&](std::size_t i) {
            const WeighedLight light = model.weigh(lights()[i], views()[i]);
            return light.f_cos + light.pdf_per_sr;
        });
    });
    for (const bool adjoint : {false, true})
        add((adjoint ? "sample_adjoint/" : "sample/") + name,
            [&model, adjoint](benchmark::State &state) {
                const auto &u = random_points();
                each(state, [&](std::size_t i) {
                    const auto s = adjoint ? model.sample_adjoint(views()[i], u[i])
                                           : model.sample(views()[i], u[i]);
                    return s ? s->weight + s->pdf_per_sr : 0.0f;
                });
            });
}

// The variance of what `weight` gives over its mean squared: 0 where every draw tells all.
template <class Weight> double relative_variance(const Weight &weight) {
    constexpr int kTurns = 16;
    double sum = 0, squares = 0;
    for (int turn = 0; turn < kTurns; ++turn)
        for (const glm::vec3 &point : random_points()) {
            const double w = weight(
                glm::fract(point + glm::vec3(0.618f, 0.414f, 0.732f) * static_cast<float>(turn)));
            sum += w;
            squares += w * w;
        }
    return squares * kTurns * kDirections / (sum * sum) - 1;
}

// Draws for a fixed view or a fixed light at so many degrees in three planes; beside them draws by
// the cosine alone, and the share of null samples.
template <class Model>
void report_variance(benchmark::State &state, const Model &model, bool adjoint, int degrees) {
    const double theta = degrees * kDegree, half = std::sqrt(0.5);
    struct Plane {
        std::string name;
        double x, y;
    };
    double nulls = 0;
    for (auto _ : state)
        for (const Plane &plane : {Plane{"weft", 1, 0}, {"bias", half, half}, {"warp", 0, 1}}) {
            const glm::vec3 fixed(plane.x * std::sin(theta), plane.y * std::sin(theta),
                                  std::cos(theta));
            state.counters[plane.name] = relative_variance([&](const glm::vec3 &u) {
                const auto s = adjoint ? model.sample_adjoint(fixed, u) : model.sample(fixed, u);
                nulls += s ? 0 : 1;
                return s ? s->weight : 0.0f;
            });
            state.counters["cosine_" + plane.name] = relative_variance([&](const glm::vec3 &u) {
                const float phi = 2 * kPiF * u.x, s = std::sqrt(u.y);
                const glm::vec3 drawn(s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - u.y));
                return kPiF *
                       (adjoint ? model.evaluate(fixed, drawn) : model.evaluate(drawn, fixed));
            });
        }
    state.counters["nulls"] = nulls / (3 * 16 * kDirections);
}

// |f(a, b) - f(b, a)| over the larger, for random pairs: mean, and the value that one in twenty
// exceeds. And the largest albedo before it was limited, where the model limits it.
template <class Model> void report_reciprocity(benchmark::State &state, const Model &model) {
    std::vector<double> off;
    for (auto _ : state)
        for (std::size_t i = 0; i < kDirections; ++i) {
            const double a = model.evaluate(lights()[i], views()[i]);
            const double b = model.evaluate(views()[i], lights()[i]);
            off.push_back(std::abs(a - b) / std::max({a, b, 1e-30}));
        }
    std::sort(off.begin(), off.end());
    state.counters["violation"] = std::accumulate(off.begin(), off.end(), 0.0) / kDirections;
    state.counters["violation_p95"] = off[kDirections * 95 / 100];
    double albedo = NAN;
    if constexpr (requires { model.unlimited_albedo(); })
        albedo = model.unlimited_albedo();
    state.counters["unlimited_albedo"] = albedo;
}

// Views every so many degrees in theta and phi: time of the fit; error of the surface, and of
// models under lights at 45 degrees, all as l2_cos against the truth they were made of.
void bard_fit(benchmark::State &state, double step) {
    const test::Cloth cloth = test::satin_cloth();
    const ReflectanceTable table = test::normal_table(cloth, test::even_grid(step, step));
    Fabric fabric{.name = "satin"};
    for (auto _ : state)
        fabric.specular = CarriedViews{.bard = Bard::fit(table, "satin"), .f0 = cloth.f0};
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
        error(0, [&](const auto &, const auto &v) { return views_of(fabric)->at(v); });
    for (const char *model : {"yarn", "half_vector", "takeda"})
        state.counters[model] = error(45, make_model(model, fabric, "satin"));
}

struct Named {
    std::string name;
    Brdf brdf;
};

std::vector<Named> every_model() {
    const Fabric fabric{
        .name = "satin",
        .specular = CarriedViews{.bard = satin(), .f0 = kF0},
        .spare = {GgxFacets{.alpha_weft = 0.42, .alpha_warp = 0.12},
                  TabulatedSpecular{.table = test::paper_table(test::satin_cloth(), 6, 10)}}};
    std::vector<Named> all;
    for (const ModelName &model : model_names()) {
        const std::string name(model.name);
        all.push_back({name, *make_brdf(with_model(fabric, name, name), name)});
    }
    return all;
}

void add_all(const std::vector<Named> &models) {
    add("one_addition", one_addition);
    for (const auto &[name, brdf] : models)
        brdf.visit([&, &label = name](const auto &model) {
            add_times(label, model);
            add_once("reciprocity/" + label,
                     [&](benchmark::State &state) { report_reciprocity(state, model); });
            for (const bool adjoint : {false, true})
                for (const int degrees : {0, 30, 60, 75, 85, 89})
                    add_once((adjoint ? "fixed_light/" : "fixed_view/") + label + "/" +
                                 std::to_string(degrees),
                             [&model, adjoint, degrees](benchmark::State &state) {
                                 report_variance(state, model, adjoint, degrees);
                             });
        });
    for (const std::size_t size : {8u, 16u})
        add("evaluate-" + std::to_string(size) + "/ggx_vectorised",
            [size](benchmark::State &state) {
                in_batches(state, size, [](auto l, auto v, auto f) {
                    ggx_block(l.data(), v.data(), f.data(), f.size());
                });
            });
    for (const int tenths : {25, 50, 75, 100, 150, 200, 300})
        benchmark::RegisterBenchmark(
            ("bard_fit/" + std::to_string(tenths)).c_str(),
            [tenths](benchmark::State &state) { bard_fit(state, tenths / 10.0); })
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime()
            ->Iterations(1);
}

} // namespace

int main(int count, char **arguments) {
    benchmark::Initialize(&count, arguments);
    if (benchmark::ReportUnrecognizedArguments(count, arguments))
        return 1;
    const std::vector<Named> models = every_model();
    add_all(models);
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
