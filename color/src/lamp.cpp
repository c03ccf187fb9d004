#include "tsuya/color/lamp.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tables.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr const char *kIncandescent = "incandescent, 2856 K";
constexpr const char *kEqualEnergy = "equal energy at every wavelength";

// [CIE015] section 4.1.2, Eq. 4.1: 2848 K with c2 = 1.435e-2 m K as the CIE defined it in 1931,
// which is 2856 K on today's temperature scale; 100 at 560 nm.
Spectrum illuminant_a() {
    constexpr double kC2OverTNm = 1.435e7 / 2848.0;
    Spectrum s{{}, {}};
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        s.wavelength_nm.push_back(nm);
        s.value.push_back(100.0 * std::pow(560.0 / nm, 5) * std::expm1(kC2OverTNm / 560.0) /
                          std::expm1(kC2OverTNm / nm));
    }
    return s;
}

const tables::LampTable *find_table(std::string_view name) {
    const auto *found = std::find_if(std::begin(tables::kLamps), std::end(tables::kLamps),
                                     [&](const auto &table) { return name == table.name; });
    return found == std::end(tables::kLamps) ? nullptr : found;
}

[[noreturn]] void throw_unknown(std::string_view name) {
    throw Error({"there is no lamp '" + std::string(name) + "'", "lamp",
                 accepted_names(name, lamp_names()) + "; or a file that ends in .csv"});
}

} // namespace

std::vector<std::string> lamp_names() {
    std::vector<std::string> names{"A", "E"};
    for (const auto &table : tables::kLamps)
        names.emplace_back(table.name);
    std::sort(names.begin(), names.end());
    return names;
}

Spectrum lamp(std::string_view name) {
    if (name == "A")
        return illuminant_a();
    if (name == "E")
        return Spectrum::constant(100.0);
    const tables::LampTable *table = find_table(name);
    if (!table)
        throw_unknown(name);
    Spectrum s{{}, {std::begin(table->value), std::end(table->value)}};
    for (int i = 0; i < tables::kLampSamples; ++i)
        s.wavelength_nm.push_back(tables::kLampFirstNm + tables::kLampStepNm * i);
    return s;
}

std::string lamp_description(std::string_view name) {
    if (name == "A")
        return kIncandescent;
    if (name == "E")
        return kEqualEnergy;
    const tables::LampTable *table = find_table(name);
    if (!table)
        throw_unknown(name);
    return table->description;
}

void check_lamp_spec(const std::string &spec) {
    if (std::filesystem::path(spec).extension() != ".csv")
        lamp_description(spec);
}

Spectrum parse_lamp(const std::string &spec, const std::filesystem::path &folder) {
    const std::filesystem::path path = folder / spec;
    if (path.extension() != ".csv")
        return lamp(spec);
    Spectrum s = read_spectrum_csv(path);
    const bool visible = [&] {
        for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
            if (s.at(nm) > 0 && color_matching(Observer::cie1931, nm).y > 0)
                return true;
        return false;
    }();
    if (!visible)
        throw Error({"the lamp has no visible power", path.string(),
                     "expected positive power between 360 and 830 nm"});
    return s;
}

} // namespace tsuya
