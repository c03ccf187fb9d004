#include "tsuya/color/srgb.h"

#include <string>

#include <glm/matrix.hpp>

#include "tsuya/color/observer.h"
#include "tsuya/sdk/detail/srgb_curve.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// [IEC61966] Table 1: chromaticities of the primaries (those of Rec. 709) and the white.
constexpr glm::dvec2 kRed{0.64, 0.33}, kGreen{0.30, 0.60}, kBlue{0.15, 0.06},
    kWhite{0.3127, 0.3290};

int hex_digit(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

} // namespace

glm::dvec3 srgb_white() { return xyz_of_chromaticity(kWhite); }

glm::dmat3 xyz_from_srgb() {
    const glm::dmat3 primaries(xyz_of_chromaticity(kRed), xyz_of_chromaticity(kGreen),
                               xyz_of_chromaticity(kBlue));
    const glm::dvec3 scale = glm::inverse(primaries) * srgb_white();
    return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

glm::dmat3 srgb_from_xyz() { return glm::inverse(xyz_from_srgb()); }

double srgb_encode(double linear) { return detail::srgb_code(linear); }

double srgb_decode(double encoded) { return detail::srgb_light(encoded); }

glm::dvec3 parse_srgb(std::string_view text, std::string_view where) {
    const bool brief = text.size() == 4;
    bool good = (brief || text.size() == 7) && text.front() == '#';
    glm::dvec3 rgb(0.0);
    for (std::size_t i = 0; good && i < 3; ++i) {
        const int high = hex_digit(brief ? text[i + 1] : text[2 * i + 1]);
        const int low = hex_digit(brief ? text[i + 1] : text[2 * i + 2]);
        good = high >= 0 && low >= 0;
        rgb[static_cast<int>(i)] = srgb_decode((16 * high + low) / 255.0);
    }
    if (!good)
        throw Error({"'" + std::string(text) + "' is not an sRGB colour", std::string(where),
                     "expected #rrggbb or #rgb in hexadecimal digits"});
    return rgb;
}

} // namespace tsuya
