#pragma once
/// \file
/// A picture in memory: float samples, any number of named channels.

#include <cstddef>
#include <string>
#include <vector>

namespace tsuya {

/// Interleaved float picture; row 0 is the top row.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels{}; ///< names, e.g. {"R", "G", "B"}
    std::vector<float> data{}; ///< [y][x][channel], width * height * channels.size() values

    /// All values 0.
    static Image make(int width, int height, std::vector<std::string> channels);
    /// The channels of a pixel, one after the other. Not checked against the size.
    float *pixel(int x, int y) { return data.data() + offset(x, y); }
    /// The same, to be read.
    const float *pixel(int x, int y) const { return data.data() + offset(x, y); }

  private:
    std::size_t offset(int x, int y) const {
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)) *
               channels.size();
    }
};

} // namespace tsuya
