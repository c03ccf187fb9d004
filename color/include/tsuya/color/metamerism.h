#pragma once
/// \file
/// Two cloths that look alike under one lamp and part under another, and one cloth that does not
/// keep its colour.

#include <glm/vec3.hpp>

#include "tsuya/color/difference.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Tristimulus values or CIELAB colours of two cloths under one lamp; the first is the standard.
struct ClothPair {
    glm::dvec3 first{0, 0, 0};
    glm::dvec3 second{0, 0, 0};
};

/// Metamerism index where the difference that the cloths already have under the reference lamp is
/// taken out of the second one by a factor on each of X, Y and Z. [ISO18314] Throws Error if the
/// second is black under the reference lamp.
/// \param white_xyz of the test lamp
double metamerism_multiplicative(const ClothPair &reference_xyz, const ClothPair &test_xyz,
                                 const glm::dvec3 &white_xyz,
                                 DifferenceFormula formula = DifferenceFormula::ciede2000);

/// The same where the difference is subtracted in CIELAB. [ISO18314]
double metamerism_additive(const ClothPair &reference_lab, const ClothPair &test_lab,
                           DifferenceFormula formula = DifferenceFormula::ciede2000);

/// How the difference under the reference lamp is taken out. `spectral` gives the second cloth the
/// part of the first one's reflectance that the reference lamp and the observer see, by the
/// decomposition of Cohen and Kappauf; black cloths need no exception there.
enum class MetamerismCorrection { multiplicative, additive, spectral };

/// How an index is formed.
struct MetamerismOptions {
    Observer observer = Observer::cie1931;
    MetamerismCorrection correction = MetamerismCorrection::multiplicative;
    DifferenceFormula formula = DifferenceFormula::ciede2000;
};

/// Metamerism index for a change of lamp [ISO18314] [CIE015] section 9: the colour difference
/// under `test` of two reflectances that look alike under `reference`. Throws Error if a lamp has
/// no visible power, and as metamerism_multiplicative.
double metamerism_index(const Spectrum &first, const Spectrum &second, const Spectrum &reference,
                        const Spectrum &test, const MetamerismOptions &options = {});

/// The colour inconstancy index CMCCON02 [ISO105J05]: CMC(2:1) between what a cloth is under the
/// reference lamp, its standard, and what it is under the test lamp to an eye that is fully adapted
/// to that, by CAT02. Throws Error if no eye adapts to the test lamp, see can_adapt.
double color_inconstancy(const glm::dvec3 &reference_xyz, const glm::dvec3 &reference_white_xyz,
                         const glm::dvec3 &test_xyz, const glm::dvec3 &test_white_xyz);

} // namespace tsuya
