#pragma once
/// \file
/// What the lens and the sensor leave of even light, pixel by pixel.

#include "frame_patches.h"

namespace tsuya::lab {

class FlatField {
  public:
    /// Even: divides by 1.
    FlatField() = default;
    /// \param flat of a picture of an even surface, of all places of the patch. Throws Error naming
    /// the file for a pixel that is clipped or dark.
    FlatField(const FramePatches &flat, const Sensor &sensor, const std::filesystem::path &file);

    /// Divides the pixels of an area by what they get over the mean of all places, and adds the
    /// flat picture's noise.
    void apply(PixelRates &pixels, std::size_t colour, const PixelArea &area) const;

  private:
    struct Colour {
        std::vector<double> gain{}, sigma{}; // NaN where the pixel is of another colour
    };
    PixelArea area_{};
    std::vector<Colour> colours_{};
};

} // namespace tsuya::lab
