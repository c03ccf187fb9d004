#include "files/png_alpha.h"

#include <cstdint>

namespace tsuya::garment {
namespace {

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t number = 0;
    for (const char byte : bytes.substr(0, 4))
        number = number << 8 | static_cast<unsigned char>(byte);
    return number;
}

} // namespace

PictureAlpha alpha_in(std::string_view bytes) {
    constexpr std::string_view kPng = "\x89PNG\r\n\x1a\n", kJpeg = "\xff\xd8\xff";
    constexpr std::size_t kColourType = 25, kAround = 12; // length, type and checksum of a chunk
    if (bytes.starts_with(kJpeg))
        return PictureAlpha::has_not;
    if (!bytes.starts_with(kPng) || bytes.size() <= kColourType)
        return PictureAlpha::unknown;
    if (bytes[kColourType] == 4 || bytes[kColourType] == 6)
        return PictureAlpha::has;
    for (std::string_view rest = bytes.substr(kPng.size()); rest.size() >= kAround;) {
        const std::string_view type = rest.substr(4, 4);
        const std::size_t length = big_endian(rest);
        if (type == "tRNS")
            return PictureAlpha::has;
        if (type == "IDAT" || length > rest.size() - kAround)
            break;
        rest.remove_prefix(kAround + length);
    }
    return PictureAlpha::has_not;
}

} // namespace tsuya::garment
