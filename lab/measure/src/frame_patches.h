#pragma once
/// \file
/// The part of a picture that is measured: a patch in the middle, and patches about it.

#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/exposure_merge.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// Patches of `side` pixels, `across` x `across` of them about the middle of the picture.
struct PatchGrid {
    PixelArea area{};
    int side = 0;
    int across = 1; ///< 1 or 3

    int width() const { return side * across; }
};

/// Throws Error naming the file where not one patch fits.
PatchGrid grid_of(const std::filesystem::path &file, int width, int height, int side);

/// One colour of the area.
struct ColourPixels {
    std::string name{};
    ExposedPixels pixels{};
};

/// A frame's numbers, one part for each colour.
struct FramePatches {
    std::vector<ColourPixels> colours{};
    std::optional<double> exposure_s{}; ///< as the picture says
};

/// Reads the measured parts of a session's frames, which are all of one size.
class PatchReader {
  public:
    explicit PatchReader(const RigCamera &camera);

    /// \param exposure_s that the numbers are taken with. Throws Error.
    FramePatches read(const std::filesystem::path &file, double exposure_s);
    /// Of the frames read so far.
    const PatchGrid &grid() const { return *grid_; }

  private:
    RigCamera camera_;
    std::optional<ResponseCurve> response_{};
    std::optional<PatchGrid> grid_{};
};

} // namespace tsuya::lab
