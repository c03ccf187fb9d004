#pragma once
/// \file
/// How much a cloth changes between lamps: differences of adapted pictures.

#include <span>
#include <string>
#include <vector>

#include "tsuya/color/adaptation.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/picture_region.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// CIEDE2000 between the picture under one lamp and under another, over the pixels that count.
struct LampDifference {
    std::string first;
    std::string second;
    double mean = 0;
    double p95 = 0; ///< 95th percentile, nearest rank
    double max = 0;
    std::size_t pixels = 0; ///< how many counted; all measures are 0 where none did
};

/// How the pictures of lamps are compared.
struct CompareOptions {
    Adaptation adapt = Adaptation::cat02; ///< each picture is adapted from its lamp to D65
    Observer observer = Observer::cie1931;
    double exposure_stops = 0; ///< the same for all pictures; L* = 100 is Y = 1 after it
};

/// A pixel counts where garment_pixels says so. Pixels that are not finite never count. Alpha is
/// taken out of the colours. One entry a pair of lightings, in the order (0,1), (0,2), ..., (1,2),
/// ...; each is adapted from its adopted_white. Throws Error as relight, and for fewer than two
/// lightings or a name used twice.
std::vector<LampDifference> compare_lightings(const SpectralImage &transport,
                                              std::span<const Lighting> lightings,
                                              const CompareOptions &options = {});

/// The same, each lamp lighting all groups.
std::vector<LampDifference> compare_lamps(const SpectralImage &transport,
                                          std::span<const NamedLamp> lamps,
                                          const CompareOptions &options = {});

} // namespace tsuya
