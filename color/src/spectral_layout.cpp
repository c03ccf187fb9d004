#include "spectral_layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <regex>
#include <sstream>

#include "tsuya/sdk/error.h"

namespace tsuya::layout {
namespace {

constexpr int kMostChannels = 4096;
// Of bases by their nodes. The number rises when the same channels would make another spectrum.
constexpr const char *kSamples = "samples", *kFitted = "fitted-1";
constexpr double kLightNmPerSecond = 299792458e9;

struct Prefix {
    const char *text;
    double factor;
};

// Of the International System of Units.
constexpr std::array<Prefix, 17> kPrefixes{{{"Y", 1e24},
                                            {"Z", 1e21},
                                            {"E", 1e18},
                                            {"P", 1e15},
                                            {"T", 1e12},
                                            {"G", 1e9},
                                            {"M", 1e6},
                                            {"k", 1e3},
                                            {"h", 1e2},
                                            {"da", 1e1},
                                            {"", 1},
                                            {"d", 1e-1},
                                            {"c", 1e-2},
                                            {"m", 1e-3},
                                            {"u", 1e-6},
                                            {"n", 1e-9},
                                            {"p", 1e-12}}};

double in_nm(std::string number, const std::string &prefix, const std::string &unit) {
    std::replace(number.begin(), number.end(), ',', '.');
    std::istringstream text(number);
    text.imbue(std::locale::classic());
    double value = 0;
    text >> value;
    const auto found = std::find_if(kPrefixes.begin(), kPrefixes.end(),
                                    [&](const Prefix &p) { return prefix == p.text; });
    const double si = value * found->factor;
    const double nm = unit == "m" ? 1e9 * si : kLightNmPerSecond / si;
    return std::round(1e6 * nm) / 1e6; // the same in every unit
}

std::ostringstream writer() {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text.precision(17);
    return text;
}

} // namespace

std::string group_key(std::size_t i) { return "tsuya:group." + std::to_string(i); }
std::string aov_key(std::size_t i) { return "tsuya:aov." + std::to_string(i); }
std::string aov_channel_key(std::size_t aov, std::size_t channel) {
    return aov_key(aov) + ".channel." + std::to_string(channel);
}
bool is_cryptomatte_key(const std::string &key) { return key.starts_with("cryptomatte/"); }

std::string part_of_group(const std::string &group) { return "transport." + group; }
std::string part_of_aov(const std::string &aov) { return "aov." + aov; }

std::string basis_text(const SpectralBasis &basis) {
    std::ostringstream text = writer();
    if (basis.kind == BasisKind::hats) {
        text << "hat " << basis.count << ' ' << basis.first_nm << ' ' << basis.last_nm;
        return text.str();
    }
    text << (basis.kind == BasisKind::fitted ? kFitted : kSamples) << ' ' << basis.count;
    for (const double nm : basis.node_nm)
        text << ' ' << nm;
    return text.str();
}

SpectralBasis parse_basis(const std::string &attribute, const std::string &where) {
    std::istringstream text(attribute);
    text.imbue(std::locale::classic());
    std::string kind;
    SpectralBasis basis;
    text >> kind >> basis.count;
    if (kind == "hat") {
        text >> basis.first_nm >> basis.last_nm;
    } else if (kind == kSamples || kind == kFitted) {
        std::vector<double> nodes;
        for (double nm = 0; nodes.size() < kMostChannels && text >> nm;)
            nodes.push_back(nm);
        const bool all = static_cast<int>(nodes.size()) == basis.count && text.eof();
        basis = SpectralBasis::samples_at(std::move(nodes));
        basis.kind = kind == kFitted ? BasisKind::fitted : BasisKind::samples;
        text.clear(all ? std::ios::goodbit : std::ios::failbit);
    } else {
        text.setstate(std::ios::failbit);
    }
    if (!text || basis.count > kMostChannels || !basis.is_valid())
        throw Error({"the attribute tsuya:basis is missing or wrong", where,
                     "expected hat COUNT FIRST_NM LAST_NM, samples COUNT NM..., fitted-1 COUNT "
                     "NM..., or depths COUNT"});
    return basis;
}

// The pattern of [Fichet] section 3, with a layer before it.
std::optional<SpectralChannel> parse_channel(const std::string &name, const std::string &where) {
    static const std::string wavelength =
        R"((\d+,?\d*(?:[Ee][+-]?\d+)?)(Y|Z|E|P|T|G|M|k|h|da|d|c|m|u|n|p)?(m|Hz))";
    static const std::regex one("(?:(.*)\\.)?(S0|T|M00)\\." + wavelength);
    static const std::regex two("(?:.*\\.)?T\\." + wavelength + "\\." + wavelength);
    std::smatch found;
    if (std::regex_match(name, two))
        throw Error({"the channel '" + name + "' is a reflectance between two wavelengths", where,
                     "expected a picture without fluorescence"});
    if (!std::regex_match(name, found, one))
        return std::nullopt;
    return SpectralChannel{.layer = found[1],
                           .emissive = found[2] == "S0",
                           .wavelength_nm = in_nm(found[3], found[4], found[5])};
}

} // namespace tsuya::layout
