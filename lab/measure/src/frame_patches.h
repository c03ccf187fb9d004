#pragma once
/// \file
/// The part of a picture that is measured: a patch, and patches about it.

#include <optional>
#include <string>
#include <vector>

#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/exposure_merge.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// Patches of `side` pixels, `across` x `across` of them about the one that is measured.
struct PatchGrid {
    PixelArea area{};
    int side = 0;
    int across = 1; ///< 1 or 3

    int width() const { return side * across; }
};

/// Where the patch lies in a picture that is taken from theta_r. Throws Error naming the file where
/// not one patch fits.
PatchGrid grid_of(const std::filesystem::path &file, int width, int height, const RigCamera &camera,
                  double theta_r);

/// One colour of an area.
struct ColourPixels {
    std::string name{};
    ExposedPixels pixels{};
};

/// A frame's numbers, one part for each colour.
struct FramePatches {
    PatchGrid grid{};
    std::vector<ColourPixels> colours{};
    std::vector<ColourPixels> monitor{}; ///< empty where the rig has none
    double planned_s = 0;                ///< the exposure that was planned
    std::optional<double> exposure_s{};  ///< as the picture says
};

/// A part of a rectangle of pixels that lies in it.
std::vector<double> part_of(const std::vector<double> &pixels, const PixelArea &from,
                            const PixelArea &part);

/// Reads the measured parts of a session's frames, which are all of one size.
class PatchReader {
  public:
    explicit PatchReader(const RigCamera &camera);

    /// The patches of a picture that is taken from theta_r. \param planned_s the exposure that the
    /// numbers are taken with. Throws Error, also for a picture of another size than the first.
    FramePatches read(const std::filesystem::path &file, double planned_s, double theta_r);
    /// The same of all places that the patch can have, as one grid of one patch.
    FramePatches read_reach(const std::filesystem::path &file, double planned_s);

  private:
    void take_size(const std::filesystem::path &file);
    FramePatches read_parts(const std::filesystem::path &file, double planned_s,
                            const PatchGrid &grid) const;
    CameraFrame read_area(const std::filesystem::path &file, const PixelArea &area) const;

    RigCamera camera_;
    std::optional<ResponseCurve> response_{};
    int width_ = 0, height_ = 0; // of the first picture
};

} // namespace tsuya::lab
