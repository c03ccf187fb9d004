#pragma once
/// \file
/// Reads TABLE.csv, as rigs, spreadsheets and people write it.
///
///     const ReflectanceFile file = read_reflectance_file("crimson_satin.csv");
///     for (const TableChannel &channel : file.channels)
///         std::cout << channel.name << " " << channel.table.rows.size() << "\n";
///
/// The file has comment lines `# key: value`, a header line and rows. Columns are found by their
/// names, in any order and spelling of case and blanks:
///
/// | column | is |
/// |---|---|
/// | `theta_i_deg`, `phi_i_deg` | direction of the light; `theta_i_rad` where it is in radians |
/// | `theta_r_deg`, `phi_r_deg` | direction of the view |
/// | `brdf_per_sr` | the value, or in its place channels: |
/// | `brdf_r`, `brdf_g`, `brdf_b` | linear Rec. 709 values |
/// | `brdf_550nm` and others | values at wavelengths |
/// | `sigma_per_sr`, `sigma_r`, `sigma_550nm` | standard error; may be missing |
///
/// Other columns are left out. The header line says by which of `;`, tab, `,` and blanks columns
/// are parted. Decimals may follow a comma where columns are parted otherwise, or in quotes. Bytes
/// are decoded by TextDecoder.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// One column of values with the directions, keys and symmetry of the file.
struct TableChannel {
    std::string name{}; ///< `r`, `g`, `b` or such as `550nm`; empty for `brdf_per_sr`
    std::optional<double> wavelength_nm{}; ///< that the name states
    ReflectanceTable table{};
};

/// What a file holds.
struct ReflectanceFile {
    std::vector<TableChannel> channels{}; ///< one, or several with the same directions
    /// What was mended or left out while reading, a sentence each without full stop.
    std::vector<std::string> warnings{};
};

/// Reads TABLE.csv. Values below 0 that are noise count as 0, with a warning: by up to 5 standard
/// errors; where there is none, by up to 10 % of the largest value in up to a quarter of the rows.
/// Values below 1e-30 count as 0. Throws Error with file:line:column of up to 20 problems: columns
/// that are missing, given twice or without a unit, not a number, NaN, a value below 0, angles
/// outside [0, 90] from the normal or [-360, 360] from the weft, angles in radians under the name
/// of degrees, no row, an unknown symmetry; as read_text.
ReflectanceFile read_reflectance_file(const std::filesystem::path &file);

/// The same for text that was decoded. \param name of the file, for errors
ReflectanceFile parse_reflectance_file(std::string_view text, const std::string &name);

/// Throws Error naming `where` for a file with several channels.
void check_single_channel(const ReflectanceFile &file, const std::string &where);

/// The table of a file that has one column of values. Throws Error as read_reflectance_file, and
/// for a file with channels.
ReflectanceTable read_reflectance_table(const std::filesystem::path &file);

} // namespace tsuya
