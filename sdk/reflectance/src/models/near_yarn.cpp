#include "tsuya/sdk/near_yarn.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "models/every_processor.h"
#include "models/sky_share.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/integer_hash.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr double kWindow = 1.0 / 12; // of the places of a system, over which a slope is spread
constexpr double kNearTo = 0.5;      // crossings: a footprint below is all near
constexpr double kLeast = 1e-6;      // of the peak of a lobe, where there are no loose filaments
constexpr float kMostVisible = 2;    // brightness of what is lit in a pit over the mean
constexpr float kMostGain = 16;      // keeps the rounding of small shares out of the mean
constexpr float kLowest = 1e-6f;     // cosine: below, tangents grow no more

constexpr int kLanes = 8;
using Lanes = std::array<float, kLanes>;

constexpr float kLobeEnd = 20; // halvings of the peak

// 2^-x to 1e-4 for x from 0 to kLobeEnd, beyond it as there. What is divided is of it as what it is
// divided by.
inline float power_of_half(float x) {
    const float t = -std::min(x, kLobeEnd);
    const auto up = static_cast<std::int32_t>(t); // towards 0
    const float f = t - static_cast<float>(up) + 1;
    const float fraction = 1 + f * (0.6951786f + f * (0.2276453f + f * 0.0771761f));
    return fraction * std::bit_cast<float>((up + 126) << 23);
}

// To 0.005 radians.
float rough_arc_tangent(float x) {
    if (std::abs(x) <= 1)
        return x / (1 + 0.28f * x * x);
    return std::copysign(kHalfPiF, x) - x / (x * x + 0.28f);
}

glm::vec3 unit_half(const glm::vec3 &l, const glm::vec3 &v) {
    const glm::vec3 sum = l + v;
    return sum * (1 / std::sqrt(std::max(glm::dot(sum, sum), 1e-20f)));
}

float sum_of(const Lanes &lanes) {
    float sum = 0;
    for (const float lane : lanes)
        sum += lane;
    return sum;
}

// Of variance 1: the sum of twelve even ones.
double normal_random(std::uint32_t seed) {
    double sum = -6;
    for (std::uint32_t i = 0; i < 12; ++i)
        sum += detail::hash(seed + 0x9e3779b9u * i) * 0x1p-32;
    return sum;
}

// Tells `add` the slopes that a place of a rank has, and how much of each, in parts: the mean over
// a window of ranks, which is reflected at both ends. It is a whole number of ranks wide, so that
// all windows together cover each rank alike. \param up_to the steepest rank of each slope
template <class Add>
void share_out(const std::array<double, kYarnSlopes + 1> &up_to, std::size_t of, std::uint32_t rank,
               const Add &add) {
    const auto count = static_cast<double>(of);
    const double width = std::max(std::round(kWindow * count), 1.0), over_width = 1 / width;
    const double low = rank + 0.5 * (1 - width), high = low + width;
    const auto part = [&](double from, double to) {
        const auto after = std::upper_bound(up_to.begin() + 1, up_to.end() - 1, from);
        for (auto k = static_cast<std::size_t>(after - up_to.begin()) - 1;
             k < kYarnSlopes && up_to[k] < to; ++k)
            add(k, static_cast<float>((std::min(up_to[k + 1], to) - std::max(up_to[k], from)) *
                                      over_width));
    };
    part(std::max(low, 0.0), std::min(high, count));
    if (low < 0)
        part(0, -low);
    if (high > count)
        part(2 * count - high, count);
}

} // namespace

