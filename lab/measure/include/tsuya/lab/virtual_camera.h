#pragma once
/// \file
/// A camera that exists only as numbers: it looks at a cloth whose reflectance is known, with the
/// faults and the noise of a real one.
///
///     VirtualCamera camera({.cloth = [](const DirectionPair &) { return 0.02; }}, rig.camera);

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/clock.h"
#include "tsuya/lab/frame_camera.h"
#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// What stands in front of the virtual camera.
struct VirtualScene {
    /// The reflectance of the cloth in 1/sr, 0 or more.
    std::function<double(const DirectionPair &)> cloth{};
    double white_reflectance = 0.99; ///< of the white standard, an ideal diffuser
    double white_dn_per_s = 10000;   ///< of the white standard lit from straight above
    double stray = 3e-4;             ///< of the white standard's light, on every open frame
    double drift = 0.02;             ///< the lamp becomes brighter by this share
    double drift_s = 5400;           ///< in this time, as 1 - exp(-t / drift_s)
    double flicker = 0.002;          ///< relative, of single frames
    double contrast = 0.5;           ///< standard deviation over mean of the cloth's texture
    /// Repeat of the texture along weft and warp, mm; {0, 0}: log-normal and independent from pixel
    /// to pixel and from view to view.
    std::array<double, 2> repeat_mm{0.4, 0.4};
    std::optional<std::size_t> glint_view{}; ///< a view of the plan that is far too bright
    /// What each pixel of a frame of the cloth or of the white standard sees, as a rendered picture
    /// of one channel: 1 is a perfect white lit from straight above. `cloth`, the texture and the
    /// cosine of the light are not used then. Empty: an even patch of the above.
    std::function<Image(const PlannedFrame &frame, int width, int height)> picture{};
};

/// What the virtual camera does wrong.
enum class CameraFault {
    busy,           ///< refuses to expose
    hang,           ///< no picture comes in time
    no_file,        ///< says that all is well, and there is none
    empty_file,     ///< of 0 bytes
    cut_file,       ///< half of the bytes
    old_file,       ///< the picture before again
    wrong_exposure, ///< half of what was asked for
};

/// The sensor of a virtual camera, and its faults.
struct VirtualCameraSettings {
    int width = 64, height = 64; ///< pixels
    double dark_e_per_s = 2;     ///< dark current, electrons a second
    double black_shift = 0;      ///< DN without light over the rig's `black`, as of a warm sensor
    double vignetting = 0;       ///< share of the light that the picture's corner lacks: r^2 of it
    double monitor_dn_per_s = 0; ///< of the rig's monitor; 0: the cloth is seen there
    std::uint32_t seed = 1;      ///< of all noise
    /// The fault of the n-th exposure, from 0. May be empty.
    std::function<std::optional<CameraFault>(std::uint64_t n)> fault{};
};

/// Black, saturation, electrons a DN, read noise, patch and pixel size are those of the rig's
/// camera. Numbers depend on the frame and not on the order of exposures, but for the lamp's drift,
/// which begins with the first exposure.
class VirtualCamera final : public FrameCamera {
  public:
    /// \param clock in which exposures last; may be null; must outlive the camera
    VirtualCamera(VirtualScene scene, RigCamera camera, VirtualCameraSettings settings = {},
                  Clock *clock = nullptr);

    void expose(const Shot &shot) override;
    /// Writes a TIFF: `shot.file` ends in .tif.
    void collect(const Shot &shot) override;

    /// Light of an even patch in DN a second, without stray light, texture and noise.
    double dn_per_s(const PlannedFrame &frame, double time_s) const;

  private:
    CameraFrame picture_of(const Shot &shot, double exposure_s) const;
    /// Of the cloth or the white standard at each pixel.
    Image sample_dn_per_s(const PlannedFrame &frame, double time_s) const;
    /// Of the lamp's first light.
    double lamp_share(double time_s) const;
    bool is_monitor(int x, int y) const;
    /// The share of the light that the lens leaves for a pixel.
    double lens_at(int x, int y) const;
    double light_of_white(const PlannedFrame &frame, double time_s) const;

    VirtualScene scene_;
    RigCamera camera_;
    VirtualCameraSettings settings_;
    Clock *clock_;
    std::optional<double> first_time_s_{};
    std::optional<CameraFault> fault_{};
    std::filesystem::path last_{}; // the picture before
    std::uint64_t exposures_ = 0;
};

} // namespace tsuya::lab
