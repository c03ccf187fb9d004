#include "page/plane_bytes.h"

#include <algorithm>

namespace tsuya {
namespace {

int foretold(std::span<const std::uint16_t> codes, std::size_t p, std::size_t width) {
    const bool first_column = p % width == 0, first_row = p < width;
    if (first_column && first_row)
        return 0;
    if (first_row)
        return codes[p - 1];
    if (first_column)
        return codes[p - width];
    const int left = codes[p - 1], above = codes[p - width], corner = codes[p - width - 1];
    return std::clamp(left + above - corner, std::min(left, above), std::max(left, above));
}

} // namespace

std::string plane_bytes(std::span<const std::uint16_t> codes, int width) {
    std::string bytes(2 * codes.size(), '\0');
    for (std::size_t p = 0; p < codes.size(); ++p) {
        const auto difference = static_cast<std::int16_t>(
            codes[p] - foretold(codes, p, static_cast<std::size_t>(width)));
        const auto folded =
            static_cast<std::uint16_t>(difference < 0 ? -2 * difference - 1 : 2 * difference);
        bytes[p] = static_cast<char>(folded & 0xff);
        bytes[codes.size() + p] = static_cast<char>(folded >> 8);
    }
    return bytes;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        for (std::size_t j = 0; j < 3; ++j)
            three = three << 8 | (j < count ? static_cast<std::uint8_t>(bytes[i + j]) : 0u);
        for (std::size_t j = 0; j < 4; ++j)
            text += j <= count ? kDigits[three >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

} // namespace tsuya
