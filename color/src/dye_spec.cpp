// Dyes as programs name them, and their mixtures.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "kubelka.h"
#include "lower_case.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/measured_spectrum.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/color/srgb.h"
#include "tsuya/color/upsample.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr double kDarkest = 1e-4; // reflectance below which K/S grows without bound
constexpr double kMostPercent = 100;
constexpr const char *kLab = "expected such as lab(50 20 -30) or lab(50 20 -30 D50/2)";

std::string trimmed(std::string_view text) { return std::string(detail::without_blanks(text)); }

/// What stands in the brackets of `name(...)`.
std::optional<std::string> argument_of(const std::string &spec, std::string_view name) {
    const std::string lower = lower_case(spec);
    if (!lower.starts_with(name) || lower.size() < name.size() + 2 || lower[name.size()] != '(' ||
        lower.back() != ')')
        return std::nullopt;
    return trimmed(spec.substr(name.size() + 1, spec.size() - name.size() - 2));
}

/// A dye of a mixture.
struct Term {
    std::string dye{};
    double percent = 0;
};

/// `NAME NUMBER%`
std::optional<Term> parse_term(const std::string &text) {
    if (!text.ends_with('%'))
        return std::nullopt;
    const std::string body = trimmed(std::string_view(text).substr(0, text.size() - 1));
    const std::size_t blank = body.find_last_of(' ');
    if (blank == body.npos)
        return std::nullopt;
    Term term{.dye = trimmed(body.substr(0, blank))};
    const char *const end = body.data() + body.size();
    const auto [at, code] = std::from_chars(body.data() + blank + 1, end, term.percent);
    return code == std::errc{} && at == end ? std::optional(std::move(term)) : std::nullopt;
}

/// Nothing where the spec is no mixture.
std::optional<std::vector<Term>> parse_mixture(const std::string &spec, const std::string &where) {
    if (!spec.ends_with('%'))
        return std::nullopt;
    std::vector<Term> terms;
    for (std::size_t begin = 0; begin <= spec.size();) {
        const std::size_t end = std::min(spec.find('+', begin), spec.size());
        const std::string text = trimmed(std::string_view(spec).substr(begin, end - begin));
        std::optional<Term> term = parse_term(text);
        if (!term && parse_spectrum_file_spec(spec)) // a sample of that name
            return std::nullopt;
        if (!term || !(term->percent >= 0 && term->percent <= kMostPercent))
            throw Error({"'" + text + "' is no dye with its percentage", where,
                         "expected such as indigo 2% + madder 0.5%, from 0 to 100 %"});
        terms.push_back(std::move(*term));
        begin = end + 1;
    }
    return terms;
}

Spectrum parse_lab(const std::string &text, const std::string &where) {
    std::istringstream words(text);
    std::vector<double> numbers;
    std::string lamp_name = "D65", observer_name = "10";
    bool given = false;
    for (std::string word; words >> word;) {
        const auto value = detail::DecimalReader().read(word);
        if (value && numbers.size() < 3) {
            numbers.push_back(*value);
            continue;
        }
        const std::size_t slash = word.find('/');
        if (numbers.size() != 3 || slash == word.npos || std::exchange(given, true))
            throw Error({"'" + text + "' is no colour in CIELAB", where, kLab});
        lamp_name = word.substr(0, slash);
        observer_name = word.substr(slash + 1);
    }
    if (numbers.size() != 3 || (observer_name != "2" && observer_name != "10"))
        throw Error({"'" + text + "' is no colour in CIELAB", where, kLab});
    return reflectance_of_lab({numbers[0], numbers[1], numbers[2]}, lamp(lamp_name),
                              observer_name == "2" ? Observer::cie1931 : Observer::cie1964, where);
}

/// Nothing for a file of spectra, which has to be read.
std::optional<Spectrum> without_files(const std::string &spec, const std::string &where) {
    if (spec.starts_with('#'))
        return reflectance_of_srgb(parse_srgb(spec, where), where);
    if (const auto lab = argument_of(spec, "lab"))
        return parse_lab(*lab, where);
    if (parse_spectrum_file_spec(spec))
        return std::nullopt;
    try {
        return dye(spec);
    } catch (const Error &error) {
        throw Error({error.problems()[0].what, where,
                     error.problems()[0].accepted +
                         "; or #rrggbb, lab(50 20 -30), a mixture such as indigo 2% + madder "
                         "0.5%, or a file that ends in " +
                         spectrum_file_endings()});
    }
}

