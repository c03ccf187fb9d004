#pragma once
/// \file
/// The lamp's light in single frames, by the part of the picture that always shows it.

#include <map>

#include "frame_patches.h"

namespace tsuya::lab {

/// The mean of the dark frames of one exposure.
struct DarkFrame {
    PixelArea area{};                  ///< all places of the patch
    std::vector<DarkPixels> colours{}; ///< of that area
    std::vector<DarkPixels> monitor{}; ///< empty where the rig has none
};

/// Dark frames by the exposure that was planned.
using DarkFrames = std::map<double, DarkFrame>;

/// The lamp's light in a frame over that in the first of the session.
struct LampShare {
    double value = 1, sigma = 0;
};

class LampMonitor {
  public:
    /// Of one view: for each colour, of each frame. A frame whose monitor is clipped or dark gets
    /// what the view's others say, weighted by their exposures. 1 where the frames have no monitor;
    /// empty where none of the frames tells.
    std::vector<std::vector<LampShare>> shares_of(const std::vector<FramePatches> &frames,
                                                  const DarkFrames &dark, const Sensor &sensor);

  private:
    std::vector<double> first_{}; // DN a second, by colour
};

} // namespace tsuya::lab
