#include "tsuya/lab/weave.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

// Delustrant: particles of titanium dioxide (anatase, index 2.55, 3900 kg/m^3), 0.3 micrometres
// across, in polyester (index 1.575, 1380 kg/m^3): 2 % by weight where it is dull [Delustrant], 0.3
// % where it is semi-dull [SemiDull]; [Lustre] has the classes. Theirs is a
// scattering cross-section of 3.9 times their own by Mie's theory at 589 nm, computed by us, so
// that light goes 2 d / (3 * 3.9 * share of the volume).
constexpr double kSemiDull = 49e-6, kDull = 7.3e-6; // metres
constexpr double kAnisotropy = 0.69;                // mean cosine, of the same calculation

struct Range {
    const char *name;
    double value, low, high;
};

void check_yarn(const Yarn &yarn, const std::string &where) {
    const Range ranges[] = {
        {"per_cm", yarn.per_cm, 1, 500},
        {"width_mm", yarn.width * 1e3, 0.001, 10},
        {"flattening", yarn.flattening, 0.02, 1},
        {"filaments", static_cast<double>(yarn.filaments), 1, 500},
        {"corner_rounding", yarn.corner_rounding, 0, 1},
        {"twist_per_m", yarn.twist_per_m, -4000, 4000},
        {"tension", yarn.tension, 0.01, 100},
        {"refractive_index", yarn.refractive_index.value_or(1.5), 1, 3},
        {"surface_roughness", yarn.surface_roughness, 0, 1},
        {"transmission (red)", yarn.transmission[0], 0, 1},
        {"transmission (green)", yarn.transmission[1], 0, 1},
        {"transmission (blue)", yarn.transmission[2], 0, 1},
        {"scattering length in micrometres", yarn.scattering_length * 1e6, 0, 1e6},
    };
    for (const Range &range : ranges)
        if (!(range.value >= range.low && range.value <= range.high))
            throw Error(
                {std::string(range.name) + " is " + std::to_string(range.value), where,
                 "expected " + std::to_string(range.low) + " to " + std::to_string(range.high)});
    if (yarn.width > kMostPressed * yarn.spacing())
        throw Error({"yarns " + std::to_string(yarn.width * 1e3) + " mm wide lie " +
                         std::to_string(yarn.spacing() * 1e3) + " mm apart",
                     where, "expected a width_mm of at most 20 / per_cm"});
}

} // namespace

void check_weave(const Weave &weave, const std::string &where) {
    check_draft(weave.draft, where + ".draft");
    check_yarn(weave.warp, where + ".warp");
    check_yarn(weave.weft, where + ".weft");
}

Symmetry symmetry_of(const Weave &weave) {
    const bool twisted = weave.warp.twist_per_m != 0 || weave.weft.twist_per_m != 0;
    if (!twisted && is_same_reversed(weave.draft, true, false) &&
        is_same_reversed(weave.draft, false, true))
        return Symmetry::orthotropic;
    return is_same_reversed(weave.draft, true, true) ? Symmetry::half_turn : Symmetry::none;
}

double transmission(const Yarn &yarn, double wavelength_nm) {
    constexpr double kRed_nm = 610, kGreen_nm = 550, kBlue_nm = 465;
    const auto [red, green, blue] = yarn.transmission;
    if (wavelength_nm >= kGreen_nm)
        return std::lerp(green, red,
                         std::min((wavelength_nm - kGreen_nm) / (kRed_nm - kGreen_nm), 1.0));
    return std::lerp(green, blue,
                     std::min((kGreen_nm - wavelength_nm) / (kGreen_nm - kBlue_nm), 1.0));
}

double scattering_length(std::string_view lustre, const std::string &where) {
    const std::vector<std::string> names{"bright", "semi-dull", "dull"};
    if (lustre == "bright")
        return 0;
    if (lustre == "semi-dull")
        return kSemiDull;
    if (lustre == "dull")
        return kDull;
    throw Error(
        {"unknown lustre \"" + std::string(lustre) + "\"", where, accepted_names(lustre, names)});
}

FilamentOptics optics(const Yarn &yarn, double wavelength_nm) {
    return {.section = yarn.section,
            .corner_rounding = yarn.corner_rounding,
            .refractive_index = yarn.refractive_index
                                    ? *yarn.refractive_index
                                    : refractive_index(yarn.material, wavelength_nm),
            .surface_roughness = yarn.surface_roughness,
            .transmission = transmission(yarn, wavelength_nm),
            .scattering_length = yarn.scattering_length,
            .scattering_anisotropy = kAnisotropy};
}

} // namespace tsuya::lab
