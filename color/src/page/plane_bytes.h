#pragma once
/// \file
/// Planes of codes as text in a page.

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya {

/// Two bytes a code, first all low ones, then all high ones: of the difference from what the codes
/// to the left, above and left above foretell (their median with left + above - left above,
/// [Weinberger]), even for a difference that is not negative, odd for one that is. Modulo 65536.
std::string plane_bytes(std::span<const std::uint16_t> codes, int width);

/// Base64 with padding, without line breaks.
std::string base64(std::string_view bytes);

} // namespace tsuya
