#pragma once
/// \file
/// A picture that lies on cloth.

#include <cstdint>
#include <string>
#include <vector>

namespace tsuya {

/// A picture of 8 bits a sample, so that a large one stays small: 4096 x 4096 RGB takes 48 MiB, and
/// a render a third more.
struct Texture {
    int width = 0;
    int height = 0;
    /// 1: how much of the cloth it covers; 3: R, G, B, encoded as sRGB; 4: these and how much they
    /// cover
    int channels = 3;
    std::vector<std::uint8_t> data{}; ///< [y][x][channel], row 0 is the top row

    bool operator==(const Texture &) const = default;
};

/// Throws Error naming `where` for another number of channels or samples, or no pixel.
void check_texture(const Texture &texture, const std::string &where);

} // namespace tsuya
