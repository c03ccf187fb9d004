#include "light_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tsuya {
namespace {

constexpr float kBelowOne = 0x1.fffffep-1f;

// Cosine of max(0, a - b), of angles up to pi, by their sines and cosines.
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}
float sine_of(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }

LightBounds bounds_of(const LightRectangle &light) {
    LightBounds b{light.corner(0), light.corner(0), light.normal(), 1,
                  light.radiance() * light.area()};
    for (int i = 1; i < 4; ++i) {
        b.low = glm::min(b.low, light.corner(i));
        b.high = glm::max(b.high, light.corner(i));
    }
    return b;
}

} // namespace

// [Conty] Eq. 3, with the bounding sphere of the box and without the distance below which it grows
// no more than the sphere is wide.
float LightBounds::importance(const Receiver &receiver) const {
    const glm::vec3 offset = 0.5f * (low + high) - receiver.position, diagonal = high - low;
    const float radius2 = 0.25f * glm::dot(diagonal, diagonal),
                distance2 = glm::dot(offset, offset);
    if (distance2 <= radius2)
        return power / radius2;
    const glm::vec3 to_light = offset / std::sqrt(distance2);
    const float sin_seen = std::sqrt(radius2 / distance2), cos_seen = sine_of(sin_seen);

    // The least angle between where they shine and the point
    const float cos_from_axis = -glm::dot(axis, to_light), sin_from_axis = sine_of(cos_from_axis);
    const float sin_spread = sine_of(cos_spread);
    const float cos_outside =
        cos_of_difference(sin_from_axis, cos_from_axis, sin_spread, cos_spread);
    const float sin_outside =
        sin_of_difference(sin_from_axis, cos_from_axis, sin_spread, cos_spread);
    const float cos_emitted = cos_of_difference(sin_outside, cos_outside, sin_seen, cos_seen);
    if (!(cos_emitted > 0))
        return 0;

    float cos_received = glm::dot(receiver.normal, to_light);
    if (receiver.both_sides)
        cos_received = std::abs(cos_received);
    cos_received = cos_of_difference(sine_of(cos_received), cos_received, sin_seen, cos_seen);
    return power * cos_emitted * std::max(0.0f, cos_received) / distance2;
}

struct LightTree::Building {
    std::vector<LightBounds> lights{};
    std::vector<std::uint32_t> order{};
};

LightTree::LightTree(const std::vector<LightRectangle> &lights) {
    if (lights.empty())
        return;
    Building building;
    for (const LightRectangle &light : lights)
        building.lights.push_back(bounds_of(light));
    building.order.resize(lights.size());
    std::iota(building.order.begin(), building.order.end(), 0u);
    build(building, 0, lights.size());
    place_.resize(lights.size());
    for (std::uint32_t i = 0; i < lights.size(); ++i)
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
    LightBounds all = building.lights[*begin];
    const auto middle = [&](std::uint32_t i) {
        return building.lights[i].low + building.lights[i].high;
    };
    glm::vec3 low = middle(*begin), high = low;
    for (auto i = begin + 1; i != end; ++i) {
        const LightBounds &b = building.lights[*i];
        all.low = glm::min(all.low, b.low);
        all.high = glm::max(all.high, b.high);
        all.axis += b.axis;
        all.power += b.power;
        low = glm::min(low, middle(*i));
        high = glm::max(high, middle(*i));
    }
    const float length = glm::length(all.axis);
    all.axis = length > 0 ? all.axis / length : glm::vec3(0, 0, 1);
    all.cos_spread = 1;
    for (auto i = begin; i != end; ++i)
        all.cos_spread =
            std::clamp(glm::dot(all.axis, building.lights[*i].axis), -1.0f, all.cos_spread);

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
    nodes_[index] = {all, second, 0};
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
    const glm::vec3 a = (b.low - from) * inverse, c = (b.high - from) * inverse;
    const glm::vec3 nearest = glm::min(a, c), farthest = glm::max(a, c);
    const float enters = std::max({nearest.x, nearest.y, nearest.z, 0.0f});
    const float leaves = std::min({farthest.x, farthest.y, farthest.z});
    // A flat box is entered and left at once: rounding may not part the two. A ray in the plane of
    // a side may give NaN, and counts.
    constexpr float kRounding = 1 + 1e-5f;
    return !(enters > leaves * kRounding);
}

} // namespace tsuya
