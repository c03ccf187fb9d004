#pragma once
/// \file
/// Files of spectra, as instruments, spreadsheets and people write them.
///
/// | ending | is |
/// |---|---|
/// | `.csv`, `.txt`, `.tsv` | rows of wavelength and values, or rows of samples; CGATS |
/// | `.spdx` | TM-27 of the IES |
/// | `.cxf` | Colour Exchange Format 3 |
/// | `.ti3`, `.sp`, `.cgats` | CGATS tables, also of Argyll |
/// | `.qtx`, `.mif` | samples of Datacolor; of X-Rite's Ink Master |
///
/// Endings and names have any case. Text is decoded by TextDecoder, so it may be UTF-16. Fields are
/// parted by `;`, tab, `,` or blanks and may be quoted; decimals follow a point or a comma.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// What values are, where the file says so.
enum class SpectralQuantity { unknown, power, reflectance, transmittance };

/// One spectrum of a file: a column, a row, or an object.
struct SpectrumSample {
    std::string name{};               ///< of the column or the sample
    Spectrum spectrum{{}, {}};        ///< wavelengths in nm, in rising order
    std::vector<std::string> where{}; ///< place of each value, for messages
    SpectralQuantity quantity = SpectralQuantity::unknown;
    bool percent = false; ///< the file says that values are percent
    bool in_row = false;  ///< a row of samples below a line of wavelengths, as charts have them
};

/// What a file holds, as it stands there: no value is judged.
struct SpectrumFile {
    std::vector<SpectrumSample> samples{}; ///< at least one, in the order of the file
};

/// Reads all spectra of a file; its ending says how. In text, lines that begin with `#`, a preamble
/// and lines after the values are skipped; header lines before the values name columns. The column
/// of wavelengths is the one whose name says so (`wavelength`, `nm`, `lambda`, `Wellenlänge`), else
/// the first; a header may say that they are in micrometres or angstrom. Wavelengths rise or fall.
/// Throws Error with up to 20 problems at `file:line:column`, or one at `file` where it cannot be
/// read or holds no spectrum.
SpectrumFile read_spectrum_file(const std::filesystem::path &path);

/// The sample of that name, in any case. Without a name, the only one. Throws Error at `where` for
/// an unknown name, or several samples without one, with the names.
const SpectrumSample &find_sample(const SpectrumFile &file, const std::string &name,
                                  const std::string &where);

/// A file as programs name it: `PATH`, or `PATH:SAMPLE` for one of several spectra.
struct SpectrumFileSpec {
    std::filesystem::path path{};
    std::string sample{};
};

/// Nothing for a text that does not name a file of spectra by its ending.
std::optional<SpectrumFileSpec> parse_spectrum_file_spec(std::string_view text);

/// `.csv, .txt, ...`: the endings that read_spectrum_file knows, for messages.
std::string spectrum_file_endings();

/// Writes a spectrum so that read_spectrum_file gives the same numbers. `comment` becomes `#`
/// lines. Throws Error if the file cannot be written.
void write_spectrum_csv(const std::filesystem::path &path, const Spectrum &spectrum,
                        const std::string &comment = {});

} // namespace tsuya