NearYarn::NearYarn(const YarnLobes &lobes, double body_roughness, const WeaveMap &map,
                   const Irregularity &irregularity)
    : lobes_(lobes), size_(map.size[0], map.size[1]) {
    check_weave_map(map, "weave");
    check_irregularity(irregularity, "weave.irregularity");
    threads_ = UnevenThreads(map, irregularity);
    per_thread_ = size_ / map.threads;
    const glm::dvec2 spacing = map.spacing();
    near_to_ = static_cast<float>(kNearTo * std::min(spacing.x, spacing.y));
    far_from_ = static_cast<float>(kFarFromRepeats * std::min(map.repeat.x, map.repeat.y));
    for (int k = 0; k < kYarnSlopes; ++k) {
        sine_[static_cast<std::size_t>(k)] = static_cast<float>(std::sin(yarn_slope(k)));
        cosine_[static_cast<std::size_t>(k)] = static_cast<float>(std::cos(yarn_slope(k)));
    }
    // What has no direction lies where the filaments of all slopes lie: loose ones, which are
    // facets of D = 1 / pi, and a diffuse part of the albedo that such facets have at f0 / 4
    const double step = yarn_slope(1) - yarn_slope(0),
                 all = lobes.filaments(0) + lobes.filaments(1);
    const auto spread = [&](double roughness, double at_all_slopes) {
        const double variance = roughness * roughness + step * step / 6;
        const double peak = 1 / (std::sqrt(2 * kPi * variance) * kPi);
        const double least = all > 0 ? at_all_slopes / (kPi * all * peak) : 0;
        const double over_variance = 0.5 * std::log2(std::exp(1.0)) / variance;
        return Spread{static_cast<float>(over_variance), static_cast<float>(least + kLeast),
                      static_cast<float>(std::sqrt(kLobeEnd / over_variance))};
    };
    surface_ = spread(lobes.roughness, lobes.loose + 4 * lobes.even / lobes.f0);
    body_ = spread(body_roughness, 0);
    rank_places(map, irregularity);
    for (std::size_t axis = 0; axis < 2; ++axis)
        divide(axis);
}

// Orders the places of either system by their slope, to which each filament has its own.
void NearYarn::rank_places(const WeaveMap &map, const Irregularity &irregularity) {
    const auto noise = [&](const WeavePlace &p) {
        const int side_by_side = map.filaments[p.system == WeavePlace::kWarp ? 1 : 0];
        const auto filament =
            static_cast<std::uint32_t>(0.5f * (p.across + 1) * static_cast<float>(side_by_side));
        const std::uint32_t yarn = detail::hash(static_cast<std::uint32_t>(irregularity.seed)) +
                                   (p.system * 65536u + p.thread);
        return irregularity.filament * normal_random(detail::hash(detail::hash(yarn) + filament));
    };
    const std::vector<float> sky = sky_shares(map);
    std::array<std::vector<std::pair<double, std::size_t>>, 2> order;
    double sky_sum = 0;
    for (const WeavePlace &p : map.place) {
        const std::size_t i = place_.size();
        place_.push_back({.system = p.system});
        if (p.system == WeavePlace::kGap)
            continue;
        place_[i].sky = static_cast<std::uint8_t>(std::clamp(std::lround(255 * sky[i]), 1L, 255L));
        place_[i].along = static_cast<std::uint8_t>(
            std::min(static_cast<int>(p.along * static_cast<float>(kParts)), kParts - 1));
        sky_sum += place_[i].sky;
        order[p.system].emplace_back(static_cast<double>(p.slope) + noise(p), i);
    }
    mean_sky_ = std::max(sky_sum, 1.0) / static_cast<double>(place_.size());
    for (std::size_t axis = 0; axis < 2; ++axis) {
        std::sort(order[axis].begin(), order[axis].end());
        for (std::size_t rank = 0; rank < order[axis].size(); ++rank)
            place_[order[axis][rank].second].rank = static_cast<std::uint32_t>(rank);
        system_[axis].count = order[axis].size();
    }
}

// The fitted surface in the order of its slopes, given to the places in the order of theirs.
void NearYarn::divide(std::size_t axis) {
    System &system = system_[axis];
    const double all = lobes_.filaments(axis);
    const auto count = static_cast<double>(system.count);
    for (std::size_t k = 0; k < kYarnSlopes; ++k) {
        // Without a surface there is what has no slope alone
        const double share = all > 0 ? lobes_.surface[axis][k] / all : k == kYarnSlopes / 2 ? 1 : 0;
        system.share[k] = static_cast<float>(share);
        system.up_to[k + 1] = system.up_to[k] + share * count;
    }
    std::array<std::array<double, kYarnSlopes>, kParts> seen{};
    std::array<double, kYarnSlopes> all_seen{};
    for (const Packed &place : place_) {
        if (place.system != axis)
            continue;
        const Slopes has = window(axis, place.rank);
        for (std::size_t k = 0; k < kYarnSlopes; ++k) {
            seen[place.along][k] += static_cast<double>(has[k]) * place.sky;
            all_seen[k] += static_cast<double>(has[k]) * place.sky;
        }
    }
    for (std::size_t k = 0; k < kYarnSlopes; ++k) {
        if (!(all_seen[k] > 0))
            continue;
        const double share = static_cast<double>(system.share[k]);
        system.over_sky[k] = static_cast<float>(share * count / all_seen[k]);
        double before = 0;
        for (std::size_t part = 0; part < kParts; ++part) {
            before += seen[part][k] / all_seen[k];
            system.before[part + 1][k] = static_cast<float>(before);
        }
        system.before[kParts + 1][k] = system.before[kParts][k];
    }
}

