#pragma once
/// \file
/// From lamp-free light transport to a picture under any lamp: K multiply-adds a pixel.

#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/sdk/dye_depths.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_basis.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// XYZ that each basis function adds: the sums of lamp x observer x basis over color_weights, so
/// that T = 1 in all channels gives Y = 1. One entry a channel. Throws Error if the lamp has no
/// visible power.
std::vector<glm::dvec3> lamp_matrix(const Spectrum &lamp, const SpectralBasis &basis,
                                    Observer observer = Observer::cie1931);

/// The same for depths of dye: basis functions are the DepthWeights at the dyes' reflectances.
std::vector<glm::dvec3> lamp_matrix(const Spectrum &lamp, const DyeDepths &depths,
                                    Observer observer = Observer::cie1931);

/// The observer and the power of the groups.
struct RelightOptions {
    Observer observer = Observer::cie1931;
    /// Luminous power of each light group beside the others, >= 0; empty is 1 for all.
    std::vector<double> group_scale{};
};

/// The picture under `lamps`: one lamp for all light groups, or one for each, in the order of
/// `transport.groups`. Channels X, Y, Z: linear, scene-referred, relative to each lamp (a perfect
/// white that a group lights with irradiance pi has Y = 1). Rows run in parallel, as
/// detail::run_with_threads says. Throws Error if the numbers of lamps or scales do not fit the
/// groups, a lamp has no visible power, or the picture is radiance and a lamp is not E.
Image relight(const SpectralImage &transport, std::span<const Spectrum> lamps,
              const RelightOptions &options = {});
/// The same with one lamp for all light groups.
Image relight(const SpectralImage &transport, const Spectrum &lamp,
              const RelightOptions &options = {});

/// What lights a picture: lamps with their factors, and the name that they have together.
struct Lighting {
    std::string name{};             ///< in reports
    std::string caption{};          ///< what to write under a picture
    std::vector<NamedLamp> lamps{}; ///< one for all light groups, or one for each
};

/// One lamp for all light groups, with its name and caption.
Lighting lighting_of(const NamedLamp &lamp);

/// Throws Error as relight if lamps or their factors do not fit the light groups, or the picture is
/// radiance, see SpectralImage::emissive, and a lamp is not E.
void check_lighting(const SpectralImage &transport, const Lighting &lighting);

/// The picture under a lighting. Throws Error as relight.
Image relight(const SpectralImage &transport, const Lighting &lighting,
              Observer observer = Observer::cie1931);

/// The white, with Y = 1, to which an eye is used that looks at the picture: that of its lamp;
/// under several lamps their mean, weighed by the light that each brings to the garment (its factor
/// times the mean transport of its group over garment_pixels, all pixels where there are none).
/// Throws Error as relight.
glm::dvec3 adopted_white(const SpectralImage &transport, const Lighting &lighting,
                         Observer observer = Observer::cie1931);

/// Takes the share of alpha out of a picture (X, Y, Z as relight makes it): what is left are the
/// colours of the covered part of each pixel, 0 where nothing is covered.
/// \param alpha of the same size, one channel
void divide_by_alpha(Image &xyz, const Image &alpha);

} // namespace tsuya