NamedDye find_mixture(const std::vector<Term> &terms, const std::string &spec,
                      const std::filesystem::path &folder, const std::string &where) {
    NamedDye mixed{.name = spec};
    std::vector<DyeShare> shares;
    for (const Term &term : terms) {
        NamedDye one = find_dye(term.dye, folder, where);
        shares.push_back({std::move(one.spectrum), term.percent});
        mixed.warnings.insert(mixed.warnings.end(), one.warnings.begin(), one.warnings.end());
    }
    mixed.spectrum = mix_dyes(shares);
    return mixed;
}

} // namespace

Spectrum mix_dyes(std::span<const DyeShare> shares) {
    if (shares.empty())
        throw Error({"no dye is in the mixture", "dye", "expected one or more"});
    const Spectrum undyed = dye("white");
    Spectrum mixture{undyed.wavelength_nm, {}};
    for (const DyeShare &share : shares) {
        check_spectrum(share.dye, 0, 1, "dye");
        if (!(share.percent >= 0 && share.percent <= kMostPercent))
            throw Error({"the percentage of a dye is " + std::to_string(share.percent), "dye",
                         "expected 0 to 100"});
        mixture.wavelength_nm.insert(mixture.wavelength_nm.end(), share.dye.wavelength_nm.begin(),
                                     share.dye.wavelength_nm.end());
    }
    std::ranges::sort(mixture.wavelength_nm);
    const auto repeated = std::ranges::unique(mixture.wavelength_nm);
    mixture.wavelength_nm.erase(repeated.begin(), repeated.end());
    for (const double nm : mixture.wavelength_nm) {
        const double ground = absorption_of(undyed.at(nm));
        double k_over_s = ground;
        for (const DyeShare &share : shares)
            k_over_s += share.percent *
                        std::max(0.0, absorption_of(std::max(kDarkest, share.dye.at(nm))) - ground);
        mixture.value.push_back(reflectance_of(k_over_s));
    }
    return mixture;
}

Spectrum on_cloth(const Spectrum &reflectance) {
    const Spectrum white = dye("white"), black = dye("black");
    Spectrum result{reflectance.wavelength_nm, {}};
    result.wavelength_nm.insert(result.wavelength_nm.end(), white.wavelength_nm.begin(),
                                white.wavelength_nm.end());
    std::ranges::sort(result.wavelength_nm);
    const auto repeated = std::ranges::unique(result.wavelength_nm);
    result.wavelength_nm.erase(repeated.begin(), repeated.end());
    for (const double nm : result.wavelength_nm)
        result.value.push_back(std::lerp(black.at(nm), white.at(nm), reflectance.at(nm)));
    return result;
}

void check_dye_spec(const std::string &spec, const std::string &where) {
    if (const auto inside = argument_of(spec, "cloth"))
        return check_dye_spec(*inside, where);
    if (const auto terms = parse_mixture(spec, where)) {
        for (const Term &term : *terms)
            check_dye_spec(term.dye, where);
        return;
    }
    without_files(spec, where);
}

NamedDye find_dye(const std::string &spec, const std::filesystem::path &folder,
                  const std::string &where) {
    if (const auto inside = argument_of(spec, "cloth")) {
        NamedDye found = find_dye(*inside, folder, where);
        found.spectrum = on_cloth(found.spectrum);
        found.name = spec;
        return found;
    }
    if (const auto terms = parse_mixture(spec, where))
        return find_mixture(*terms, spec, folder, where);
    if (std::optional<Spectrum> known = without_files(spec, where))
        return {.name = spec, .spectrum = std::move(*known)};
    const SpectrumFileSpec file = *parse_spectrum_file_spec(spec);
    MeasuredSpectrum read = read_dye_file(folder / file.path, file.sample);
    return {
        .name = spec, .spectrum = std::move(read.spectrum), .warnings = std::move(read.warnings)};
}

Spectrum parse_dye(const std::string &spec, const std::filesystem::path &folder,
                   const std::string &where) {
    return find_dye(spec, folder, where).spectrum;
}

} // namespace tsuya
