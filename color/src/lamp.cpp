#include "tsuya/color/lamp.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

#include "planck.h"
#include "tables.h"
#include "tsuya/color/color_temperature.h"
#include "tsuya/color/measured_spectrum.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr const char *kIncandescent = "incandescent, 2856 K";
constexpr const char *kEqualEnergy = "equal energy at every wavelength";

// [CIE015] section 4.1.2, Eq. 4.1: 2848 K with c2 = 1.435e-2 m K as the CIE defined it in 1931,
// which is 2856 K on today's temperature scale; 100 at 560 nm.
Spectrum illuminant_a() { return planck_spectrum(1.435e7 / 2848.0); }

const tables::LampTable *find_table(std::string_view name) {
    const auto *found = std::find_if(std::begin(tables::kLamps), std::end(tables::kLamps),
                                     [&](const auto &table) { return name == table.name; });
    return found == std::end(tables::kLamps) ? nullptr : found;
}

[[noreturn]] void throw_unknown(std::string_view name) {
    throw Error({"there is no lamp '" + std::string(name) + "'", "lamp",
                 accepted_names(name, lamp_names()) + "; or a file that ends in " +
                     spectrum_file_endings()});
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
    if (!parse_spectrum_file_spec(spec))
        lamp_description(spec);
}

NamedLamp find_lamp(const std::string &spec, const std::filesystem::path &folder,
                    const std::string &sample) {
    const std::optional<SpectrumFileSpec> file = parse_spectrum_file_spec(spec);
    if (!file)
        return {
            .name = spec, .spectrum = lamp(spec), .caption = spec + ": " + lamp_description(spec)};
    MeasuredSpectrum read =
        read_lamp_file(folder / file->path, file->sample.empty() ? sample : file->sample);
    std::string caption = std::filesystem::path(spec).filename().string();
    if (const auto t = color_temperature(chromaticity(white_of(read.spectrum))))
        caption += ": " + std::to_string(std::lround(t->kelvin)) + " K";
    return {.name = spec,
            .spectrum = std::move(read.spectrum),
            .caption = std::move(caption),
            .warnings = std::move(read.warnings)};
}

Spectrum parse_lamp(const std::string &spec, const std::filesystem::path &folder) {
    return find_lamp(spec, folder).spectrum;
}

} // namespace tsuya
