#include "tsuya/sdk/detail/direction_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kRows = 10;    // over sqrt(cos theta)
constexpr int kColumns = 24; // of azimuth, 15 degrees
constexpr int kCells = 32;   // along the square of a density
constexpr float kEvenShare = 0.05f;
constexpr float kLowest = 1e-5f; // cosine that stands for the horizon itself

struct Corner {
    int index;
    float weight;
};

// The fixed directions about one, with their shares.
std::array<Corner, 4> corners(const glm::vec3 &d) {
    const float y = std::sqrt(std::min(d.z, 1.0f)) * (kRows - 1);
    float phi = std::atan2(d.y, d.x);
    phi += phi < 0 ? 2 * kPiF : 0;
    const float x = phi * (kColumns / (2 * kPiF));
    const int j = std::min(static_cast<int>(y), kRows - 2);
    const int i = std::min(static_cast<int>(x), kColumns - 1), next = (i + 1) % kColumns;
    const float t = y - static_cast<float>(j), s = std::min(x - static_cast<float>(i), 1.0f);
    return {{{j * kColumns + i, (1 - t) * (1 - s)},
             {j * kColumns + next, (1 - t) * s},
             {(j + 1) * kColumns + i, t * (1 - s)},
             {(j + 1) * kColumns + next, t * s}}};
}

Distribution2D tabulate(const DirectionSampler::Density &density, const glm::vec3 &fixed) {
    std::vector<double> mass;
    double total = 0;
    for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i) {
            const glm::vec2 u = (glm::vec2(i, j) + 0.5f) / static_cast<float>(kCells);
            mass.push_back(density(fixed, direction_of_disk(disk_of_square(u))));
            total += mass.back();
        }
    for (double &m : mass)
        m += kEvenShare * total / static_cast<double>(mass.size());
    return {mass, kCells, kCells};
}

} // namespace

DirectionSampler::DirectionSampler(const Density &density)
    : density_(static_cast<std::size_t>(kRows * kColumns)) {
    tbb::parallel_for(0, kRows * kColumns, [&](int k) {
        const int row = k / kColumns;
        const float root = static_cast<float>(row) / (kRows - 1);
        const float z = std::max(root * root, kLowest), s = std::sqrt(std::max(0.0f, 1 - z * z));
        const float phi = static_cast<float>(k % kColumns) * (2 * kPiF / kColumns);
        density_[static_cast<std::size_t>(k)] =
            tabulate(density, {s * std::cos(phi), s * std::sin(phi), z});
    });
}

glm::vec3 DirectionSampler::sample(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const std::array<Corner, 4> corner = corners(fixed);
    float rest = u.z;
    std::size_t chosen = 0;
    while (chosen < 3 && rest >= corner[chosen].weight)
        rest -= corner[chosen++].weight;
    const auto &table = density_[static_cast<std::size_t>(corner[chosen].index)];
    return direction_of_disk(disk_of_square(table.sample({u.x, u.y}).point));
}

float DirectionSampler::pdf(const glm::vec3 &fixed, const glm::vec3 &drawn) const {
    const glm::vec2 point = square_of_disk(disk_of_direction(drawn));
    float sum = 0;
    for (const Corner &c : corners(fixed))
        sum += c.weight * density_[static_cast<std::size_t>(c.index)].density(point);
    return sum / (2 * kPiF);
}

} // namespace tsuya
