#include "tsuya/sdk/model.h"

#include <algorithm>
#include <array>

#include "models/facets.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "views/stop.h"

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

constexpr std::array kViewModels = {
    ViewModel::yarn,        ViewModel::takeda, ViewModel::takeda_printed,
    ViewModel::half_vector, ViewModel::ggx,    ViewModel::lambert};

// The model that a description is without choice; empty for views, which any of kViewModels
// carries, and for nothing.
std::string_view given_model(const Specular &specular) {
    struct Name {
        std::string_view operator()(std::monostate) const { return {}; }
        std::string_view operator()(const CarriedViews &) const { return {}; }
        std::string_view operator()(const YarnLobes &) const { return "yarn"; }
        std::string_view operator()(const GgxFacets &) const { return "ggx"; }
        std::string_view operator()(const TabulatedSpecular &) const { return "tabulated"; }
    };
    return std::visit(Name{}, specular);
}

// Of all descriptions the one that the model is made of; null where there is none.
Specular *source_of(std::string_view model, std::vector<Specular> &all) {
    for (Specular &specular : all)
        if (given_model(specular) == model)
            return &specular;
    const auto carried = std::find_if(kViewModels.begin(), kViewModels.end(),
                                      [&](ViewModel m) { return name_of(m) == model; });
    if (carried == kViewModels.end())
        return nullptr;
    for (Specular &specular : all)
        if (auto *const views = std::get_if<CarriedViews>(&specular)) {
            views->model = *carried;
            return &specular;
        }
    return nullptr;
}

// What the fabric has, of any kind.
std::vector<Specular> all_of(const Fabric &fabric) {
    std::vector<Specular> all = fabric.spare;
    all.insert(all.begin(), fabric.specular);
    return all;
}

// Whether as much filament lies at each slope as at its opposite: what the model has to know.
Symmetry symmetry_of(const YarnLobes &lobes) {
    const bool mirrored =
        std::all_of(lobes.surface.begin(), lobes.surface.end(),
                    [](const auto &s) { return std::equal(s.begin(), s.end(), s.rbegin()); });
    return mirrored ? Symmetry::orthotropic : Symmetry::none;
}

// The share of light from straight above that is reflected.
double albedo_of(const Bard &bard, const Progress &progress) {
    double sum = 0;
    for (int j = 0; j < kQuadratureCells; ++j) {
        stop_if_asked(progress);
        for (int i = 0; i < kQuadratureCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kQuadratureCells);
            const glm::dvec3 d = direction_of_disk(disk_of_square(u));
            sum += bard.at(d) * d.z;
        }
    }
    return sum * 2 * kPi / (kQuadratureCells * kQuadratureCells);
}

// Makes the model of each kind of specular part.
struct Maker {
    const std::string &where;
    const Progress &progress;

    double good_f0(double f0) const {
        checked_f0(f0, where + ".f0");
        return f0;
    }

    std::optional<Brdf> operator()(std::monostate) const { return std::nullopt; }
    std::optional<Brdf> operator()(const YarnLobes &lobes) const {
        return YarnBrdf(lobes, symmetry_of(lobes), progress);
    }
    std::optional<Brdf> operator()(const GgxFacets &facets) const {
        check_ggx(facets, where + ".ggx");
        return GgxBrdf(facets, progress);
    }
    std::optional<Brdf> operator()(const TabulatedSpecular &tabulated) const {
        return TabulatedBrdf(tabulated.table, where + ".table", progress);
    }
    std::optional<Brdf> operator()(const CarriedViews &views) const {
        const Bard &bard = views.bard;
        if (!(bard.peak() > 0))
            return std::nullopt;
        switch (views.model) {
        case ViewModel::yarn:
            return YarnBrdf(bard, good_f0(f0_of(views)), progress);
        case ViewModel::takeda:
            return TakedaBrdf(bard, good_f0(f0_of(views)), progress);
        case ViewModel::takeda_printed:
            return TakedaPrintedBrdf(bard, good_f0(f0_of(views)), progress);
        case ViewModel::half_vector:
            return HalfVectorBrdf(bard, good_f0(f0_of(views)), progress);
        case ViewModel::ggx:
            return GgxBrdf(fit_ggx(bard, progress), progress);
        case ViewModel::lambert:
            break;
        }
        return LambertBrdf(static_cast<float>(std::min(1.0, albedo_of(bard, progress))));
    }
};

} // namespace

std::span<const ModelName> model_names() { return kModels; }

std::span<const ViewModel> view_models() { return kViewModels; }

std::string_view name_of(ViewModel model) {
    switch (model) {
    case ViewModel::yarn:
        return "yarn";
    case ViewModel::takeda:
        return "takeda";
    case ViewModel::takeda_printed:
        return "takeda_printed";
    case ViewModel::half_vector:
        return "half_vector";
    case ViewModel::ggx:
        return "ggx";
    case ViewModel::lambert:
        break;
    }
    return "lambert";
}

void check_model_name(const std::string &name, const std::string &where) {
    std::vector<std::string> known;
    for (const ModelName &model : kModels)
        known.emplace_back(model.name);
    if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error({"unknown model '" + name + "'", where, accepted_names(name, known)});
}

std::string_view model_of(const Fabric &fabric) {
    if (const auto *const views = std::get_if<CarriedViews>(&fabric.specular))
        return name_of(views->model);
    const std::string_view given = given_model(fabric.specular);
    return given.empty() ? kDefaultModel : given;
}

std::vector<std::string> models_of(const Fabric &fabric) {
    std::vector<Specular> all = all_of(fabric);
    std::vector<std::string> models;
    for (const ModelName &model : kModels)
        if (const Specular *const source = source_of(model.name, all); source && reflects(*source))
            models.emplace_back(model.name);
    return models;
}

Fabric with_model(Fabric fabric, const std::string &name, const std::string &where) {
    check_model_name(name, where);
    std::vector<Specular> all = all_of(fabric);
    Specular *const source = source_of(name, all);
    if (!source && name == "tabulated")
        throw Error({"the fabric has no table of lights and views", where + ".table",
                     "expected a TABLE.csv with light from several directions"});
    if (!source)
        throw Error({"the fabric has no measured views", where + ".views",
                     "expected views at normal incidence"});
    fabric.specular = std::move(*source);
    fabric.spare.clear();
    *source = std::monostate();
    for (Specular &specular : all) {
        if (auto *const views = std::get_if<CarriedViews>(&specular))
            views->model = ViewModel::yarn; // files say no model of views that are spare
        if (!std::holds_alternative<std::monostate>(specular))
            fabric.spare.push_back(std::move(specular));
    }
    return fabric;
}

std::optional<Brdf> make_brdf(const Fabric &fabric, const std::string &where,
                              const Progress &progress) {
    return std::visit(Maker{where, progress}, fabric.specular);
}

BrdfFunction make_model(const std::string &name, const Fabric &fabric, const std::string &where,
                        const Progress &progress) {
    const std::optional<Brdf> brdf = make_brdf(with_model(fabric, name, where), where, progress);
    if (!brdf)
        throw Error({"the fabric has no measured views with a value above 0", where + ".views",
                     "expected views at normal incidence"});
    return [brdf = *brdf](const glm::dvec3 &l, const glm::dvec3 &v) {
        return static_cast<double>(brdf.evaluate(glm::vec3(l), glm::vec3(v)));
    };
}

} // namespace tsuya
