#include "tsuya/sdk/model.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "disk.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr int kQuadratureCells = 96;

constexpr std::array<ModelName, 3> kModels = {{
    {"takeda", "great-circle model through a few measured views"},
    {"half_vector", "microfacets whose distribution is read off the measured views; reciprocal"},
    {"lambert", "ideal diffuser"},
}};

template <BrdfModel Model> BrdfFunction function_of(Model model) {
    return [model = std::move(model)](const glm::dvec3 &to_light, const glm::dvec3 &to_viewer) {
        return static_cast<double>(model.evaluate(glm::vec3(to_light), glm::vec3(to_viewer)));
    };
}

// The share of light from straight above that is reflected.
double albedo_of(const Bard &bard) {
    double sum = 0;
    for (int j = 0; j < kQuadratureCells; ++j)
        for (int i = 0; i < kQuadratureCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kQuadratureCells);
            const glm::dvec3 d = direction_of_disk(disk_of_square(u));
            sum += bard.at(d) * d.z;
        }
    return sum * 2 * std::numbers::pi / (kQuadratureCells * kQuadratureCells);
}

} // namespace

std::span<const ModelName> model_names() { return kModels; }

BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where) {
    std::vector<std::string> known;
    for (const ModelName &model : kModels)
        known.emplace_back(model.name);
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error({"unknown model '" + name + "'", where, accepted_names(name, known)});
    if (!fabric.bard || !(fabric.bard->peak() > 0))
        throw Error({"the fabric has no measured views with a value above 0", where + ".views",
                     "expected views at normal incidence"});
    if (name == "lambert")
        return [value = albedo_of(*fabric.bard) /
                        std::numbers::pi](const glm::dvec3 &, const glm::dvec3 &) { return value; };
    const double f0 = f0_of(fabric, where);
    if (name == "half_vector")
        return function_of(HalfVectorBrdf(*fabric.bard, f0));
    return function_of(TakedaBrdf(*fabric.bard, f0));
}

} // namespace tsuya
