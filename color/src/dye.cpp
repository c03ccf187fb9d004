#include "tsuya/color/dye.h"

#include <algorithm>
#include <cmath>

#include "kubelka.h"
#include "lower_case.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

enum class Shape {
    band, ///< a Gaussian; width_nm is its standard deviation
    edge, ///< absorbs below centre_nm; falls from 73 % to 27 % within 2 width_nm
    flat, ///< the same everywhere
};

/// What a dye absorbs, in units of the ratio K/S of absorption to scattering.
struct Absorption {
    Shape shape = Shape::flat;
    double centre_nm = 0;
    double width_nm = 1;
    double strength = 0;

    double at(double nm) const {
        const double x = (nm - centre_nm) / width_nm;
        switch (shape) {
        case Shape::band:
            return strength * std::exp(-0.5 * x * x);
        case Shape::edge:
            return strength / (1 + std::exp(x));
        case Shape::flat:
            break;
        }
        return strength;
    }
};

struct Dye {
    const char *name;
    const char *description;
    std::vector<Absorption> absorptions;
};

// Chosen by eye under D65.
std::vector<Dye> dyes() {
    using enum Shape;
    return {
        {"white", "undyed, bleached silk", {}},
        {"ivory", "silk with some of its sericin left", {{edge, 450, 30, 0.14}}},
        {"silver", "a light neutral grey", {{flat, 0, 1, 0.45}}},
        {"gold", "a warm yellow, as of weld", {{edge, 505, 13, 3.5}, {band, 560, 45, 0.12}}},
        {"vermilion", "an orange red, as of safflower", {{edge, 574, 9, 9}, {edge, 500, 20, 5}}},
        {"madder",
         "a brick red, as of alizarin on alum",
         {{edge, 570, 13, 3.5}, {band, 540, 40, 2.5}, {edge, 500, 20, 3}, {flat, 0, 1, 0.08}}},
        {"crimson",
         "a deep bluish red, as of carmine",
         {{band, 540, 36, 13}, {edge, 485, 22, 9}, {flat, 0, 1, 0.06}}},
        {"rose", "a light bluish red", {{band, 530, 35, 0.7}, {edge, 480, 30, 0.28}}},
        {"violet",
         "a bluish violet",
         {{band, 572, 44, 6}, {edge, 455, 20, 0.3}, {flat, 0, 1, 0.2}}},
        {"indigo",
         "a dark blue, as of indigo",
         {{band, 655, 55, 8}, {band, 570, 50, 5}, {edge, 420, 20, 1}, {flat, 0, 1, 0.4}}},
        {"turquoise",
         "a greenish blue, as of a phthalocyanine",
         {{band, 650, 52, 2}, {edge, 410, 25, 0.4}, {flat, 0, 1, 0.05}}},
        {"emerald", "a deep green", {{band, 660, 58, 5}, {edge, 480, 14, 3.5}, {flat, 0, 1, 0.22}}},
        {"black", "a deep black", {{flat, 0, 1, 24}}},
    };
}

// Undyed cloth: 0.80, down to 0.74 in the violet.
double undyed(double nm) { return 0.80 - 0.06 / (1 + std::exp((nm - 425) / 18)); }

Dye recipe_of(std::string_view name) {
    const std::string wanted = lower_case(name);
    for (Dye &d : dyes())
        if (wanted == d.name)
            return std::move(d);
    throw Error(
        {"there is no dye '" + std::string(name) + "'", "dye", accepted_names(name, dye_names())});
}

Spectrum dyed(const Dye &dye) {
    constexpr int kStepNm = 5;
    Spectrum s{{}, {}};
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; nm += kStepNm) {
        double k_over_s = absorption_of(undyed(nm));
        for (const Absorption &a : dye.absorptions)
            k_over_s += a.at(nm);
        s.wavelength_nm.push_back(nm);
        s.value.push_back(reflectance_of(k_over_s));
    }
    return s;
}

} // namespace

std::vector<std::string> dye_names() {
    std::vector<std::string> names;
    for (const Dye &d : dyes())
        names.emplace_back(d.name);
    return names;
}

Spectrum dye(std::string_view name) { return dyed(recipe_of(name)); }

std::string dye_description(std::string_view name) { return recipe_of(name).description; }

} // namespace tsuya
