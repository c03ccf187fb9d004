#pragma once
// From metres of cloth to the place in a picture.

#include <cmath>

#include <glm/glm.hpp>

#include "tsuya/sdk/print.h"

namespace tsuya {

class ClothPlace {
  public:
    // \param aspect width of the picture over its height
    ClothPlace(const Placement &placement, float aspect)
        : origin_(placement.origin), per_metre_(static_cast<float>(1 / placement.width)) {
        const auto turn = static_cast<float>(placement.turn);
        right_ = per_metre_ * glm::vec2(std::cos(turn), std::sin(turn));
        up_ = per_metre_ * aspect * glm::vec2(-std::sin(turn), std::cos(turn));
    }

    // In widths and heights of the picture.
    glm::vec2 at(glm::vec2 uv) const {
        const glm::vec2 from = uv - origin_;
        return {glm::dot(from, right_), glm::dot(from, up_)};
    }
    float widths_per_metre() const { return per_metre_; }

  private:
    glm::vec2 origin_, right_{}, up_{};
    float per_metre_;
};

} // namespace tsuya
