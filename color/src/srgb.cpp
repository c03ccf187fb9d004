#include "tsuya/color/srgb.h"

#include <string>

#include <glm/matrix.hpp>

#include "tsuya/color/observer.h"
#include "tsuya/color/rgb_primaries.h"
#include "tsuya/sdk/detail/srgb_curve.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

int hex_digit(char c) {
    if (c >= '0' && c <= '9')
        return c - '0';
    if (c >= 'a' && c <= 'f')
        return c - 'a' + 10;
    return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

} // namespace

glm::dvec3 srgb_white() { return xyz_of_chromaticity(kRec709.white); }

glm::dmat3 xyz_from_srgb() { return xyz_from_rgb(kRec709); }

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
