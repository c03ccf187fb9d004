#pragma once
/// \file
/// RIG.toml: what a measuring rig consists of, and what it may be asked to do.

#include "tsuya/lab/gpio_line.h"

#include <array>
#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace tsuya::lab {

/// Durations of a rig file.
using Seconds = std::chrono::duration<double>;

/// What a line is for. Lamp, shutter, half_press and heartbeat are outputs, the others inputs.
enum class LineRole { lamp, shutter, half_press, busy, interlock, estop, heartbeat };
inline constexpr std::size_t kLineRoles = 7;

/// As in the file: `half_press`.
const char *name_of(LineRole role);
/// The program sets the line, see LineRole.
bool is_output(LineRole role);

/// The kind of lamp; the times of RigLamp do not follow from it.
enum class LampKind { metal_halide, tungsten, led };

/// `[lamp]`
struct RigLamp {
    LampKind kind = LampKind::metal_halide;
    std::string serial{};        ///< whose log is kept; may be empty
    Seconds warm_up{900};        ///< lit before the first measurement
    Seconds restrike{900};       ///< off before it is lit again
    Seconds min_on{300};         ///< lit before it is turned off without need
    Seconds hold{600};           ///< stays lit with the shutter closed while a fault is dealt with
    std::filesystem::path log{}; ///< of strikes and hours; empty: none
    double diameter_mm = 0;      ///< of what shines, seen from the cloth; 0: not known
    double distance_mm = 0;      ///< from there to the cloth; 0: not known
    double spot_mm = 0;          ///< full width of the lit spot across the beam at half its light;
                                 ///< 0: not known
};

/// `[shutter]`
struct RigShutter {
    Seconds min_interval{0}; ///< from one opening to the next
    Seconds max_open{60};
    double max_duty = 1; ///< largest share of the time that it is open, 0 to 1
    /// From the line to the blades, at both ends. A camera with a command begins after it; what the
    /// line triggers is dated later by it; nothing moves before it has passed.
    Seconds lag{0};
};

/// Where the measured patch lies in pictures that are taken from an angle.
struct PatchPlace {
    double theta_r_deg = 0; ///< of the camera's axis
    double x = 0, y = 0;    ///< of the patch's middle, pixels from the top left corner
};

/// A rectangle of a picture; row 0 is the top row.
struct PictureArea {
    int x = 0, y = 0;
    int width = 0, height = 0; ///< 0: none
};

/// `[camera]`
struct RigCamera {
    /// Program and arguments, run without a shell, with the placeholders `{file}` and `{exposure}`.
    /// Empty: the shutter line triggers, and pictures arrive in `watch_folder`.
    std::vector<std::string> command{};
    std::filesystem::path watch_folder{};
    Seconds timeout{60}; ///< then the command's process group is killed
    Seconds transfer{2}; ///< from the end of an exposure to the picture, for the plan's estimate
    std::vector<double> exposures_s{}; ///< ascending, at least one
    double black = 0;                  ///< DN without light
    double saturation = 0;             ///< DN from which a pixel is clipped
    double e_per_dn = 0;               ///< electrons a DN
    double read_noise_e = 0;           ///< electrons, root mean square
    int patch = 16;                    ///< pixels along the side of the patch that is averaged
    double pixel_mm = 0;    ///< one pixel on the cloth seen from straight above; 0: not known
    double aperture_mm = 0; ///< diameter of the lens's opening; 0: not known
    double distance_mm = 0; ///< from there to the cloth; 0: not known
    std::string extension = "tif"; ///< of the pictures' names, in lower case: `cr2`
    double frame_mb = 8;           ///< size of a picture, for the plan's estimate
    /// The measured response of a camera whose pictures are encoded; empty: they are linear.
    std::filesystem::path response{};
    /// Where the stage's axis is seen, by ascending angles: linear between them, and as at the
    /// nearest beyond. Empty: always in the middle of the picture.
    std::vector<PatchPlace> patch_at{};
    /// A picture of an even surface in even light, through the lens as it is used: what the lens
    /// leaves for each pixel. Empty: alike for all.
    std::filesystem::path flat{};
    /// A part of every picture in which the lamp's light is seen the same whatever the view, such
    /// as the end of a fibre from the lamp.
    PictureArea monitor{};
};

