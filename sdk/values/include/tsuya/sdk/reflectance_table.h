#pragma once
/// \file
/// The measured or simulated reflectance of a fabric: what the lab makes and a fabric is fitted to.

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"

namespace tsuya {

/// How views may be mirrored about the yarn axes.
enum class Symmetry {
    none,
    half_turn,   ///< rho(theta, phi) = rho(theta, phi + pi): twisted yarn
    orthotropic, ///< also rho(theta, phi) = rho(theta, -phi): two orthogonal axes
};

/// As in files: `half-turn`.
const char *name_of(Symmetry symmetry);

/// The names of all symmetries, in the order of their values.
std::vector<std::string> symmetry_names();

/// The symmetry of a name as in files, or nothing for another name.
std::optional<Symmetry> symmetry_named(std::string_view name);

/// Light as near as this to the normal, in radians, counts as light from straight above.
inline constexpr double kNormalLight = 0.5001 * kDegree;

/// One measured pair of directions. Angles in radians; phi from the weft axis.
struct ReflectanceRow {
    double theta_i = 0, phi_i = 0;
    double theta_r = 0, phi_r = 0;
    double brdf_per_sr = 0;  ///< without the cosine, >= 0
    double sigma_per_sr = 0; ///< standard error; 0 where unknown

    /// The light counts as light from straight above.
    bool from_above() const { return theta_i <= kNormalLight; }
    /// Unit, z >= 0; the normal where the light is from above.
    glm::dvec3 to_light() const {
        return from_above() ? glm::dvec3(0, 0, 1) : direction_of(theta_i, phi_i);
    }
    /// Unit, z >= 0.
    glm::dvec3 to_viewer() const { return direction_of(theta_r, phi_r); }
    bool operator==(const ReflectanceRow &) const = default;
};

/// Rows in any order, with the comment keys of the file (`instrument`, `date`, `provenance`...).
struct ReflectanceTable {
    std::map<std::string, std::string> keys{}; ///< every `# key: value` but symmetry
    Symmetry symmetry = Symmetry::orthotropic;
    bool symmetry_declared = true; ///< false: the file says nothing, and orthotropic is assumed
    std::vector<ReflectanceRow> rows{};

    /// A row has a standard error.
    bool has_sigma() const;
    /// The rows with light from straight above, within half a degree.
    ReflectanceTable normal_incidence() const;
    bool operator==(const ReflectanceTable &) const = default;
};

/// Whole numbers, the light's before the view's, that are equal where two rows have the same
/// directions; the azimuth of a light or view along the normal does not count.
std::array<long long, 4> direction_key(const ReflectanceRow &row);

/// Throws Error naming `where`, with up to 20 problems: a value or angle that is not a finite
/// number, a value below 0, an angle from the normal outside 0 to 90 degrees; rows of one pair of
/// directions that differ by more than a factor of 2 and more than their standard errors allow.
void check_table(const ReflectanceTable &table, const std::string &where);

/// The symmetry that a table which declares none may have forgotten: `orthotropic` where its light
/// comes from one quadrant about the normal, `half_turn` where from less than half of all azimuths.
/// Empty for light from straight above alone, from further round, and for tables that declare one.
std::optional<Symmetry> likely_symmetry(const ReflectanceTable &table);

/// Writes TABLE.csv through a temporary file. Throws Error where the file cannot be written.
void write_reflectance_table(const ReflectanceTable &table, const std::filesystem::path &file);

} // namespace tsuya
