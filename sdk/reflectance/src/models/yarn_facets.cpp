#include "tsuya/sdk/detail/yarn_facets.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr double kFarthest = 8; // in standard deviations: beyond, a lobe has 1e-14 of its peak
// In 1/sr, added: where there is no filament, rounding would decide of nothing or next to nothing
constexpr double kLeast = 1e-7;

bool is_mirrored(const YarnLobes &lobes) {
    return std::all_of(lobes.surface.begin(), lobes.surface.end(), [](const auto &surface) {
        return std::equal(surface.begin(), surface.end(), surface.rbegin());
    });
}

} // namespace

YarnFacets::YarnFacets(const YarnLobes &lobes, double roughness)
    : roughness_(static_cast<float>(roughness)), mirrored_(is_mirrored(lobes)),
      all_(lobes.filaments(0) + lobes.filaments(1)) {
    list_slopes(lobes);
    tabulate(lobes);
}

void YarnFacets::list_slopes(const YarnLobes &lobes) {
    double sum = 0;
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (int k = 0; k < kYarnSlopes; ++k)
            if (const double surface = lobes.surface[axis][static_cast<std::size_t>(k)];
                surface > 0) {
                sum += surface / all_;
                slopes_.push_back(
                    {static_cast<float>(sum), static_cast<float>(std::sin(yarn_slope(k))),
                     static_cast<float>(std::cos(yarn_slope(k))), static_cast<int>(axis)});
            }
}

double YarnFacets::sum_at(const YarnLobes &lobes, std::size_t axis, double along, double up) const {
    const double width = roughness_;
    double sum = 0;
    for (int k = 0; k < kYarnSlopes; ++k) {
        const double surface = lobes.surface[axis][static_cast<std::size_t>(k)];
        const double sine = along * std::cos(yarn_slope(k)) + up * std::sin(yarn_slope(k));
        if (surface > 0 && std::abs(sine) < kFarthest * width)
            sum += surface * std::exp(-0.5 * sine * sine / (width * width));
    }
    return sum / (all_ * std::sqrt(2 * kPi) * width * kPi) + kLeast;
}

void YarnFacets::tabulate(const YarnLobes &lobes) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
        table_[axis].assign(static_cast<std::size_t>(kAngles * kLengths), 0);
        if (empty())
            continue;
        tbb::parallel_for(0, kAngles, [&](int i) {
            const double place = static_cast<double>(i) / (kAngles - 1);
            const double turn = mirrored_ ? place : 2 * place - 1;
            const glm::dvec2 unit = glm::normalize(glm::dvec2(turn, 1 - std::abs(turn)));
            for (int j = 0; j < kLengths; ++j) {
                const glm::dvec2 part = unit * (static_cast<double>(j) / (kLengths - 1));
                table_[axis][static_cast<std::size_t>(i * kLengths + j)] =
                    static_cast<float>(sum_at(lobes, axis, part.x, part.y));
            }
        });
    }
}

// The normals of half a cylinder, turned up.
glm::vec3 YarnFacets::sample(const glm::vec3 &u) const {
    const auto found =
        std::upper_bound(slopes_.begin(), slopes_.end(), u.z,
                         [](float x, const Slope &slope) { return x < slope.up_to; });
    const Slope &slope = found == slopes_.end() ? slopes_.back() : *found;
    const float before = found == slopes_.begin() ? 0 : std::prev(found)->up_to;
    const float within = std::clamp((u.z - before) / (slope.up_to - before), 0.0f, 1.0f);
    // Normally distributed by [BoxMuller]
    const float sine = roughness_ * std::sqrt(-2 * std::log(1 - u.x)) * std::cos(2 * kPiF * within);
    if (!(std::abs(sine) < 1))
        return glm::vec3(0);
    const float angle = kPiF * (u.y - 0.5f), radius = std::sqrt(1 - sine * sine);
    const float up = radius * std::cos(angle), across = radius * std::sin(angle);
    const float along = sine * slope.cosine - up * slope.sine;
    const float height = sine * slope.sine + up * slope.cosine;
    const glm::vec3 half =
        slope.axis == 0 ? glm::vec3(along, across, height) : glm::vec3(across, along, height);
    return height < 0 ? -half : half;
}

std::size_t YarnFacets::bytes() const {
    return slopes_.size() * sizeof(Slope) + (table_[0].size() + table_[1].size()) * sizeof(float);
}

} // namespace tsuya
