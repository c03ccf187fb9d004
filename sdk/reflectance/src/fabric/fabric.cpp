#include "tsuya/sdk/fabric.h"

#include <algorithm>
#include <set>

#include "tsuya/sdk/detail/fabric_fields.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/model.h"

namespace tsuya {
namespace {

// Whether turning the cloth changes what the specular part reflects.
struct IsDirected {
    bool operator()(std::monostate) const { return false; }
    bool operator()(const CarriedViews &views) const { return views.model != ViewModel::lambert; }
    bool operator()(const YarnLobes &) const { return true; }
    bool operator()(const GgxFacets &facets) const {
        return facets.alpha_weft != facets.alpha_warp;
    }
    bool operator()(const TabulatedSpecular &) const { return true; }
};

// Whether the specular part says what of it the weft reflects; of none, nobody asks.
struct TellsYarnsApart {
    bool operator()(std::monostate) const { return true; }
    bool operator()(const CarriedViews &views) const { return views.model == ViewModel::yarn; }
    bool operator()(const YarnLobes &) const { return true; }
    bool operator()(const GgxFacets &) const { return false; }
    bool operator()(const TabulatedSpecular &) const { return false; }
};

// The rules of a specular part that are known before it is made.
struct SpecularCheck {
    const std::string &where;
    Problems &problems;

    void operator()(std::monostate) const {}
    void operator()(const CarriedViews &views) const {
        if (views.f0)
            problems.need(*views.f0 > 0 && *views.f0 <= 1, "f0 is " + std::to_string(*views.f0),
                          where + ".f0", "expected a reflectance above 0 and not above 1");
    }
    void operator()(const YarnLobes &) const {}
    void operator()(const GgxFacets &facets) const {
        try {
            check_ggx(facets, where + ".ggx");
        } catch (const Error &error) {
            problems.add(error);
        }
    }
    void operator()(const TabulatedSpecular &) const {}
};

// Holds every spectrum to its range.
struct SpectrumCheck {
    const std::string &where;
    Problems &problems;

    void operator()(const detail::Field &field, const Spectrum &spectrum) const {
        try {
            check_spectrum(spectrum, field.low, field.high, where + "." + std::string(field.key));
        } catch (const Error &error) {
            problems.add(error);
        }
    }
    void operator()(const detail::Field &field, const std::optional<Spectrum> &spectrum) const {
        if (spectrum)
            (*this)(field, *spectrum);
    }
};

// What is scattered to both sides is no more than arrives.
void check_diffuse(const FabricColours &colours, const std::string &where, Problems &problems) {
    std::vector<double> wavelengths = colours.dye.wavelength_nm;
    wavelengths.insert(wavelengths.end(), colours.transmittance.wavelength_nm.begin(),
                       colours.transmittance.wavelength_nm.end());
    for (const double nm : wavelengths)
        if (const double sum = colours.dye.at(nm) + colours.transmittance.at(nm);
            !problems.need(sum <= 1 + 1e-9,
                           "dye and transmittance are " + std::to_string(sum) + " together at " +
                               std::to_string(nm) + " nm",
                           where + ".transmittance", "expected at most 1"))
            return;
}

} // namespace

bool Material::has_diffuse() const {
    return dye.any_above_zero() || transmittance.any_above_zero();
}

bool Material::has_specular() const {
    return specular && (weft_tint.any_above_zero() || warp_tint.any_above_zero());
}

const Spectrum &FabricColours::weft() const { return weft_tint ? *weft_tint : specular_tint; }
const Spectrum &FabricColours::warp() const { return warp_tint ? *warp_tint : specular_tint; }

const Bard *views_of(const Fabric &fabric) {
    const CarriedViews *const views = find_specular<CarriedViews>(fabric);
    return views ? &views->bard : nullptr;
}

bool reflects(const Specular &specular) {
    const auto *const views = std::get_if<CarriedViews>(&specular);
    return !std::holds_alternative<std::monostate>(specular) && (!views || views->bard.peak() > 0);
}

bool has_specular(const Fabric &fabric) {
    return reflects(fabric.specular) &&
           (fabric.colours.weft().any_above_zero() || fabric.colours.warp().any_above_zero());
}

bool needs_frames(const Fabric &fabric) {
    return has_specular(fabric) && std::visit(IsDirected{}, fabric.specular);
}

double f0_of(const CarriedViews &views) {
    return views.f0 ? *views.f0 : std::min(1.0, views.bard.at({0, 0, 1}));
}

void check_fabric(const Fabric &fabric, const std::string &where) {
    Problems problems;
    const FabricColours &colours = fabric.colours;
    each_field(SpectrumCheck{where, problems}, colours);
    if (problems.empty())
        check_diffuse(colours, where, problems);
    const SpecularCheck check{where, problems};
    std::visit(check, fabric.specular);
    std::set<std::size_t> kinds{fabric.specular.index()};
    for (const Specular &spare : fabric.spare)
        problems.need(kinds.insert(spare.index()).second,
                      "the fabric has two descriptions of one kind", where + ".spare",
                      "expected at most one of each");
    if (colours.weft_tint || colours.warp_tint)
        problems.need(std::visit(TellsYarnsApart{}, fabric.specular),
                      "the model '" + std::string(model_of(fabric)) +
                          "' does not tell weft and warp apart",
                      where + (colours.weft_tint ? ".weft_tint" : ".warp_tint"),
                      "expected specular_tint, or the model 'yarn'");
    problems.throw_if_any();
}

std::vector<Problem> fabric_warnings(const Fabric &fabric, const std::string &where) {
    const auto *const tabulated = std::get_if<TabulatedSpecular>(&fabric.specular);
    if (!tabulated)
        return {};
    const auto symmetry = likely_symmetry(tabulated->table);
    if (!symmetry)
        return {};
    return {
        {"the table has symmetry none and light from one side only, which is taken for light from "
         "all sides",
         where + ".table",
         std::string("declare `# symmetry: ") + name_of(*symmetry) +
             "` in it if the cloth has that symmetry"}};
}

Material resolve(const Fabric &fabric, const std::string &where, const Progress &progress) {
    check_fabric(fabric, where);
    return {.specular = make_brdf(fabric, where, progress),
            .weft_tint = fabric.colours.weft(),
            .warp_tint = fabric.colours.warp(),
            .dye = fabric.colours.dye,
            .transmittance = fabric.colours.transmittance};
}

} // namespace tsuya
