#pragma once
// Lights in a binary tree, from which one is chosen in proportion to what it may give to a point
// [Conty].

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

#include "light_bounds.h"

namespace tsuya {

struct ChosenLight {
    std::size_t light;
    float probability;
};

class LightTree {
  public:
    LightTree() = default;
    explicit LightTree(std::vector<LightBounds> lights);

    // None where no light can give anything. \param u in [0, 1)
    std::optional<ChosenLight> choose(const Receiver &receiver, float u) const;
    // Of choosing the light.
    float probability(const Receiver &receiver, std::size_t light) const;

    // Calls `meet(light)` for each light whose bounds the ray crosses, until that returns true.
    // \return whether it did
    template <class F>
    bool cross(const glm::vec3 &from, const glm::vec3 &direction, F &&meet) const {
        const glm::vec3 inverse = 1.0f / direction;
        std::uint32_t waiting[kMostDepth];
        std::size_t count = 0;
        if (!nodes_.empty())
            waiting[count++] = 0;
        while (count > 0) {
            const std::uint32_t i = waiting[--count];
            const Node &node = nodes_[i];
            if (node.second == 0) {
                if (meet(std::size_t{node.light}))
                    return true;
            } else if (crosses(node.bounds, from, inverse)) {
                waiting[count++] = node.second;
                waiting[count++] = i + 1;
            }
        }
        return false;
    }

  private:
    static constexpr std::size_t kMostDepth = 64;
    // The first child of a node follows it.
    struct Node {
        LightBounds bounds;
        std::uint32_t second = 0; // child; 0: a leaf
        std::uint32_t light = 0;  // of a leaf
    };
    struct Building;
    void build(Building &building, std::size_t first, std::size_t last);
    static bool crosses(const LightBounds &bounds, const glm::vec3 &from,
                        const glm::vec3 &inverse_direction);
    // Probability of going on to the first child; none where neither counts.
    std::optional<float> first_share(std::uint32_t node, const Receiver &receiver) const;

    std::vector<Node> nodes_{};
    std::vector<std::uint32_t> place_{}; // of each light in the order of the leaves
};

} // namespace tsuya
