#pragma once
// A texture with smaller ones of it, for what is seen from afar.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/print.h"
#include "tsuya/sdk/texture.h"

namespace tsuya {

class MipTexture {
  public:
    // The texture must outlive this: it is the largest level.
    explicit MipTexture(const Texture &texture);

    // Linear R, G, B and coverage, which is 0 outside of a picture that lies once. Interpolated
    // between pixels and between levels.
    // \param place in widths and heights of the picture, (0, 0) its lower left corner
    // \param footprint what one sample stands for, in widths of the picture
    glm::vec4 at(glm::vec2 place, float footprint, Repeat repeat) const;
    float width_over_height() const {
        return static_cast<float>(levels_.front().width) /
               static_cast<float>(levels_.front().height);
    }
    // The mean of all pixels.
    glm::vec4 mean() const { return pixel(levels_.back(), 0, 0); }

  private:
    struct Level {
        int width, height;
        std::span<const std::uint8_t> data;
    };
    glm::vec4 pixel(const Level &level, int x, int y) const;
    glm::vec4 interpolated(const Level &level, glm::vec2 place, Repeat repeat) const;
    std::vector<std::uint8_t> halved(const Level &from, int width, int height) const;

    int channels_;
    std::vector<Level> levels_{};
    std::vector<std::vector<std::uint8_t>> smaller_{};
};

} // namespace tsuya
