#pragma once
// A choice among many directions in proportion to a Gaussian about a point.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "random.h"

namespace tsuya::lab {

// A tree over weighted points of the unit sphere. A node stands for its points by a Gaussian with
// their mean and spread. Every point has a probability above 0, so that estimates are unbiased.
class ViewTree {
  public:
    ViewTree() = default;
    // \param width standard deviation of the Gaussian, chord
    ViewTree(const std::vector<glm::vec3> &points, const std::vector<float> &weights, float width);

    struct Choice {
        std::uint32_t index;
        float probability;
    };
    Choice sample(const glm::vec3 &centre, Random &random) const;

  private:
    struct Node {
        glm::vec3 mean;
        float log_weight;           // of the points' sum and the widening
        float inverse_width;        // -1 / (2 variance)
        std::uint32_t first, count; // of the points in a leaf; first child and 0 otherwise
    };
    struct Point {
        glm::vec3 position;
        float log_weight;
        std::uint32_t index;
    };
    void build(std::uint32_t node, std::uint32_t begin, std::uint32_t end);

    float variance_ = 0;
    std::vector<Node> nodes_{};
    std::vector<Point> points_{};
};

} // namespace tsuya::lab
