#include "dye_channels.h"

#include <algorithm>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/plan.h"

namespace tsuya {
namespace {

constexpr int kChannelsOfOne = 8, kChannelsOfNarrow = 16, kChannelsOfTwo = 32;
// A dye whose reflectances span less needs few depths.
constexpr double kNarrow = 0.4;

double largest(const Spectrum &spectrum) {
    return *std::max_element(spectrum.value.begin(), spectrum.value.end());
}

// Collects the colours that vary.
class Variation {
  public:
    explicit Variation(const Scene &scene) : used_(fabrics_in_use(scene)) {
        for (std::size_t i = 0; i < scene.fabrics.size(); ++i)
            found.fabrics.push_back(used_[i] ? of_fabric(scene.fabrics[i], is_open(scene, i))
                                             : VaryingColours{});
    }

    VaryingScene found{};

  private:
    static bool is_open(const Scene &scene, std::size_t fabric) {
        return std::any_of(scene.open_dyes.begin(), scene.open_dyes.end(),
                           [&](FabricIndex open) { return open.value == fabric; });
    }

    VaryingColours of_fabric(const Fabric &fabric, bool open) {
        const FabricColours &colours = fabric.colours;
        VaryingColours varying;
        const Spectrum &weft = colours.dye_of_weft(), &warp = colours.dye_of_warp();
        const double most = 1 - largest(colours.transmittance);
        const bool is_shot = !(weft == warp);
        varying.weft_dye = dye(fabric.name + (is_shot ? ".weft" : ""), weft, open, most);
        varying.warp_dye =
            is_shot ? dye(fabric.name + ".warp", warp, open, most) : varying.weft_dye;
        varying.transmittance = fixed(fabric.name + ".transmittance", colours.transmittance);
        varying.weft_tint = fixed(fabric.name + ".tint", colours.weft());
        varying.warp_tint = fixed(fabric.name + ".tint", colours.warp());
        if (varying.transmittance && varying.weft_dye && !open)
            throw Error({"both dye and transmittance of '" + fabric.name + "' have colours",
                         "fabrics." + fabric.name, "expected one of them to be grey"});
        return varying;
    }

    std::optional<std::size_t> dye(const std::string &name, const Spectrum &spectrum, bool open,
                                   double most) {
        if (!open)
            return fixed(name, spectrum);
        found.dyes.push_back({.name = name, .dye = spectrum, .open = true, .highest = most});
        return found.dyes.size() - 1;
    }

    // Equal spectra are one.
    std::optional<std::size_t> fixed(const std::string &name, const Spectrum &spectrum) {
        if (spectrum.is_constant())
            return std::nullopt;
        for (std::size_t i = 0; i < found.dyes.size(); ++i)
            if (!found.dyes[i].open && found.dyes[i].dye == spectrum)
                return i;
        const auto [low, high] = std::minmax_element(spectrum.value.begin(), spectrum.value.end());
        found.dyes.push_back({.name = name, .dye = spectrum, .lowest = *low, .highest = *high});
        return found.dyes.size() - 1;
    }

    std::vector<bool> used_;
};

bool shows_prints(const Scene &scene) {
    const auto printed = [](const auto &of) { return of.print || of.back_print; };
    return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object &object) {
        return printed(object) || std::any_of(object.panels.begin(), object.panels.end(), printed);
    });
}

} // namespace

VaryingScene varying_colours(const Scene &scene) {
    if (shows_prints(scene))
        throw Error({"the scene has a print, whose colours are not those of few dyes", "open_dyes",
                     "expected cloth in plain dyes, or no open dye"});
    Variation variation(scene);
    const std::vector<DyeVariable> &dyes = variation.found.dyes;
    if (dyes.size() > kMostDyes) {
        std::string names;
        for (const DyeVariable &dye : dyes)
            names += (names.empty() ? "" : ", ") + dye.name;
        throw Error(
            {detail::counted(dyes.size(), "colour") + " vary: " + names, "open_dyes",
             "expected at most " + std::to_string(kMostDyes) + " beside greys, or no open dye"});
    }
    return std::move(variation.found);
}

std::vector<DyeVariable> dye_variables(const Scene &scene) { return varying_colours(scene).dyes; }

int depth_channels(const std::vector<DyeVariable> &dyes) {
    if (dyes.size() < 2)
        return kChannelsOfOne;
    const bool narrow = std::any_of(dyes.begin(), dyes.end(), [](const DyeVariable &dye) {
        return dye.highest - dye.lowest < kNarrow;
    });
    return narrow ? kChannelsOfNarrow : kChannelsOfTwo;
}

std::optional<DyeDepths> depths_of(std::vector<DyeVariable> dyes,
                                   const std::array<double, kMostDyes> &most_dye, int channels) {
    if (dyes.empty())
        return std::nullopt;
    for (std::size_t i = 0; i < dyes.size(); ++i)
        if (dyes[i].open)
            dyes[i].highest = std::min(dyes[i].highest, most_dye[i]);
    return make_dye_depths(std::move(dyes), channels);
}

std::vector<DyeVariable> planned_dyes(const Scene &scene) {
    return scene.open_dyes.empty() ? std::vector<DyeVariable>{} : dye_variables(scene);
}

SpectralBasis basis_of(const std::vector<DyeVariable> &dyes, int channels) {
    return dyes.empty() ? SpectralBasis::of_renders(channels) : SpectralBasis{.count = channels};
}

RenderSettings as_planned(const Scene &scene, RenderSettings settings) {
    if (const auto dyes = planned_dyes(scene); !dyes.empty())
        settings.channels = depth_channels(dyes);
    return settings;
}

Fabric fabric_at_depths(const Fabric &fabric, const VaryingColours &varying,
                        const DyeDepths &depths) {
    const auto at_channels = [&](const std::optional<std::size_t> &dye, const Spectrum &constant) {
        if (!dye)
            return constant;
        Spectrum spectrum{{}, {}};
        for (std::size_t k = 0; k < depths.node.size(); ++k) {
            spectrum.wavelength_nm.push_back(place_of(static_cast<int>(k)));
            spectrum.value.push_back(depths.node[k][*dye]);
        }
        return spectrum;
    };
    Fabric made = fabric;
    const FabricColours &from = fabric.colours;
    FabricColours &to = made.colours;
    to.transmittance = at_channels(varying.transmittance, from.transmittance);
    // A system of yarns without a colour of its own has that of the fabric
    const auto set = [&](Spectrum &all, std::optional<Spectrum> &weft,
                         std::optional<Spectrum> &warp, const Spectrum &of_weft,
                         const Spectrum &of_warp) {
        all = weft ? of_warp : of_weft;
        if (weft)
            weft = of_weft;
        if (warp)
            warp = of_warp;
    };
    set(to.dye, to.weft_dye, to.warp_dye, at_channels(varying.weft_dye, from.dye_of_weft()),
        at_channels(varying.warp_dye, from.dye_of_warp()));
    set(to.specular_tint, to.weft_tint, to.warp_tint, at_channels(varying.weft_tint, from.weft()),
        at_channels(varying.warp_tint, from.warp()));
    return made;
}

} // namespace tsuya
