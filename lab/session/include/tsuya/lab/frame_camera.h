#pragma once
/// \file
/// What a session needs of a camera and of the pictures that it makes.

#include <filesystem>
#include <functional>
#include <optional>

#include "tsuya/lab/plan.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// One exposure that a camera is asked for.
struct Shot {
    std::optional<std::size_t> number{}; ///< of the frame in the plan; none beside the plan
    PlannedFrame planned{};
    std::filesystem::path file{}; ///< where the picture shall stand; nothing is there yet
    double time_s = 0;            ///< when the exposure begins, seconds since 1970
};

/// A camera of the rig. Derive from it for another kind. Errors of both functions are recoverable:
/// the shot is tried again.
class FrameCamera {
  public:
    FrameCamera() = default;
    FrameCamera(const FrameCamera &) = delete;
    FrameCamera &operator=(const FrameCamera &) = delete;
    virtual ~FrameCamera() = default;

    /// Exposes, and returns when the exposure is over. The shutter is open meanwhile, unless the
    /// frame is dark. Throws Error if the camera refuses, Interrupted at a stop.
    virtual void expose(const Shot &shot) = 0;
    /// Puts the picture at `shot.file`. The shutter is closed. Throws Error if none comes in time.
    virtual void collect(const Shot &shot) = 0;
};

/// The largest share by which the exposure that a picture states may differ from the planned one.
inline constexpr double kExposureTolerance = 0.1;

/// What a picture says about itself.
struct FrameFacts {
    std::optional<double> exposure_s{}; ///< seconds; nothing where the file does not say
    double patch_mean = 0;              ///< mean DN of the patch, black removed
};

/// Decodes a picture that was taken from an angle theta_r. Throws Error naming it if it is no whole
/// picture.
using FrameReader = std::function<FrameFacts(const std::filesystem::path &file,
                                             const RigCamera &camera, double theta_r)>;

} // namespace tsuya::lab
