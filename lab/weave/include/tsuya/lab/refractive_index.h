#pragma once
/// \file
/// Refractive index of what filaments are made of, against wavelength.

#include <string>
#include <string_view>
#include <vector>

namespace tsuya::lab {

/// What a filament is made of.
enum class FiberMaterial {
    polyester, ///< PET, isotropic: [Zhang2020], 400 to 780 nm
    silk,      ///< fibroin, regenerated film: [Perotto2017], 380 to 780 nm
    cellulose  ///< viscose, acetate, cotton: 1.470 at 589 nm, taken for all wavelengths
};

/// `polyester`, `silk`, `cellulose`.
std::vector<std::string> fiber_materials();
/// The name that parse_fiber_material reads.
std::string name_of(FiberMaterial material);
/// Throws Error naming `where` with the names that would be accepted.
FiberMaterial parse_fiber_material(std::string_view name, const std::string &where = "material");

/// Real part of the refractive index, linear between the rows of its table.
/// \param wavelength_nm 380 to 780; beyond the ends of a table its last value holds
/// Throws Error outside that range.
double refractive_index(FiberMaterial material, double wavelength_nm);

} // namespace tsuya::lab