// What a place of this rank has of each slope.
NearYarn::Slopes NearYarn::window(std::size_t axis, std::uint32_t rank) const {
    Slopes has{};
    share_out(system_[axis].up_to, system_[axis].count, rank,
              [&](std::size_t k, float share) { has[k] += share; });
    return has;
}

NearPlace NearYarn::at(const glm::dvec2 &cloth, float footprint) const {
    NearPlace made;
    made.near = std::clamp((far_from_ - footprint) / (far_from_ - near_to_), 0.0f, 1.0f);
    if (!(made.near > 0))
        return made;
    const UnevenThreads::Spot spot = threads_.at(cloth);
    const auto index = [](float place, int per_thread, int size) {
        return static_cast<std::size_t>(
            std::min(static_cast<int>(place * static_cast<float>(per_thread)), size - 1));
    };
    const Packed &place =
        place_[index(spot.place.y, per_thread_.y, size_.y) * static_cast<std::size_t>(size_.x) +
               index(spot.place.x, per_thread_.x, size_.x)];
    made.system = place.system;
    made.along = place.along;
    if (place.system == WeavePlace::kGap)
        return made;
    made.even = spot.density * static_cast<float>(place.sky / mean_sky_);
    const System &system = system_[place.system];
    const float gain = spot.density * static_cast<float>(place_.size()) /
                       static_cast<float>(system.count) * static_cast<float>(place.sky);
    share_out(system.up_to, system.count, place.rank, [&](std::size_t k, float share) {
        const float weight = share * gain * system.over_sky[k];
        made.weight[k] += weight;
        made.all += weight;
    });
    return made;
}

// The slopes whose lobes do not end before a half vector, with some more.
NearYarn::Range NearYarn::slopes_at(float along, float up, const Spread &spread) {
    static const auto kPerRadian = static_cast<float>(1 / (yarn_slope(1) - yarn_slope(0)));
    constexpr float kMiddle = 0.5f * (kYarnSlopes - 1), kVector = kLanes;
    const float reach = spread.reach / std::max(std::sqrt(along * along + up * up), 1e-10f);
    if (reach > 0.8f)
        return {0, kSlopes};
    // 1.17 reach is above the arc sine up to 0.8
    const float middle = -rough_arc_tangent(along / std::max(up, 1e-10f));
    const float low = kMiddle + kPerRadian * (middle - 1.17f * reach) - 1,
                high = kMiddle + kPerRadian * (middle + 1.17f * reach) + 1;
    const float last = kSlopes / kVector;
    const float first = std::clamp(std::floor(low / kVector), 0.0f, last);
    return {static_cast<std::size_t>(first * kVector),
            static_cast<std::size_t>(std::clamp(std::floor(high / kVector) + 1, first, last) *
                                     kVector)};
}

// Sums over slopes of what the place has and of what all places have.
TSUYA_FOR_EVERY_PROCESSOR float NearYarn::plain(std::size_t axis, const NearPlace &place,
                                                const Spread &spread, const glm::vec3 &half) const {
    const float along = axis == 0 ? half.x : half.y, up = half.z;
    const Slopes &share = system_[axis].share;
    const Range range = slopes_at(along, up, spread);
    Lanes here{}, mean{};
    for (std::size_t i = range.first; i < range.end; i += kLanes)
        for (std::size_t j = 0; j < kLanes; ++j) {
            const std::size_t k = i + j;
            const float sine = along * cosine_[k] + up * sine_[k];
            const float lobe = power_of_half(sine * sine * spread.over_variance);
            here[j] += place.weight[k] * lobe;
            mean[j] += share[k] * lobe;
        }
    return (spread.least * place.all + sum_of(here)) / (spread.least + sum_of(mean));
}

