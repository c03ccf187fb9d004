#pragma once
/// \file
/// From linear XYZ to a display, by an OpenColorIO config that is made in memory and can be saved
/// for other programs.
///
///     const DisplayConfig config({{"HP4", white_of(lamp("HP4"))}});
///     const Image rgb = config.display(xyz, "HP4", {.adapt = Adaptation::cat02, .view = "Soft"});

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
    std::string name;              ///< becomes part of the names of colour spaces
    glm::dvec3 white_xyz{1, 1, 1}; ///< XYZ of a perfect white, see white_of
};

/// The views, the first being the default: `Plain`, linear light clamped to sRGB (exact
/// colorimetry); `Soft`, the same up to 0.36 and a shoulder above it, so that highlights do not
/// clip hard (0.18 stays, neutral stays neutral, 1 becomes 0.69, 16 becomes 0.98).
std::vector<std::string> view_names();
/// One line about a view. Throws Error for an unknown one.
std::string view_description(std::string_view view);

/// The shoulder of the view `Soft`: display light of scene light, both linear and 1 at white.
/// Rises everywhere; the identity to 0.36.
double soft_shoulder(double linear);

/// How a picture of XYZ becomes one for a display.
struct DisplayOptions {
    Adaptation adapt = Adaptation::none;
    std::string view = "Plain";
    double exposure_stops = 0; ///< the picture is multiplied by 2^exposure_stops first
    double degree = 1;         ///< of adaptation, 0 to 1, see adaptation_matrix
};

/// Colour spaces: `CIE XYZ D65` (the scene-referred reference), `Linear Rec.709`, and for each lamp
/// `<lamp> as seen`, `<lamp> bradford`, `<lamp> cat02`, without those to whose white no eye adapts,
/// as to that of a single line; display `sRGB` with the views above.
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
    /// under the lamp. A pixel that is not finite becomes NaN in all channels. Rows run in
    /// parallel. Throws Error for an unknown lamp or view, a picture without X, Y, Z, or an
    /// exposure that is not finite.
    Image display(const Image &xyz, const std::string &lamp,
                  const DisplayOptions &options = {}) const;

    /// Names of the colour spaces, as above.
    std::vector<std::string> color_spaces() const;
    /// The config as text (YAML), as OpenColorIO 2.0 and later read it.
    std::string text() const;
    /// Writes text() to a file. Throws Error at the path.
    void save(const std::filesystem::path &path) const;

  private:
    struct Impl;
    explicit DisplayConfig(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

/// The name of the colour space of a lamp and an adaptation, e.g. `HP4 cat02`.
std::string color_space_name(const std::string &lamp, Adaptation adapt);

/// One picture under one lamp, without keeping a config. Throws Error as DisplayConfig, and as
/// adaptation_matrix.
Image display(const Image &xyz, const glm::dvec3 &lamp_white_xyz,
              const DisplayOptions &options = {});

} // namespace tsuya
