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

// Holds every spectrum and number to its range.
struct ColoursCheck {
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
    void operator()(const detail::Field &, Lustre) const {}
    void operator()(const detail::Field &field, const std::optional<double> &value) const {
        if (value)
            problems.need(*value >= field.low && *value <= field.high,
                          std::string(field.key) + " is " + std::to_string(*value),
                          where + "." + std::string(field.key), "expected a value from 0 to 1");
    }
};

// What only yarns have: colours of either system, and a body that follows them.
void check_needs_yarns(const Fabric &fabric, const std::string &where, Problems &problems) {
    if (std::visit(TellsYarnsApart{}, fabric.specular))
        return;
    const FabricColours &colours = fabric.colours;
    const std::string model(model_of(fabric));
    const auto refuse = [&](bool given, const char *key, const char *accepted) {
        problems.need(!given, "the model '" + model + "' does not separate weft and warp",
                      where + key, accepted);
    };
    refuse(colours.weft_tint.has_value(), ".weft_tint",
           "expected specular_tint, or the model 'yarn'");
    refuse(colours.warp_tint.has_value(), ".warp_tint",
           "expected specular_tint, or the model 'yarn'");
    refuse(colours.weft_dye.has_value(), ".weft_dye", "expected dye, or the model 'yarn'");
    refuse(colours.warp_dye.has_value(), ".warp_dye", "expected dye, or the model 'yarn'");
    problems.need(colours.delustre.value_or(1) == 1,
                  "the coloured part of the model '" + model + "' does not follow yarns",
                  where + ".delustre", "expected 1, or the model 'yarn'");
}

// What is scattered to both sides is no more than arrives.
void check_diffuse(const FabricColours &colours, const std::string &where, Problems &problems) {
    const Spectrum &weft = colours.dye_of_weft(), &warp = colours.dye_of_warp();
    std::vector<double> wavelengths;
    for (const Spectrum *const spectrum : {&weft, &warp, &colours.transmittance})
        wavelengths.insert(wavelengths.end(), spectrum->wavelength_nm.begin(),
                           spectrum->wavelength_nm.end());
    for (const double nm : wavelengths)
        if (const double sum = std::max(weft.at(nm), warp.at(nm)) + colours.transmittance.at(nm);
            !problems.need(sum <= 1 + 1e-9,
                           "dye and transmittance are " + std::to_string(sum) + " together at " +
                               std::to_string(nm) + " nm",
                           where + ".transmittance", "expected at most 1"))
            return;
}

} // namespace

const Spectrum &FabricColours::weft() const { return weft_tint ? *weft_tint : specular_tint; }
const Spectrum &FabricColours::warp() const { return warp_tint ? *warp_tint : specular_tint; }

const Spectrum &FabricColours::dye_of_weft() const { return weft_dye ? *weft_dye : dye; }
const Spectrum &FabricColours::dye_of_warp() const { return warp_dye ? *warp_dye : dye; }
void FabricColours::dye_all(const Spectrum &with) {
    dye = with;
    weft_dye.reset();
    warp_dye.reset();
}
bool FabricColours::any_dye() const {
    return dye_of_weft().any_above_zero() || dye_of_warp().any_above_zero();
}

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
    return (has_specular(fabric) && std::visit(IsDirected{}, fabric.specular)) || has_body(fabric);
}

bool has_body(const Fabric &fabric) {
    return reflects(fabric.specular) && std::visit(TellsYarnsApart{}, fabric.specular) &&
           fabric.colours.any_dye() && fabric.colours.delustre != 1.0;
}

double f0_of(const CarriedViews &views) {
    if (views.f0)
        return *views.f0;
    return views.model == ViewModel::takeda_printed ? std::min(1.0, views.bard.at({0, 0, 1}))
                                                    : kFibreF0;
}

void check_fabric(const Fabric &fabric, const std::string &where) {
    Problems problems;
    const FabricColours &colours = fabric.colours;
    each_field(ColoursCheck{where, problems}, colours);
    if (problems.empty())
        check_diffuse(colours, where, problems);
    const SpecularCheck check{where, problems};
    std::visit(check, fabric.specular);
    std::set<std::size_t> kinds{fabric.specular.index()};
    for (const Specular &spare : fabric.spare)
        problems.need(kinds.insert(spare.index()).second,
                      "the fabric has two descriptions of one kind", where + ".spare",
                      "expected at most one of each");
    check_needs_yarns(fabric, where, problems);
    problems.throw_if_any();
    if (fabric.weave)
        check_irregularity(fabric.weave->irregularity, where + ".weave.irregularity");
    if (fabric.weave && fabric.weave->has_map())
        check_weave_map(fabric.weave->map, where + ".weave");
}

std::vector<Problem> fabric_warnings(const Fabric &fabric, const std::string &where) {
    std::vector<Problem> warnings;
    if (fabric.weave && !std::visit(TellsYarnsApart{}, fabric.specular))
        warnings.push_back({"the model '" + std::string(model_of(fabric)) + "' shows no weave",
                            where + ".weave", "expected the model 'yarn', or no weave"});
    const auto *const tabulated = std::get_if<TabulatedSpecular>(&fabric.specular);
    if (const auto symmetry = tabulated ? likely_symmetry(tabulated->table) : std::nullopt)
        warnings.push_back({"the table has symmetry none and light from one side only, which is "
                            "taken for light from all sides",
                            where + ".table",
                            std::string("declare `# symmetry: ") + name_of(*symmetry) +
                                "` in it if the cloth has that symmetry"});
    return warnings;
}

} // namespace tsuya
