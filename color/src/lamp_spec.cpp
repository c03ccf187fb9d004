// Lamps as programs name them: names, files, mixtures, factors.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "lower_case.h"
#include "tsuya/color/color_temperature.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/measured_spectrum.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr double kLuxOfOne = 1000; // that are the factor 1

/// A lamp of a mixture.
struct Term {
    double factor = 1;
    std::string lamp{};
};

std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(' ');
    return first == text.npos
               ? std::string()
               : std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

/// `0.5` or `500lx`; nothing for a text that is no number.
std::optional<double> factor_of(const std::string &text) {
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    const std::string unit =
        lower_case({end, static_cast<std::size_t>(text.data() + text.size() - end)});
    if (code != std::errc{} || (!unit.empty() && unit != "lx"))
        return std::nullopt;
    return unit.empty() ? value : value / kLuxOfOne;
}

Term parse_term(const std::string &text) {
    const std::size_t star = text.find('*');
    if (star == text.npos)
        return {.lamp = text};
    std::string first = trimmed(text.substr(0, star)), second = trimmed(text.substr(star + 1));
    std::optional<double> factor = factor_of(first);
    if (!factor) {
        factor = factor_of(second);
        std::swap(first, second);
    }
    if (!factor || !(*factor >= 0) || std::isinf(*factor))
        throw Error({"'" + text + "' has no factor", "lamp",
                     "expected such as 0.5*A or 500lx*A, with a factor of 0 or more"});
    return {*factor, second};
}

bool is_lamp(const std::string &text) {
    if (parse_spectrum_file_spec(text))
        return true;
    try {
        lamp_description(text);
        return true;
    } catch (const Error &) {
        return false;
    }
}

/// A '+' in the name of a file parts nothing.
std::vector<Term> parse_terms(const std::string &spec) {
    std::vector<Term> terms;
    for (std::size_t begin = 0; begin <= spec.size();) {
        const std::size_t end = std::min(spec.find('+', begin), spec.size());
        terms.push_back(parse_term(trimmed(std::string_view(spec).substr(begin, end - begin))));
        begin = end + 1;
    }
    const bool all_known =
        std::ranges::all_of(terms, [](const Term &t) { return is_lamp(t.lamp); });
    if (!all_known && parse_spectrum_file_spec(spec))
        return {parse_term(spec)};
    return terms;
}

NamedLamp find_single(const std::string &spec, const std::filesystem::path &folder,
                      const std::string &sample) {
    const std::optional<SpectrumFileSpec> file = parse_spectrum_file_spec(spec);
    if (!file)
        return {
            .name = spec, .spectrum = lamp(spec), .caption = spec + ": " + lamp_description(spec)};
    MeasuredSpectrum read =
        read_lamp_file(folder / file->path, file->sample.empty() ? sample : file->sample);
    NamedLamp found{.name = spec,
                    .spectrum = std::move(read.spectrum),
                    .caption = file->path.filename().string(),
                    .warnings = std::move(read.warnings)};
    if (!file->sample.empty())
        found.caption += ":" + file->sample;
    return found;
}

/// Each lamp by its share of luminous power, on the samples of all.
Spectrum mix(const std::vector<Term> &terms, const std::vector<NamedLamp> &lamps) {
    Spectrum mixture{{}, {}};
    for (const NamedLamp &one : lamps)
        mixture.wavelength_nm.insert(mixture.wavelength_nm.end(),
                                     one.spectrum.wavelength_nm.begin(),
                                     one.spectrum.wavelength_nm.end());
    std::ranges::sort(mixture.wavelength_nm);
    const auto repeated = std::ranges::unique(mixture.wavelength_nm);
    mixture.wavelength_nm.erase(repeated.begin(), repeated.end());
    mixture.value.resize(mixture.wavelength_nm.size());
    for (std::size_t i = 0; i < lamps.size(); ++i) {
        const double scale = terms[i].factor / luminous_power(lamps[i].spectrum);
        for (std::size_t k = 0; k < mixture.value.size(); ++k)
            mixture.value[k] += scale * lamps[i].spectrum.at(mixture.wavelength_nm[k]);
    }
    return mixture;
}

std::string kelvin_of(const Spectrum &spectrum) {
    const auto temperature = color_temperature(chromaticity(white_of(spectrum)));
    return temperature ? ": " + std::to_string(std::lround(temperature->kelvin)) + " K"
                       : std::string();
}

} // namespace

void check_lamp_spec(const std::string &spec) {
    for (const Term &term : parse_terms(spec))
        if (!parse_spectrum_file_spec(term.lamp))
            lamp_description(term.lamp);
}

NamedLamp find_lamp(const std::string &spec, const std::filesystem::path &folder,
                    const std::string &sample) {
    const std::vector<Term> terms = parse_terms(spec);
    std::vector<NamedLamp> lamps;
    NamedLamp found{.name = spec, .factor = 0};
    for (const Term &term : terms) {
        lamps.push_back(find_single(term.lamp, folder, sample));
        found.factor += term.factor;
        found.warnings.insert(found.warnings.end(), lamps.back().warnings.begin(),
                              lamps.back().warnings.end());
    }
    if (terms.size() == 1 || found.factor == 0) {
        found.spectrum = std::move(lamps.front().spectrum);
        found.caption = terms.front().factor == 1 ? lamps.front().caption : spec;
    } else {
        found.spectrum = mix(terms, lamps);
        found.caption = spec;
    }
    if (found.caption.find(": ") == std::string::npos)
        found.caption += kelvin_of(found.spectrum);
    return found;
}

Spectrum parse_lamp(const std::string &spec, const std::filesystem::path &folder) {
    return find_lamp(spec, folder).spectrum;
}

} // namespace tsuya
