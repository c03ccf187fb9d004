#pragma once
/// \file
/// Lamps by name, and lamps of one's own. A lamp is relative spectral power, in any unit.
///
/// | spec | is |
/// |---|---|
/// | `D65`, `FL11`, `LED-B3` | a name of `lamp_names()`, in any case |
/// | `TL84`, `CWF`, `F11` | a name of the trade, see `lamp_aliases()` |
/// | `D55`, `D93`, `D6500` | daylight of 4000 to 25 000 K |
/// | `3200K` | a black body of 500 to 100 000 K |
/// | `shop.csv`, `lamps.csv:warm` | a file of spectra |
/// | `0.7*A+0.3*D65` | a mixture; factors are shares of luminous power |
/// | `0.5*A`, `A*0.5`, `500lx*A` | a lamp with a factor; 1000 lx is the factor 1 |
///
/// `D6500` is in kelvin; two or three digits, multiples of 5 or 93, are hundreds of kelvin on the
/// scale of 1968, by which the CIE names daylight.

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// The lamps that have tables or formulas of their own: A, C, D50, D55, D65, D75, E, FL1 to FL12,
/// HP1 to HP5, LED-B1 to LED-B5, LED-BH1, LED-RGB1, LED-V1, LED-V2, MH-NIST.
std::vector<std::string> lamp_names();

/// Another name of a lamp.
struct LampAlias {
    std::string name{}; ///< as the trade has it: TL84
    std::string lamp{}; ///< a spec of the lamp that it stands for: FL11
};

/// Names of the trade; F1 to F12 are FL1 to FL12 besides. The tables of the CIE are typical lamps
/// of their kind, and those of one maker differ.
std::vector<LampAlias> lamp_aliases();

/// The lamps of a kind of light booth.
struct LampSet {
    std::string name{};
    std::vector<std::string> lamps{};
};

/// Sets that stand for several lamps where several are named: `lightbox-europe`, `lightbox-usa`,
/// `lightbox-all`. The choice is ours, of what booths for textiles commonly have.
std::vector<LampSet> lamp_sets();

/// The specs with each name of a set replaced by its lamps; names of sets have any case.
std::vector<std::string> expand_lamp_sets(std::span<const std::string> specs);

/// Relative spectral power of a lamp that a single name stands for: one of `lamp_names()` or
/// `lamp_aliases()`, daylight or a black body. A is Planck's formula at 1 nm from 360 to 830 nm, E
/// is constant, D55 and D75 are formulas; the others are tables at 5 nm from 380 to 780 nm, linear
/// between the samples and, as [CIE015] section 7.2.2.1 advises, constant beyond the last (which
/// holds 0.1 % of Y at most). Throws Error for an unknown name, with the known ones and the
/// nearest, and for a temperature out of range.
Spectrum lamp(std::string_view name);

/// One line about a named lamp: kind and correlated colour temperature. Throws Error as `lamp`.
std::string lamp_description(std::string_view name);

/// A lamp with the name that it has in reports.
struct NamedLamp {
    std::string name{};
    Spectrum spectrum{};
    std::string caption{}; ///< what to write under a picture: `D65: daylight, 6504 K`
    /// What was mended or looks odd in its file, a sentence each.
    std::vector<std::string> warnings{};
    double factor = 1; ///< luminous power beside that of a lamp without a factor, >= 0
};

/// A lamp as programs name it, in one of the forms above. Files are relative to `folder`; one that
/// does not name one of several spectra has that of `sample`. The caption of a file or mixture is
/// its name and its correlated colour temperature. Throws Error as `lamp` and read_lamp_file, and
/// for a factor that is no number of 0 or more.
NamedLamp find_lamp(const std::string &spec, const std::filesystem::path &folder = {},
                    const std::string &sample = {});

/// The spectrum of find_lamp.
Spectrum parse_lamp(const std::string &spec, const std::filesystem::path &folder = {});

/// Throws Error for a text that find_lamp refuses whatever files there are.
void check_lamp_spec(const std::string &spec);

} // namespace tsuya
