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
    glm::vec3 low = light.corner(0), high = low;
    for (int i = 1; i < 4; ++i) {
        low = glm::min(low, light.corner(i));
        high = glm::max(high, light.corner(i));
    }
    return {low, high, light.normal(), 1, light.radiance() * light.area()};
}

} // namespace

LightBounds::LightBounds(const glm::vec3 &low, const glm::vec3 &high, const glm::vec3 &axis,
                         float cos_spread, float power)
    : low_(low), high_(high), axis_(axis), middle_(0.5f * (low + high)),
      radius2_(0.25f * glm::dot(high - low, high - low)), cos_spread_(cos_spread),
      sin_spread_(sine_of(cos_spread)), power_(power) {}

// [Conty] Eq. 3, with the bounding sphere of the box.
float LightBounds::importance(const Receiver &receiver) const {
    const glm::vec3 offset = middle_ - receiver.position;
    const float distance2 = glm::dot(offset, offset);
    if (distance2 <= radius2_)
        return power_ / radius2_;
    const float per_distance2 = 1 / distance2;
    const glm::vec3 to_light = offset * std::sqrt(per_distance2);
    const float sin2_seen = radius2_ * per_distance2;
    const float sin_seen = std::sqrt(sin2_seen), cos_seen = std::sqrt(1 - sin2_seen);

    // The least angle between where they shine and the point
    const float cos_axis = -glm::dot(axis_, to_light), sin_axis = sine_of(cos_axis);
    const float cos_outside = cos_of_difference(sin_axis, cos_axis, sin_spread_, cos_spread_);
    const float sin_outside = sin_of_difference(sin_axis, cos_axis, sin_spread_, cos_spread_);
    const float cos_emitted = cos_of_difference(sin_outside, cos_outside, sin_seen, cos_seen);
    if (!(cos_emitted > 0))
        return 0;

    float cos_received = glm::dot(receiver.normal, to_light);
    if (receiver.both_sides)
        cos_received = std::abs(cos_received);
    cos_received = cos_of_difference(sine_of(cos_received), cos_received, sin_seen, cos_seen);
    return power_ * cos_emitted * std::max(0.0f, cos_received) * per_distance2;
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
    float cos_spread = 1;
    for (auto i = begin; i != end; ++i)
        cos_spread = std::clamp(glm::dot(axis, of(*i).axis()), -1.0f, cos_spread);

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
    nodes_[index] = {{box_low, box_high, axis, cos_spread, power}, second, 0};
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
