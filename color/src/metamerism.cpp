#include "tsuya/color/metamerism.h"

#include <array>

#include <glm/matrix.hpp>

#include "tsuya/color/adaptation.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// What the reference lamp and the observer see of a spectrum is spanned by these three, at 1 nm.
std::array<Spectrum, 3> seen_basis(const Spectrum &reference, Observer observer) {
    std::array<Spectrum, 3> basis;
    for (Spectrum &function : basis)
        function = {{}, {}};
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        for (int c = 0; c < 3; ++c) {
            basis[static_cast<std::size_t>(c)].wavelength_nm.push_back(nm);
            basis[static_cast<std::size_t>(c)].value.push_back(reference.at(nm) *
                                                               color_matching(observer, nm)[c]);
        }
    return basis;
}

/// XYZ under `test` of the second cloth with the seen part of the first: the second's own, plus
/// that of the combination of the basis that closes the difference under the reference lamp.
/// [ISO18314] section 8.3.3
// Differs from [ISO18314]: sums run at 1 nm, not at the samples of an instrument.
glm::dvec3 spectrally_corrected(const ClothPair &reference_xyz, const glm::dvec3 &second_test,
                                const Spectrum &reference, const Spectrum &test,
                                Observer observer) {
    glm::dmat3 seen(0.0), tested(0.0);
    const std::array<Spectrum, 3> basis = seen_basis(reference, observer);
    for (int c = 0; c < 3; ++c) {
        seen[c] = xyz_of(reference, basis[static_cast<std::size_t>(c)], observer);
        tested[c] = xyz_of(test, basis[static_cast<std::size_t>(c)], observer);
    }
    return second_test +
           tested * (glm::inverse(seen) * (reference_xyz.first - reference_xyz.second));
}

} // namespace

double metamerism_multiplicative(const ClothPair &reference_xyz, const ClothPair &test_xyz,
                                 const glm::dvec3 &white_xyz, DifferenceFormula formula) {
    const glm::dvec3 &second = reference_xyz.second;
    if (!(second.x > 0 && second.y > 0 && second.z > 0))
        throw Error({"the second reflectance is black under the reference lamp", "reflectance",
                     "expected a reflectance with X, Y and Z greater than 0"});
    const glm::dvec3 corrected = test_xyz.second * (reference_xyz.first / second);
    return color_difference(formula, lab_of(test_xyz.first, white_xyz),
                            lab_of(corrected, white_xyz));
}

double metamerism_additive(const ClothPair &reference_lab, const ClothPair &test_lab,
                           DifferenceFormula formula) {
    return color_difference(formula, test_lab.first,
                            test_lab.second - (reference_lab.second - reference_lab.first));
}

double metamerism_index(const Spectrum &first, const Spectrum &second, const Spectrum &reference,
                        const Spectrum &test, const MetamerismOptions &options) {
    const Observer observer = options.observer;
    const ClothPair before{xyz_of(reference, first, observer), xyz_of(reference, second, observer)},
        after{xyz_of(test, first, observer), xyz_of(test, second, observer)};
    const glm::dvec3 white = white_of(test, observer);
    switch (options.correction) {
    case MetamerismCorrection::additive: {
        const glm::dvec3 white_before = white_of(reference, observer);
        return metamerism_additive(
            {lab_of(before.first, white_before), lab_of(before.second, white_before)},
            {lab_of(after.first, white), lab_of(after.second, white)}, options.formula);
    }
    case MetamerismCorrection::spectral: {
        const glm::dvec3 corrected =
            spectrally_corrected(before, after.second, reference, test, observer);
        return color_difference(options.formula, lab_of(after.first, white),
                                lab_of(corrected, white));
    }
    case MetamerismCorrection::multiplicative:
        break;
    }
    return metamerism_multiplicative(before, after, white, options.formula);
}

double color_inconstancy(const glm::dvec3 &reference_xyz, const glm::dvec3 &reference_white_xyz,
                         const glm::dvec3 &test_xyz, const glm::dvec3 &test_white_xyz) {
    const glm::dmat3 adapt =
        adaptation_matrix(Adaptation::cat02, test_white_xyz, reference_white_xyz);
    return cmc(lab_of(reference_xyz, reference_white_xyz),
               lab_of(adapt * test_xyz, reference_white_xyz));
}

} // namespace tsuya
