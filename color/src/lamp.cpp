#include "tsuya/color/lamp.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "daylight.h"
#include "lower_case.h"
#include "planck.h"
#include "tables.h"
#include "tsuya/color/color_temperature.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

struct Alias {
    const char *name, *lamp;
};
constexpr std::array kAliases{
    Alias{"CWF", "FL2"},  Alias{"TL84", "FL11"}, Alias{"TL83", "FL12"},
    Alias{"U30", "FL12"}, Alias{"TL85", "FL10"}, Alias{"Horizon", "2300K"},
};

// [CIE015] section 4.1.2, Eq. 4.1: 2848 K with c2 = 1.435e-2 m K as the CIE defined it in 1931,
// which is 2856 K on today's temperature scale; 100 at 560 nm.
Spectrum illuminant_a() { return planck_spectrum(1.435e7 / 2848.0); }

const tables::LampTable *find_table(std::string_view name) {
    const std::string wanted = lower_case(name);
    const auto *found =
        std::find_if(std::begin(tables::kLamps), std::end(tables::kLamps),
                     [&](const auto &table) { return wanted == lower_case(table.name); });
    return found == std::end(tables::kLamps) ? nullptr : found;
}

/// A number between a text that begins and one that ends a name, in any case.
std::optional<double> number_in(std::string_view name, std::string_view begin,
                                std::string_view end) {
    const std::string text = lower_case(name);
    if (text.size() <= begin.size() + end.size() || !text.starts_with(begin) ||
        !text.ends_with(end))
        return std::nullopt;
    const char *const from = text.data() + begin.size(), *const to =
                                                             text.data() + text.size() - end.size();
    double value = 0;
    const auto [at, code] = std::from_chars(from, to, value, std::chars_format::fixed);
    return code == std::errc{} && at == to ? std::optional(value) : std::nullopt;
}

void check_kelvin(double kelvin, double low, double high, std::string_view name) {
    if (!(kelvin >= low && kelvin <= high))
        throw Error({"the lamp '" + std::string(name) + "' has " +
                         std::to_string(std::lround(std::clamp(kelvin, -1e9, 1e9))) + " K",
                     "lamp",
                     "expected " + std::to_string(std::lround(low)) + " to " +
                         std::to_string(std::lround(high)) + " K"});
}

std::string kelvin_text(double kelvin) { return std::to_string(std::lround(kelvin)) + " K"; }

/// Temperature of `D55`, a multiple of 5 or the D93 of displays, in hundreds of kelvin with c2 =
/// 0.014380 m K as the CIE names daylight
/// ([CIE015] section 4.1.3), or of `D5500`, in kelvin of today.
std::optional<double> daylight_kelvin(std::string_view name) {
    constexpr double kCoolest = 4000, kHottest = 25'000, kLargestHundreds = 999, kDisplay = 93;
    const std::optional<double> number = number_in(name, "d", "");
    if (!number ||
        (*number <= kLargestHundreds && std::fmod(*number, 5) != 0 && *number != kDisplay))
        return std::nullopt;
    const double kelvin = *number > kLargestHundreds ? *number : *number * 100 * (1.4388 / 1.4380);
    check_kelvin(kelvin, kCoolest, kHottest, name);
    return kelvin;
}

std::optional<double> black_body_kelvin(std::string_view name) {
    const std::optional<double> kelvin = number_in(name, "", "k");
    constexpr double kCoolest = 500, kHottest = 100'000;
    if (kelvin)
        check_kelvin(*kelvin, kCoolest, kHottest, name);
    return kelvin;
}

/// The name in `lamp_names()` that an alias or another case stands for, else the text itself.
std::string canonical(std::string_view name) {
    const std::string wanted = lower_case(name);
    for (const Alias &alias : kAliases)
        if (wanted == lower_case(alias.name))
            return alias.lamp;
    for (const char *other : {"A", "E", "D55", "D75"})
        if (wanted == lower_case(other))
            return other;
    if (const tables::LampTable *table = find_table(name))
        return table->name;
    if (wanted.starts_with('f'))
        if (const tables::LampTable *table = find_table("FL" + std::string(name.substr(1))))
            return table->name;
    return std::string(name);
}

[[noreturn]] void throw_unknown(std::string_view name) {
    std::vector<std::string> known = lamp_names();
    for (const Alias &alias : kAliases)
        known.emplace_back(alias.name);
    throw Error({"there is no lamp '" + std::string(name) + "'", "lamp",
                 accepted_names(name, known) + "; D6500, 3200K; or a file that ends in " +
                     spectrum_file_endings()});
}

} // namespace

std::vector<std::string> lamp_names() {
    std::vector<std::string> names{"A", "E", "D55", "D75"};
    for (const auto &table : tables::kLamps)
        names.emplace_back(table.name);
    // FL2 before FL10
    std::sort(names.begin(), names.end(), [](const std::string &a, const std::string &b) {
        const auto number = [](const std::string &name) {
            return name.starts_with("FL") ? std::stoi(name.substr(2)) : 0;
        };
        return number(a) != 0 && number(b) != 0 ? number(a) < number(b) : a < b;
    });
    return names;
}

std::vector<LampAlias> lamp_aliases() {
    std::vector<LampAlias> all;
    for (const Alias &alias : kAliases)
        all.push_back({alias.name, alias.lamp});
    return all;
}

std::vector<LampSet> lamp_sets() {
    return {{"lightbox-europe", {"D65", "TL84", "A"}},
            {"lightbox-usa", {"D65", "CWF", "U30", "A"}},
            {"lightbox-all", {"D65", "D50", "TL84", "CWF", "U30", "A", "Horizon"}}};
}

std::vector<std::string> expand_lamp_sets(std::span<const std::string> specs) {
    std::vector<std::string> all;
    for (const std::string &spec : specs) {
        const std::vector<LampSet> sets = lamp_sets();
        const auto set = std::ranges::find(sets, lower_case(spec), &LampSet::name);
        if (set == sets.end())
            all.push_back(spec);
        else
            all.insert(all.end(), set->lamps.begin(), set->lamps.end());
    }
    return all;
}

Spectrum lamp(std::string_view name) {
    const std::string known = canonical(name);
    if (known == "A")
        return illuminant_a();
    if (known == "E")
        return Spectrum::constant(100.0);
    if (const tables::LampTable *table = find_table(known)) {
        Spectrum s{{}, {std::begin(table->value), std::end(table->value)}};
        for (int i = 0; i < tables::kLampSamples; ++i)
            s.wavelength_nm.push_back(tables::kLampFirstNm + tables::kLampStepNm * i);
        return s;
    }
    if (const auto kelvin = daylight_kelvin(known))
        return daylight(*kelvin);
    if (const auto kelvin = black_body_kelvin(known))
        return black_body(*kelvin);
    throw_unknown(name);
}

std::string lamp_description(std::string_view name) {
    const std::string known = canonical(name);
    const bool renamed = lower_case(known) != lower_case(name);
    if (known == "A")
        return "incandescent, 2856 K";
    if (known == "E")
        return "equal energy at every wavelength";
    if (const tables::LampTable *table = find_table(known))
        return table->description + (renamed ? ", as " + known : std::string());
    if (const auto kelvin = daylight_kelvin(known))
        return "daylight, " + kelvin_text(*kelvin);
    if (const auto kelvin = black_body_kelvin(known))
        return "black body, " + kelvin_text(*kelvin);
    throw_unknown(name);
}

} // namespace tsuya
