#pragma once
/// \file
/// How much of a dyed cloth's coloured part has lost its direction.

#include <array>
#include <string>
#include <string_view>

namespace tsuya {

/// Delustrant in the filaments: none, about 0.3 % and about 2 % of titanium dioxide.
enum class Lustre { bright, semi_dull, dull };

/// In the order of Lustre.
inline constexpr std::array<std::string_view, 3> kLustreNames = {"bright", "semi-dull", "dull"};

/// The lustre of that name. Throws Error naming `where`, with the nearest name.
Lustre lustre_named(const std::string &name, const std::string &where);

/// Share of the coloured part that is Lambertian, 0 to 1; the rest follows the yarns, see body.h.
/// Dark cloth shows light of one passage through filaments and has more direction; pale cloth that
/// of many. Fitted to traced dyed satin and taffeta, see sdk/docs/REFLECTANCE_STUDY.md.
/// \param reflectance of the coloured part at one wavelength, 0 to 1
double delustre_of(Lustre lustre, double reflectance);

} // namespace tsuya
