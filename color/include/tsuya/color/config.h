#pragma once
/// \file
/// From linear XYZ to a display, by an OpenColorIO config that is made in memory and can be saved
/// for other programs, or by a config of one's own.
///
///     const Image rgb = display(xyz, white_of(lamp("HP4")), {.adapt = Adaptation::cat02});

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec3.hpp>

#include "tsuya/color/adaptation.h"
#include "tsuya/sdk/image.h"

namespace tsuya {

/// A lamp as a display config needs it.
struct LampWhite {
    std::string name;              ///< becomes part of the names of looks
    glm::dvec3 white_xyz{1, 1, 1}; ///< XYZ of a perfect white, see white_of
};

/// The views, the first being the default: `Plain`, linear light clamped to the display (exact
/// colorimetry); `Soft`, the same up to 0.5 and a shoulder above it, so that highlights do not clip
/// hard (0.18 stays, neutral stays neutral, 1 becomes 0.78, 16 becomes 0.995).
std::vector<std::string> view_names();
/// One line about a view. Throws Error for an unknown one.
std::string view_description(std::string_view view);

/// The shoulder of the view `Soft`: display light of scene light, both linear and 1 at white.
/// Rises everywhere; the identity to 0.5.
double soft_shoulder(double linear);

/// The displays: sRGB, Display P3, Rec.709 and Rec.2020 (both with the curve of Rec. 1886),
/// Rec.2100-PQ and Rec.2100-HLG, whose diffuse white is 203 cd/m2 [BT2408].
std::vector<std::string> display_names();
/// One line about a display. Throws Error for an unknown one.
std::string display_description(std::string_view display);

/// How a picture of XYZ becomes one for a display.
struct DisplayOptions {
    Adaptation adapt = Adaptation::none;
    /// Of view_names(), or of `config`; empty: the first of the display. Displays of high dynamic
    /// range need no shoulder and have `Plain` alone.
    std::string view = "Plain";
    double exposure_stops = 0; ///< the picture is multiplied by 2^exposure_stops first
    double degree = 1;         ///< of adaptation, 0 to 1, see adaptation_matrix
    /// Of display_names(), or of `config`; empty: its first
    std::string display = "sRGB";
    /// A config in the place of ours: a file with the role aces_interchange. [OpenColorIO]
    std::filesystem::path config{};
};

/// Scene-referred colour spaces: `CIE XYZ D65` (the reference), `Linear Rec.709`, `Linear
/// Rec.2020`, `Linear Display P3`, `ACES2065-1`, `ACEScg`, `ACEScct`, `Raw`; displays and views as
/// above; for each lamp the looks `<lamp> bradford` and `<lamp> cat02`, which adapt a picture in
/// CIE XYZ from the lamp to D65, without those to whose white no eye adapts, as to that of a single
/// line; the roles of interchange.
class DisplayConfig {
  public:
    /// Throws Error for an empty or repeated lamp name or a white without Y > 0.
    explicit DisplayConfig(const std::vector<LampWhite> &lamps);
    /// Opens a saved config. Throws Error at the path if it cannot be read or is none of ours.
    static DisplayConfig load(const std::filesystem::path &path);
    ~DisplayConfig();
    /// Moves; the config moved from may only be assigned to.
    DisplayConfig(DisplayConfig &&) noexcept;
    /// As the move constructor.
    DisplayConfig &operator=(DisplayConfig &&) noexcept;

    /// Display-encoded R, G, B in [0, 1] of a picture with channels X, Y, Z (as relight makes it)
    /// under the lamp, by its look. A pixel that is not finite becomes NaN in all channels. Rows
    /// run in parallel. Throws Error for an unknown lamp, display or view, a picture without X, Y,
    /// Z, an exposure that is not finite, or a degree of adaptation other than 1: looks adapt
    /// fully.
    Image display(const Image &xyz, const std::string &lamp,
                  const DisplayOptions &options = {}) const;

    /// Names of the colour spaces, as above, and of displays.
    std::vector<std::string> color_spaces() const;
    /// Names of the looks.
    std::vector<std::string> looks() const;
    /// The config as text (YAML), as OpenColorIO 2.0 and later read it.
    std::string text() const;
    /// Writes text() to a file. Throws Error at the path.
    void save(const std::filesystem::path &path) const;

  private:
    struct Impl;
    explicit DisplayConfig(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The config with looks for all of lamp_names().
DisplayConfig full_config();

/// The name of the look of a lamp and an adaptation, e.g. `HP4 cat02`; empty for `none`.
std::string look_name(const std::string &lamp, Adaptation adapt);

/// One picture under one lamp, or any white. Displays other than sRGB and configs of one's own are
/// left to OpenColorIO. Throws Error as DisplayConfig, and as adaptation_matrix; at the config's
/// path where it cannot be read, has no role aces_interchange, or has no such display or view.
Image display(const Image &xyz, const glm::dvec3 &lamp_white_xyz,
              const DisplayOptions &options = {});

/// Throws Error as `display` for options that fit no picture, without looking at the config's file.
void check_display_options(const DisplayOptions &options);

} // namespace tsuya