/// The axes of a rig. With light from (theta_i, phi_i) and the camera at (theta_r, phi_r) the stage
/// turns the cloth by -phi_r, and lamp_phi stands at phi_i - phi_r.
enum class AxisName { lamp_theta, lamp_phi, camera, stage };
inline constexpr std::size_t kAxes = 4;
/// As in the file: `lamp_theta`.
const char *name_of(AxisName axis);

/// What moves an axis.
enum class AxisDrive {
    by_operator, ///< someone is asked to turn it
    command,     ///< a program; its status 0 means that the axis has arrived
    grbl,        ///< a controller that speaks GRBL, on a serial port
};

/// `[axes.NAME]`
struct RigAxis {
    AxisDrive drive = AxisDrive::by_operator;
    std::vector<std::string> command{}; ///< with the placeholders `{axis}` and `{deg}`
    std::string port{};                 ///< of the controller: `/dev/ttyUSB0`
    char letter = 'X';                  ///< of the controller's axis
    double feed_deg_per_min = 600;      ///< how fast the controller moves it
    Seconds timeout{60};                ///< of one movement
    double zero_deg = 0;                ///< position of the drive at the angle 0
    int sign = 1;                       ///< -1: the drive's positions fall as the angle grows
    std::array<double, 2> limits_deg{-180, 180}; ///< positions that the drive can reach
    Seconds settle{0};                           ///< after the arrival
    Seconds move{2};                             ///< a usual movement takes, for the plan's order
    double tolerance_deg = 0.1;                  ///< of a position

    /// The drive's position at an angle of the axis.
    double position_deg(double angle_deg) const { return zero_deg + sign * angle_deg; }
    /// The angle is within the limits of the drive.
    bool reaches(double angle_deg) const {
        const double position = position_deg(angle_deg);
        return position >= limits_deg[0] && position <= limits_deg[1];
    }
};

/// `[sample]`: how cloth, white standard and black trap come under the camera.
struct RigSample {
    AxisDrive drive = AxisDrive::by_operator; ///< by_operator or command
    std::vector<std::string> command{};       ///< with the placeholder `{sample}`
    Seconds timeout{60};                      ///< of the command
    Seconds change{30};                       ///< a change takes, for the plan's estimate
};

/// `[white]`
struct RigWhite {
    /// The standard's reflectance: a number, or a file: a spectrum, or a TABLE.csv of the standard.
    std::variant<double, std::filesystem::path> rho_std = 1.0;
    double height_mm = 0; ///< of its surface above that of the cloth, towards lamp and camera
    double sigma = 0; ///< relative error of its reflectance more than 45 degrees from the normal
};

/// A whole file. Paths are relative to its folder when they are read, and usable afterwards.
struct RigFile {
    std::map<LineRole, GpioLineSettings> lines{};
    RigLamp lamp{};
    RigShutter shutter{};
    RigCamera camera{};
    std::array<RigAxis, kAxes> axes{}; ///< by AxisName
    double dead_cone_deg = 6;          ///< lamp and camera come no nearer to each other
    RigSample sample{};
    RigWhite white{};

    /// The axis of that name.
    const RigAxis &axis(AxisName name) const { return axes[static_cast<std::size_t>(name)]; }
};

/// Reads `schema = "tsuya-rig 1"`. Throws Error with file:line:column of every problem, up to 20:
/// an unknown key, role or name, a value out of range, a placeholder that a command lacks or does
/// not know, a line or a controller's axis that is given twice, a file that is not there. Whether
/// the lines exist on this computer is check_gpio_lines()'s question.
RigFile read_rig_file(const std::filesystem::path &file);

} // namespace tsuya::lab