// The same with the walls of the yarn's pit. Of what is at a slope the share g lies where light and
// viewer reach, between two places along the float: that is brighter by up to kMostVisible, and all
// else as much darker as leaves the mean.
TSUYA_FOR_EVERY_PROCESSOR float NearYarn::shadowed(std::size_t axis, const NearPlace &place,
                                                   const glm::vec3 &half, float from,
                                                   float to) const {
    const float along = axis == 0 ? half.x : half.y, up = half.z;
    const System &system = system_[axis];
    const auto first = static_cast<std::size_t>(from), last = static_cast<std::size_t>(to);
    const float after_first = from - static_cast<float>(first),
                after_last = to - static_cast<float>(last);
    const auto part = static_cast<float>(place.along);
    const float reached = std::clamp(to - part, 0.0f, 1.0f) - std::clamp(from - part, 0.0f, 1.0f);
    const float most =
        std::min(kMostVisible * static_cast<float>(kParts) / std::max(to - from, 1.0f), kMostGain);
    const Slopes &a = system.before[first], &a1 = system.before[first + 1],
                 &b = system.before[last], &b1 = system.before[last + 1];
    const Range range = slopes_at(along, up, surface_);
    Lanes here{}, mean{};
    for (std::size_t i = range.first; i < range.end; i += kLanes)
        for (std::size_t j = 0; j < kLanes; ++j) {
            const std::size_t k = i + j;
            const float sine = along * cosine_[k] + up * sine_[k];
            const float lobe = power_of_half(sine * sine * surface_.over_variance);
            const float open =
                (b[k] + after_last * (b1[k] - b[k])) - (a[k] + after_first * (a1[k] - a[k]));
            const float gain = std::min(1 / std::max(open, 1e-6f), most);
            const float lit = std::max(1 + gain * (reached - open), 0.0f);
            here[j] += place.weight[k] * lobe * lit;
            mean[j] += system.share[k] * lobe;
        }
    return (surface_.least * place.all + sum_of(here)) / (surface_.least + sum_of(mean));
}

// A system that is never on the face has no places of its own, and stays as it is from far.
glm::vec2 NearYarn::of_systems(const NearPlace &place, float factor) const {
    glm::vec2 made(1);
    for (std::uint8_t axis = 0; axis < 2; ++axis)
        if (system_[axis].count > 0)
            made[axis] = 1 + place.near * ((axis == place.system ? factor : 0) - 1);
    return made;
}

glm::vec2 NearYarn::surface(const NearPlace &place, const glm::vec3 &l, const glm::vec3 &v) const {
    if (place.system == WeavePlace::kGap)
        return of_systems(place, 0);
    const glm::vec3 half = unit_half(l, v);
    const auto axis = static_cast<glm::length_t>(place.system);
    const auto pit = static_cast<float>(lobes_.pit[place.system]);
    if (!(pit > 0))
        return of_systems(place, plain(place.system, place, surface_, half));
    // Light from the far end of the float does not reach what lies before that end, and so on
    const float light = l[axis] / std::max(l.z, kLowest), viewer = v[axis] / std::max(v.z, kLowest);
    const auto parts = static_cast<float>(kParts);
    const float to = parts * std::clamp(1 - pit * std::max({light, viewer, 0.0f}), 0.0f, 1.0f);
    const float from =
        std::min(parts * std::clamp(-pit * std::min({light, viewer, 0.0f}), 0.0f, 1.0f), to);
    return of_systems(place, shadowed(place.system, place, half, from, to));
}

glm::vec2 NearYarn::body(const NearPlace &place, const glm::vec3 &l, const glm::vec3 &v) const {
    if (place.system == WeavePlace::kGap)
        return of_systems(place, 0);
    return of_systems(place, plain(place.system, place, body_, unit_half(l, v)));
}

double NearYarn::crowding(std::size_t axis) const {
    const std::size_t count = system_[axis].count;
    return count > 0 ? lobes_.filaments(axis) * static_cast<double>(place_.size()) /
                           static_cast<double>(count)
                     : 0;
}

} // namespace tsuya
