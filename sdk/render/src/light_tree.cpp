#include "light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

// Cosine of how far the directions of `of` are from an axis at most.
float cos_farthest(const glm::vec3 &axis, const LightBounds &of) {
    const float to_axis = glm::dot(axis, of.axis());
    if (of.cos_spread() >= 1)
        return to_axis;
    const float angle = std::acos(std::clamp(to_axis, -1.0f, 1.0f)) + std::acos(of.cos_spread());
    return angle < kPiF ? std::cos(angle) : -1.0f;
}

} // namespace

struct LightTree::Building {
    std::vector<LightBounds> lights{};
    std::vector<std::uint32_t> order{};
};

LightTree::LightTree(std::vector<LightBounds> lights) {
    if (lights.empty())
        return;
    Building building{.lights = std::move(lights)};
    building.order.resize(building.lights.size());
    std::iota(building.order.begin(), building.order.end(), 0u);
    build(building, 0, building.lights.size());
    place_.resize(building.lights.size());
    for (std::uint32_t i = 0; i < place_.size(); ++i)
        place_[building.order[i]] = i;
}

// The node of lights `first` to `last` in order; halves them along the longer side of the box of
// their middles.
void LightTree::build(Building &building, std::size_t first, std::size_t last) {
    const auto begin = building.order.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = building.order.begin() + static_cast<std::ptrdiff_t>(last);
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    if (last - first == 1) {
        nodes_[index] = {building.lights[*begin], 0, *begin};
        return;
    }
    const auto of = [&](std::uint32_t i) -> const LightBounds & { return building.lights[i]; };
    const auto middle = [&](std::uint32_t i) { return of(i).low() + of(i).high(); };
    glm::vec3 box_low = of(*begin).low(), box_high = of(*begin).high(), axis(0);
    glm::vec3 low = middle(*begin), high = low;
    float power = 0;
    for (auto i = begin; i != end; ++i) {
        box_low = glm::min(box_low, of(*i).low());
        box_high = glm::max(box_high, of(*i).high());
        axis += of(*i).axis();
        power += of(*i).power();
        low = glm::min(low, middle(*i));
        high = glm::max(high, middle(*i));
    }
    const float length = glm::length(axis);
    axis = length > 0 ? axis / length : glm::vec3(0, 0, 1);
    float cos_spread = 1, cos_reach = 1;
    for (auto i = begin; i != end; ++i) {
        cos_spread = std::clamp(cos_farthest(axis, of(*i)), -1.0f, cos_spread);
        cos_reach = std::min(cos_reach, of(*i).cos_reach());
    }

    const glm::vec3 size = high - low;
    const int side = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    const std::size_t half = first + (last - first) / 2;
    std::nth_element(begin, building.order.begin() + static_cast<std::ptrdiff_t>(half), end,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const float at = middle(a)[side], bt = middle(b)[side];
                         return at < bt || (at == bt && a < b);
                     });
    build(building, first, half);
    const auto second = static_cast<std::uint32_t>(nodes_.size());
    build(building, half, last);
    nodes_[index] = {{box_low, box_high, {axis, cos_spread, cos_reach}, power}, second, 0};
}

std::optional<float> LightTree::first_share(std::uint32_t node, const Receiver &receiver) const {
    const float first = nodes_[node + 1].bounds.importance(receiver);
    const float both = first + nodes_[nodes_[node].second].bounds.importance(receiver);
    if (!(both > 0))
        return std::nullopt;
    return first / both;
}

std::optional<ChosenLight> LightTree::choose(const Receiver &receiver, float u) const {
    if (nodes_.empty())
        return std::nullopt;
    std::uint32_t node = 0;
    float probability = 1;
    while (nodes_[node].second != 0) {
        const std::optional<float> share = first_share(node, receiver);
        if (!share)
            return std::nullopt;
        const bool to_first = u < *share;
        const float of_this = to_first ? *share : 1 - *share;
        u = std::min((to_first ? u : u - *share) / of_this, kBelowOne);
        probability *= of_this;
        node = to_first ? node + 1 : nodes_[node].second;
    }
    return ChosenLight{nodes_[node].light, probability};
}

float LightTree::probability(const Receiver &receiver, std::size_t light) const {
    std::size_t first = 0, last = place_.size();
    std::uint32_t node = 0;
    float probability = 1;
    while (last - first > 1 && probability > 0) {
        const std::size_t half = first + (last - first) / 2;
        const std::optional<float> share = first_share(node, receiver);
        if (!share)
            return 0;
        const bool to_first = place_[light] < half;
        probability *= to_first ? *share : 1 - *share;
        node = to_first ? node + 1 : nodes_[node].second;
        (to_first ? last : first) = half;
    }
    return probability;
}

bool LightTree::crosses(const LightBounds &b, const glm::vec3 &from, const glm::vec3 &inverse) {
    const glm::vec3 a = (b.low() - from) * inverse, c = (b.high() - from) * inverse;
    const glm::vec3 nearest = glm::min(a, c), farthest = glm::max(a, c);
    const float enters = std::max({nearest.x, nearest.y, nearest.z, 0.0f});
    const float leaves = std::min({farthest.x, farthest.y, farthest.z});
    // A flat box is entered and left at once: rounding may not part the two. A ray in the plane of
    // a side may give NaN, and counts.
    constexpr float kRounding = 1 + 1e-5f;
    return !(enters > leaves * kRounding);
}

} // namespace tsuya
