#pragma once
/// \file
/// From the numbers of a camera to light: exposures of one view become a rate for each pixel, and
/// the pixels of a patch a mean with its error.

#include <span>
#include <vector>

namespace tsuya::lab {

/// What is known of a sensor.
struct Sensor {
    double black = 0;          ///< DN without light; used where there is no dark frame
    double saturation = 65535; ///< DN from which a pixel is clipped
    double e_per_dn = 1;       ///< electrons a DN
    double read_noise_e = 0;   ///< electrons, root mean square
};

/// Pixels under one exposure. NaN: the pixel is of another colour.
struct ExposedPixels {
    double exposure_s = 0;
    std::vector<double> dn{}; ///< as the camera gives them, black included
};

/// The mean of the dark frames of one exposure: black and dark current of each pixel.
struct DarkPixels {
    double exposure_s = 0;
    int frames = 0; ///< how many; 0: none, and `dn` is empty
    std::vector<double> dn{};
};

/// Light of pixels, DN a second above black and dark current.
struct PixelRates {
    std::vector<double> rate{};     ///< NaN as in ExposedPixels
    std::vector<double> variance{}; ///< photons, read-out, rounding and dark frames
    /// The pixel is clipped under every exposure: its rate is that of the shortest, a lower bound.
    std::vector<bool> clipped{};
};

/// The share of the saturation above which an exposure of a pixel is not used.
inline constexpr double kUsableShare = 0.9;

/// The mean of dark frames of one exposure. Throws Error for none, or frames of other sizes.
DarkPixels mean_of_dark(std::span<const ExposedPixels> frames);

/// Merges exposures of one view as sum(DN) / sum(t), over the exposures in which the pixel is not
/// above kUsableShare of the saturation. Weights that depend on the pixel's own noisy value would
/// favour values that came out low. `dark` has one for each exposure, in the same order; one
/// without frames leaves sensor.black. Throws Error for no exposure, and sizes that differ.
PixelRates merge_exposures(std::span<const ExposedPixels> exposures,
                           std::span<const DarkPixels> dark, const Sensor &sensor);

/// The weighted mean of pixels with its noise.
struct PatchMean {
    double rate = 0;  ///< DN a second
    double sigma = 0; ///< of photons, read-out and dark frames
    int clipped = 0;  ///< pixels with a weight that every exposure clips
    /// Mean squared step between neighbours, without what noise makes of it, over rate^2; and the
    /// standard error that noise gives it. 0 for a single pixel and where there is no light.
    double sharpness = 0, sharpness_sigma = 0;
};

/// A square patch of `side` pixels whose corner is at (x, y) of a block that is `width` wide.
/// `weights` has side x side values; pixels that are NaN do not count, the others are scaled to a
/// sum of 1. No pixel is dropped for being clipped: that would darken the mean of a glittering
/// cloth. Throws Error where no pixel counts.
PatchMean mean_of_patch(const PixelRates &pixels, int width, int x, int y, int side,
                        std::span<const double> weights);

} // namespace tsuya::lab
