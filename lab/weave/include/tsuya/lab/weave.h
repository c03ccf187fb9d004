#pragma once
/// \file
/// A weave and its yarns, as authored: by name, from a TOML file or from a WIF draft.
///
///     [weave]
///     draft = "satin 5"          # or plan = ["X.", ".X"]: a row a pick, the last pick first
///     preset = "silk charmeuse"  # where all that is not said here comes from
///     name = "my satin"
///     [warp]                     # [weft] alike
///     per_cm = 76                # ends or picks per centimetre
///     width_mm = 0.125           # of a yarn by itself; wider than 10 / per_cm: they are pressed
///     flattening = 0.4           # thickness / width
///     filaments = 24
///     section = "round"          # triangular, trilobal
///     tension = 1                # warp over weft: the one that is pulled more lies straighter
///     material = "polyester"     # silk, cellulose; or refractive_index = 1.6
///     lustre = "semi-dull"       # bright, dull; or micrometres from one scattering to the next
///     transmission = [0, 0, 0]   # of a diameter of the dyed filament: red, green, blue

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/lab/draft.h"
#include "tsuya/lab/filaments.h"
#include "tsuya/lab/refractive_index.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::lab {

/// One yarn system, warp or weft. The section of a yarn by itself is a race-track: a rectangle
/// between two half circles, `width` across and `width * flattening` thick. In the cloth, yarns
/// that are wider than their spacing press each other flat: each is as wide as the spacing, thicker
/// by as much as its filaments need then, and its sides lie against its neighbours.
struct Yarn {
    double per_cm = 40;                               ///< ends or picks, 1 to 500
    double width = 0.2e-3;                            ///< metres, at most kMostPressed spacings
    double flattening = 0.3;                          ///< thickness / width, 0.02 to 1
    int filaments = 36;                               ///< 1 to 500
    FilamentSection section = FilamentSection::round; ///< of a filament
    double corner_rounding = 0.3;                     ///< 0 sharp to 1 round; not of a round one
    double twist_per_m = 0;                           ///< turns; > 0 is Z, < 0 is S; up to 4000
    /// Pull on a yarn while the cloth is woven and finished, 0.01 to 100. Only the ratio of warp to
    /// weft matters: the system that is pulled more lies straighter, and the other takes the crimp
    /// (crimp interchange, [Peirce]).
    double tension = 1;
    FiberMaterial material = FiberMaterial::polyester;
    std::optional<double> refractive_index{}; ///< instead of the material's; 1 to 3
    double surface_roughness = 0.08; ///< standard deviation of a filament's slope, radians, 0 to 1
    /// Share of the light that comes through a diameter of a filament, in red (610 nm), green
    /// (550 nm) and blue (465 nm), each 0 to 1: the dye. 0 is black.
    std::array<double, 3> transmission{0, 0, 0};

    /// Mean way of light within a filament between two particles of delustrant, metres; 0: none.
    double scattering_length = 0;

    double spacing() const { return 0.01 / per_cm; } ///< metres between the axes
    /// Height of the section, metres
    double thickness() const { return width * flattening; }
};

/// How many times as wide as their spacing yarns may be.
inline constexpr double kMostPressed = 2;

/// A woven cloth: how its yarns cross, and the yarns.
struct Weave {
    std::string name{};
    Draft draft = plain_weave();
    Yarn warp{}, weft{};
};

/// `black polyester satin`, `silk charmeuse`, `polyester taffeta`, `silk habotai`, `twill lining`,
/// `shot silk`.
std::vector<std::string> weave_names();
/// A preset. Throws Error naming `where` with the names that would be accepted.
Weave weave(std::string_view name, const std::string &where = "weave");

/// Reads a weave. TOML is as above; what it leaves out comes from its preset, else from
/// `polyester taffeta`. A `.wif` file gives the draft, on the yarns of `polyester taffeta`: a
/// spacing in the file scales them, and colours become the transmission of their system, the mean
/// of the decoded sRGB of its threads (a filament as bright as the colour; there is one dye a
/// system). Throws Error with file:line:column; problems of a draft as a whole name the file.
Weave read_weave(const std::filesystem::path &file);

/// Throws Error naming `where` and the member: a number out of its range, yarns wider than twice
/// their spacing, or a draft that does not hold (check_draft).
void check_weave(const Weave &weave, const std::string &where);

/// What the reflectance of the cloth may claim: orthotropic if the draft is its own mirror image
/// both ways and no yarn is twisted (a mirror turns Z twist into S), half_turn if the draft is
/// itself after half a turn, else none. Twills and most satins have diagonals and are half_turn.
Symmetry symmetry_of(const Weave &weave);

/// Transmission of the dye at a wavelength, linear between the three bands and constant beyond.
double transmission(const Yarn &yarn, double wavelength_nm);
/// The scattering length in metres of a lustre by name: `bright` (no delustrant), `semi-dull`,
/// `dull`. Throws Error naming `where` with the names that would be accepted.
double scattering_length(std::string_view lustre, const std::string &where = "lustre");

/// Optics of the filaments of a yarn at a wavelength.
FilamentOptics optics(const Yarn &yarn, double wavelength_nm);

} // namespace tsuya::lab
