#include "tsuya/sdk/model.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <vector>

#include "tables/disk.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr int kQuadratureCells = 96;

constexpr std::array<ModelName, 7> kModels = {{
    {"yarn", "warp and weft as rough cylinders fitted to the measured views; the default"},
    {"takeda", "great-circle model through a few measured views"},
    {"takeda_printed", "the same with the map as it is printed, to reproduce the paper"},
    {"half_vector", "microfacets whose distribution is read off the measured views; reciprocal"},
    {"ggx", "anisotropic GGX facets, given or fitted to the measured views; reciprocal"},
    {"lambert", "ideal diffuser"},
    {"tabulated", "every light and view from a table; no prediction"},
}};

// Whether as much filament lies at each slope as at its opposite: what the model has to know.
Symmetry symmetry_of(const YarnLobes &lobes) {
    const bool mirrored =
        std::all_of(lobes.surface.begin(), lobes.surface.end(),
                    [](const auto &s) { return std::equal(s.begin(), s.end(), s.rbegin()); });
    return mirrored ? Symmetry::orthotropic : Symmetry::none;
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

void check_model_name(const std::string &name, const std::string &where) {
    std::vector<std::string> known;
    for (const ModelName &model : kModels)
        known.emplace_back(model.name);
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error({"unknown model '" + name + "'", where, accepted_names(name, known)});
}

bool has_data_of(const std::string &model, const Fabric &fabric) {
    const bool views = fabric.bard && fabric.bard->peak() > 0;
    if (model == "tabulated")
        return fabric.table.has_value();
    return views || (model == "ggx" && fabric.ggx) || (model == "yarn" && fabric.yarn);
}

Brdf make_brdf(const std::string &name, const Fabric &fabric, const std::string &where) {
    check_model_name(name, where);
    if (!has_data_of(name, fabric)) {
        if (name == "tabulated")
            throw Error({"the fabric has no table of lights and views", where + ".table",
                         "expected a TABLE.csv with light from several directions"});
        throw Error({"the fabric has no measured views with a value above 0", where + ".views",
                     "expected views at normal incidence"});
    }
    if (name == "tabulated")
        return TabulatedBrdf(*fabric.table, where + ".table");
    if (name == "ggx") {
        const GgxFacets facets = fabric.ggx ? *fabric.ggx : fit_ggx(*fabric.bard);
        check_ggx(facets, where + ".ggx");
        return GgxBrdf(facets);
    }
    if (name == "lambert")
        return LambertBrdf(static_cast<float>(std::min(1.0, albedo_of(*fabric.bard))));
    if (name == "yarn" && fabric.yarn)
        return YarnBrdf(*fabric.yarn, symmetry_of(*fabric.yarn));
    if (name == "yarn")
        return YarnBrdf(*fabric.bard, fabric.f0 ? f0_of(fabric, where) : YarnLobes{}.f0);
    const double f0 = f0_of(fabric, where);
    if (name == "half_vector")
        return HalfVectorBrdf(*fabric.bard, f0);
    if (name == "takeda_printed")
        return TakedaPrintedBrdf(*fabric.bard, f0);
    return TakedaBrdf(*fabric.bard, f0);
}

BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where) {
    return [brdf = make_brdf(name, fabric, where)](const glm::dvec3 &l, const glm::dvec3 &v) {
        return static_cast<double>(brdf.evaluate(glm::vec3(l), glm::vec3(v)));
    };
}

} // namespace tsuya
