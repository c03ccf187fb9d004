#pragma once
// The contract of brdf.h as checks that return what they found, so that a wrong model can be held
// to them as well as a right one.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/brdf.h"

namespace tsuya::test {

// A model with its type forgotten.
struct AnyBrdf {
    using Value = std::function<float(const glm::vec3 &, const glm::vec3 &)>;
    using Draw =
        std::function<std::optional<SampledDirection>(const glm::vec3 &, const glm::vec3 &)>;
    using Albedo = std::function<float(const glm::vec3 &)>;
    Value evaluate{}, evaluate_cos{}, pdf{}, pdf_adjoint{};
    std::function<WeighedLight(const glm::vec3 &, const glm::vec3 &)> weigh{};
    Draw sample{}, sample_adjoint{};
    Albedo albedo_of_light{}, albedo_of_view{};
    bool reciprocal = false, energy_limited = false;
};

template <BrdfModel Model> AnyBrdf any_brdf(const Model &model) {
    using V = const glm::vec3 &;
    const auto m = std::make_shared<const Model>(model); // copies of the functions are cheap
    return {.evaluate = [m](V l, V v) { return m->evaluate(l, v); },
            .evaluate_cos = [m](V l, V v) { return m->evaluate_cos(l, v); },
            .pdf = [m](V l, V v) { return m->pdf(l, v); },
            .pdf_adjoint = [m](V l, V v) { return m->pdf_adjoint(l, v); },
            .weigh = [m](V l, V v) { return m->weigh(l, v); },
            .sample = [m](V v, V u) { return m->sample(v, u); },
            .sample_adjoint = [m](V l, V u) { return m->sample_adjoint(l, u); },
            .albedo_of_light = [m](V l) { return m->albedo_of_light(l); },
            .albedo_of_view = [m](V v) { return m->albedo_of_view(v); },
            .reciprocal = Model::kReciprocal,
            .energy_limited = Model::kEnergyLimited};
}

struct Check {
    bool passed = true;
    double worst = 0;    // what the check measures, at its worst
    std::string where{}; // the directions there
};

// Finite and not negative everywhere, the grazing angles among them; zero below the horizon.
Check check_values(const AnyBrdf &brdf);
Check check_horizon(const AnyBrdf &brdf);
// evaluate_cos = evaluate * cos; the pdf a sample carries is the model's; weight = f cos / pdf;
// `weigh` agrees with them, and the weft's part is a part.
// Worst relative difference.
Check check_weights(const AnyBrdf &brdf);
// Worst |f(a,b) - f(b,a)| / (f(a,b) + f(b,a)); passes where that is what the model claims.
Check check_reciprocity(const AnyBrdf &brdf);
// Quadrature of f cos over the views of a light, without any sampling of the model. `limit`: the
// worst share reflected; passes where the model does not claim a limit. `albedo`: the worst
// difference from albedo_of_light, relative where the albedo is above 1.
struct Energy {
    Check limit{}, albedo{};
};
Energy check_energy(const AnyBrdf &brdf, double tolerance, int evaluations);
// The same of albedo_of_view, by quadrature over the lights of a view.
Check check_albedo_of_view(const AnyBrdf &brdf, double tolerance, int evaluations);

// What one set of draws for one fixed direction shows.
struct Draws {
    double p_value = 1;      // of the chi-square of the draws that are no null samples
    double pdf_integral = 1; // by quadrature
    double null_share = 0;   // of the draws
    double null_sigma = 0;   // its standard error
    double mean_weight = 0, mean_weight_sigma = 0;
    double albedo = 0; // what the mean weight should be, by quadrature
};
// `evaluations`: of the pdf's quadrature.
Draws draw(const AnyBrdf &brdf, bool adjoint, const glm::vec3 &fixed, int samples,
           std::uint64_t seed, int evaluations);

// The fixed directions of the statistical checks: 0 to 89.9 degrees at several azimuths.
std::vector<glm::vec3> fixed_directions(double to_deg = 89.9);
// Their draws, both ways. Passes where every p-value holds after Sidak's correction; where pdf and
// null samples add to 1; where mean weights meet the albedos. `worst` is the least p-value.
struct DrawEffort {
    int samples = 20000;
    int evaluations = 80000; // of the quadrature of densities, at least 3 a sample
    double to_deg = 89.9;    // of the fixed directions
};
Check check_draws(const AnyBrdf &brdf, const DrawEffort &effort, std::uint64_t seed);

} // namespace tsuya::test
