#pragma once
/// \file
/// How much a cloth changes between lamps: differences of adapted pictures, and metamerism.

#include <span>
#include <string>
#include <vector>

#include "tsuya/color/adaptation.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"
#include "tsuya/sdk/spectrum.h"

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

/// How much of each pixel the garment covers: the AOV `garment`, else `coverage`, else alpha; null
/// where the picture has none of them.
const Image *garment_coverage(const SpectralImage &transport);

/// How the pictures of lamps are compared.
struct CompareOptions {
    Adaptation adapt = Adaptation::cat02; ///< each picture is adapted from its lamp to D65
    Observer observer = Observer::cie1931;
    double exposure_stops = 0; ///< the same for all pictures; L* = 100 is Y = 1 after it
};

/// A pixel counts where the garment covers at least half of it, see garment_coverage; where nothing
/// tells, where its transport is not all 0. Pixels that are not finite never count. Alpha is taken
/// out of the colours. One entry a pair of lamps, in the order (0,1), (0,2), ..., (1,2), ...; each
/// lamp lights all groups. Throws Error as relight, and for fewer than two lamps or a name used
/// twice.
std::vector<LampDifference> compare_lamps(const SpectralImage &transport,
                                          std::span<const NamedLamp> lamps,
                                          const CompareOptions &options = {});

/// Special metamerism index for a change of lamp [CIE015] section 9: CIEDE2000 under `test` of two
/// reflectances that look alike under `reference`. What difference they have there is first taken
/// out of the second one, by a factor on X, Y and Z. Throws Error if a lamp has no visible power or
/// the second reflectance is black.
double metamerism_index(const Spectrum &first, const Spectrum &second, const Spectrum &reference,
                        const Spectrum &test, Observer observer = Observer::cie1931);

} // namespace tsuya
