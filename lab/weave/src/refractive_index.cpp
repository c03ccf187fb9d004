#include "tsuya/lab/refractive_index.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kStep_nm = 10;

// [Zhang2020], real part, every 10 nm from 400 nm; from refractiveindex.info (CC0).
constexpr double kPolyester[] = {
    1.61027, 1.60595, 1.60212, 1.59847, 1.59528, 1.59247, 1.58988, 1.58716, 1.58496, 1.58304,
    1.58111, 1.57927, 1.57769, 1.57630, 1.57470, 1.57333, 1.57194, 1.57086, 1.56993, 1.56904,
    1.56811, 1.56696, 1.56627, 1.56527, 1.56478, 1.56368, 1.56317, 1.56225, 1.56199, 1.56131,
    1.56052, 1.56013, 1.55933, 1.55868, 1.55854, 1.55817, 1.55795, 1.55723, 1.55583};
// [Perotto2017], real part, every 10 nm from 380 nm; from refractiveindex.info (CC0).
constexpr double kSilk[] = {1.58052, 1.57847, 1.57662, 1.57496, 1.57345, 1.57208, 1.57083,
                            1.56969, 1.56865, 1.56769, 1.56681, 1.56599, 1.56524, 1.56454,
                            1.56390, 1.56330, 1.56274, 1.56222, 1.56173, 1.56128, 1.56085,
                            1.56045, 1.56007, 1.55972, 1.55939, 1.55907, 1.55878, 1.55850,
                            1.55823, 1.55798, 1.55775, 1.55752, 1.55731, 1.55710, 1.55691,
                            1.55672, 1.55655, 1.55638, 1.55622, 1.55607, 1.55592};
// [Sultanova], cellulose at the sodium D line.
constexpr double kCellulose = 1.470;

double interpolate(std::span<const double> table, double first_nm, double wavelength_nm) {
    const double last = static_cast<double>(table.size() - 1);
    const double at = std::clamp((wavelength_nm - first_nm) / kStep_nm, 0.0, last);
    const double row = std::min(std::floor(at), last - 1);
    const std::size_t i = static_cast<std::size_t>(row);
    return std::lerp(table[i], table[i + 1], at - row);
}

} // namespace

std::vector<std::string> fiber_materials() { return {"polyester", "silk", "cellulose"}; }

std::string name_of(FiberMaterial material) {
    return fiber_materials()[static_cast<std::size_t>(material)];
}

FiberMaterial parse_fiber_material(std::string_view name, const std::string &where) {
    const std::vector<std::string> names = fiber_materials();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw Error(
            {"unknown material \"" + std::string(name) + "\"", where, accepted_names(name, names)});
    return static_cast<FiberMaterial>(found - names.begin());
}

double refractive_index(FiberMaterial material, double wavelength_nm) {
    if (!(wavelength_nm >= 380 && wavelength_nm <= 780))
        throw Error({"no refractive index at " + std::to_string(wavelength_nm) + " nm",
                     "wavelength", "expected 380 to 780 nm"});
    switch (material) {
    case FiberMaterial::polyester:
        return interpolate(kPolyester, 400, wavelength_nm);
    case FiberMaterial::silk:
        return interpolate(kSilk, 380, wavelength_nm);
    case FiberMaterial::cellulose:
        break;
    }
    return kCellulose;
}

} // namespace tsuya::lab
