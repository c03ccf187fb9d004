#pragma once
/// \file
/// From the pictures of a capture session to reflectance tables, [Takeda] Eq. 2.
///
///     const SessionMeasurement measured = measure_session(read_session("satin/"));
///     write_reflectance_table(measured.channels[0].table, "satin.csv");

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/lab/lamp_drift.h"
#include "tsuya/lab/session.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::lab {

/// Which corrections are made. To leave one out shows what it does.
struct Corrections {
    bool black = true;   ///< the sensor's numbers without light
    bool dark = true;    ///< dark current and what black is now, from dark frames
    bool flat = true;    ///< vignetting, from the rig's flat field
    bool monitor = true; ///< the lamp's light in single frames, from the rig's monitor
    bool trap = true;    ///< stray light, from frames of the black trap
    bool drift = true;   ///< of the lamp, between white frames; else the first one is taken
};

/// How the pictures of a session are measured.
struct MeasureSettings {
    /// One repeat of the weave along weft and warp, mm; with the rig's `pixel_mm` the patch is cut
    /// to whole repeats. Nothing: all pixels of the patch alike.
    std::optional<std::array<double, 2>> repeat_mm{};
    double jump_limit = 0.02; ///< relative difference of two white frames that is no drift, > 0
    Corrections corrections{};
};

/// Why a view is not in the table.
enum class LeftOutReason {
    saturated,      ///< a pixel of the patch is clipped under every exposure
    underexposed,   ///< no more light than its noise, stray light taken off
    missing,        ///< a frame was not taken, or cannot be read
    unsharp,        ///< far less contrast from pixel to pixel than other views of the same tilt
    misplaced,      ///< the patch is not lit all over, or not all cloth
    wrong_exposure, ///< the picture says another exposure than planned
    lamp_jump,      ///< the white frames about it differ by more than the limit
    no_reference,   ///< there is no white frame of its light and lighting
};

/// As in reports: `lamp-jump`.
const char *name_of(LeftOutReason reason);

/// A view that is not in the table.
struct LeftOutView {
    std::size_t view = 0; ///< as in the plan
    DirectionPair directions{};
    LeftOutReason reason = LeftOutReason::missing;
    std::string detail{}; ///< one sentence with the numbers
};

/// A value with the parts of its standard error, all in 1/sr.
struct MeasuredView {
    std::size_t view = 0; ///< as in the plan
    DirectionPair directions{};
    double time_s = 0; ///< middle of its exposures, weighted by their length; seconds since 1970
    double brdf_per_sr = 0;
    double noise = 0;   ///< photons, read-out and dark frames
    double drift = 0;   ///< of the lamp and of the white frames
    double texture = 0; ///< of the place on the cloth: 0 where the patch is whole repeats
    double white = 0;   ///< of the standard's reflectance

    /// The root of the sum of the squares.
    double sigma_per_sr() const;
};

/// The white standard over the session, for one direction of light.
struct LampCourse {
    double theta_i = 0, phi_i = 0;
    std::vector<WhiteReading> readings{};
};

/// One colour of the camera.
struct ChannelMeasurement {
    std::string name{}; ///< R, G, B, or as the picture names its only one
    ReflectanceTable table{};
    std::vector<MeasuredView> views{}; ///< in the order of the table's rows
    std::vector<LampCourse> lamp{};
    double flicker = 0; ///< relative, of single frames; 0 where it cannot be told
};

/// What the pictures of a session give: a table for each channel of the camera.
struct SessionMeasurement {
    std::vector<ChannelMeasurement> channels{}; ///< one or more, all with the same views
    std::vector<LeftOutView> left_out{};        ///< by view; each view once
    double lamp_angle = 0;     ///< that the lamp fills, seen from the cloth, radians; 0: not known
    double aperture_angle = 0; ///< that the lens fills
    double narrowest_lobe = 0; ///< full width at half maximum, radians
    /// Largest over the channels: mean absolute difference to their mean over that.
    double channel_difference = 0;
    std::vector<std::string> warnings{};
};

/// Measures. Values: black and dark current taken off, exposures merged, the mean over the patch,
/// stray light taken off, over the white standard at the time, times rho_std / pi. The table's keys
/// tell instrument, lamp, camera, hashes of plan and journal, and warnings. Throws Error for a
/// session without cloth, white or readable frames, a white standard whose file does not hold its
/// directions, settings out of range; Interrupted at progress.stop.
SessionMeasurement measure_session(const Session &session, const MeasureSettings &settings = {},
                                   const Progress &progress = {});

} // namespace tsuya::lab
