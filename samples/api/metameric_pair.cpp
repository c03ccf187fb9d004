// Two dyes that match under D65 and part under A, samples/data/dyes: metameric_pair FOLDER

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <glm/matrix.hpp>

#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/metamerism.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;

constexpr Observer kEye = Observer::cie1964;

/// A smooth band of height 1 about a wavelength.
Spectrum band(double centre_nm, double width_nm) {
    Spectrum spectrum{{}, {}};
    for (int nm = 380; nm <= 780; nm += 5) {
        const double x = (nm - centre_nm) / width_nm;
        spectrum.wavelength_nm.push_back(nm);
        spectrum.value.push_back(std::exp(-0.5 * x * x));
    }
    return spectrum;
}

/// What no eye sees under `lamp`: a band, less the mixture of three others of its colour.
Spectrum metameric_black(const Spectrum &lamp) {
    Spectrum black = band(585, 22);
    const std::array others{band(445, 25), band(535, 25), band(640, 28)};
    glm::dmat3 colours(0.0);
    for (int c = 0; c < 3; ++c)
        colours[c] = xyz_of(lamp, others[static_cast<std::size_t>(c)], kEye);
    const glm::dvec3 share = glm::inverse(colours) * xyz_of(lamp, black, kEye);
    for (int c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < black.value.size(); ++i)
            black.value[i] -= share[c] * others[static_cast<std::size_t>(c)].value[i];
    return black;
}

/// A dye and that amount of a spectrum that is not seen, to the sixth decimal: so far all machines
/// agree.
Spectrum sum(const Spectrum &dye, const Spectrum &unseen, double amount) {
    Spectrum spectrum = unseen;
    for (std::size_t i = 0; i < spectrum.value.size(); ++i)
        spectrum.value[i] =
            std::round(1e6 * (dye.at(spectrum.wavelength_nm[i]) + amount * spectrum.value[i])) /
            1e6;
    check_spectrum(spectrum, 0, 1, "metameric dye");
    return spectrum;
}

} // namespace

int main(int argc, char **argv) {
    try {
        const std::filesystem::path folder = argc > 1 ? argv[1] : ".";
        const Spectrum day = lamp("D65"), night = lamp("A"), unseen = metameric_black(day);
        const Spectrum plum = sum(parse_dye("#7a5c6e"), unseen, 0.09),
                       plum_match = sum(parse_dye("#7a5c6e"), unseen, -0.09);
        const std::string comment =
            "A model, made by samples/api/metameric_pair.cpp: with its pair of one colour under "
            "D65 for 10 degrees, another under A.";
        write_spectrum_csv(folder / "plum.csv", plum, comment);
        write_spectrum_csv(folder / "plum_match.csv", plum_match, comment);
        for (const Spectrum &seen : {day, night}) {
            const glm::dvec3 white = white_of(seen, kEye);
            std::printf("CIEDE2000 %.3f under %s\n",
                        ciede2000(lab_of(xyz_of(seen, plum, kEye), white),
                                  lab_of(xyz_of(seen, plum_match, kEye), white)),
                        seen == day ? "D65" : "A");
        }
        std::printf("metamerism index %.3f\n",
                    metamerism_index(plum, plum_match, day, night, {.observer = kEye}));
        return 0;
    } catch (const Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
