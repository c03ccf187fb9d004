#pragma once
/// \file
/// One exposure for all pictures of a job, metered on the garment that they show.
///
///     ExposureMeter meter(look);
///     meter.add(transport, {&lamp, 1});
///     look.exposure_stops = meter.stops();

#include <optional>
#include <span>

#include "tsuya/color/compare.h"
#include "tsuya/color/config.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

/// The rule: of the pixels that the garment fills, nine in ten are no brighter than 235 of 255 in
/// the picture, by luminance, and at most one in a hundred has a channel at 255. Of several
/// pictures, the one that asks for the least exposure decides: so a white dress shows at about 235,
/// and what is darker beside it stays darker. A dark garment alone is brightened as by any meter.
class ExposureMeter {
  public:
    /// \param look how the pictures are shown; its exposure is not looked at. Throws Error for an
    /// unknown view.
    explicit ExposureMeter(const DisplayOptions &look);

    /// A picture of the job, under lamps as picture_under has them. Where nothing tells what the
    /// garment covers (see garment_coverage), all pixels with light count. Throws Error as relight.
    void add(const SpectralImage &transport, std::span<const NamedLamp> lamps);
    /// For DisplayOptions::exposure_stops, -20 to 20; 0 where no picture has a pixel that counts.
    double stops() const;

  private:
    DisplayOptions look_;
    double bright_, clipped_; ///< scene light that shows as 235, and as 255
    std::optional<double> stops_{};
};

} // namespace tsuya::scene
