#include "view_tree.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tsuya::lab {
namespace {

constexpr std::uint32_t kLeafSize = 8;
constexpr float kLeastProbability = 1e-3f; // of a branch
constexpr float kWidening = 1.2f;          // of the Gaussian, so that its tails are not missed

float distance2(const glm::vec3 &a, const glm::vec3 &b) {
    const glm::vec3 d = a - b;
    return glm::dot(d, d);
}

} // namespace

ViewTree::ViewTree(const std::vector<glm::vec3> &points, const std::vector<float> &weights,
                   float width)
    : variance_(width * width * kWidening) {
    for (std::uint32_t i = 0; i < points.size(); ++i)
        points_.push_back({points[i], std::log(weights[i]), i});
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(points_.size()));
}

void ViewTree::build(std::uint32_t node, std::uint32_t begin, std::uint32_t end) {
    glm::dvec3 mean{0}, low{2}, high{-2};
    double weight = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        const glm::dvec3 p = points_[i].position;
        const double w = std::exp(points_[i].log_weight);
        mean += w * p;
        weight += w;
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    mean /= weight;
    double spread = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        const glm::dvec3 d = glm::dvec3(points_[i].position) - mean;
        spread += std::exp(points_[i].log_weight) * glm::dot(d, d);
    }
    const double variance = variance_ + 0.5 * spread / weight; // per axis of the sphere
    nodes_[node] = {glm::vec3(mean), static_cast<float>(std::log(weight * variance_ / variance)),
                    static_cast<float>(-0.5 / variance), begin, end - begin};
    if (end - begin <= kLeafSize)
        return;
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = (begin + end) / 2;
    std::nth_element(points_.begin() + begin, points_.begin() + middle, points_.begin() + end,
                     [axis](const Point &a, const Point &b) {
                         return a.position[axis] != b.position[axis]
                                    ? a.position[axis] < b.position[axis]
                                    : a.index < b.index;
                     });
    const auto child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = child;
    nodes_[node].count = 0;
    nodes_.resize(nodes_.size() + 2);
    build(child, begin, middle);
    build(child + 1, middle, end);
}

ViewTree::Choice ViewTree::sample(const glm::vec3 &centre, Random &random) const {
    const Node *node = nodes_.data();
    float probability = 1;
    const auto measure = [&](const Node &n) {
        return n.log_weight + n.inverse_width * distance2(n.mean, centre);
    };
    while (node->count == 0) {
        const Node *const left = &nodes_[node->first], *const right = left + 1;
        const float p = std::clamp(1 / (1 + std::exp(measure(*right) - measure(*left))),
                                   kLeastProbability, 1 - kLeastProbability);
        const bool go_left = random.unit() < p;
        probability *= go_left ? p : 1 - p;
        node = go_left ? left : right;
    }
    const std::uint32_t count = node->count;
    std::array<float, kLeafSize> weight{};
    const float scale = -0.5f / variance_;
    float largest = -1e30f, sum = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const Point &p = points_[node->first + i];
        weight[i] = p.log_weight + scale * distance2(p.position, centre);
        largest = std::max(largest, weight[i]);
    }
    for (std::uint32_t i = 0; i < count; ++i)
        sum += weight[i] = std::exp(weight[i] - largest) + kLeastProbability;
    std::uint32_t chosen = 0;
    for (float left = random.unit() * sum; chosen + 1 < count && left >= weight[chosen]; ++chosen)
        left -= weight[chosen];
    return {points_[node->first + chosen].index, probability * weight[chosen] / sum};
}

} // namespace tsuya::lab
