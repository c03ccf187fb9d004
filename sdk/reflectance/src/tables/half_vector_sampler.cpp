#include "tsuya/sdk/detail/half_vector_sampler.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "tables/azimuth.h"
#include "tables/disk.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr int kBlocks = 24; // along the square of half vectors
constexpr int kRows = 18;   // of fixed directions
// Of fixed directions: 15 degrees where the model is mirrored, else 30
constexpr int kColumnsOfQuarter = 6, kFullColumnsOfQuarter = 3;
constexpr float kLowest = 1e-5f; // cosine that stands for the horizon itself
constexpr int kFine = 2;         // along a cell, where its mass is summed
// Along a block, where the model is asked; more of them for the fixed directions at grazing, in
// whose rows of the table the horizon hides most of many blocks
constexpr int kProbes = 2, kGrazingProbes = 4, kGrazingRows = 4;
constexpr float kEvenShare = 0.02f;      // of the mass of a cell: keeps it above 0
constexpr float kLeastEvenDraws = 0.02f; // over the hemisphere: so that nothing is left out

// Rows of fixed directions lie evenly in the mean of sqrt(1 - cos theta) and 1 - sqrt(cos theta):
// about evenly in theta, and closer towards the horizon.
float row_of(float z) {
    return 0.5f * (kRows - 1) * (std::sqrt(std::max(1 - z, 0.0f)) + 1 - std::sqrt(z));
}

float cosine_of_row(int row) {
    float low = kLowest, high = 1;
    for (int i = 0; i < 30; ++i) {
        const float z = 0.5f * (low + high);
        (row_of(z) > static_cast<float>(row) ? low : high) = z;
    }
    return row < kRows - 1 ? low : kLowest;
}

} // namespace

HalfVectorSampler::HalfVectorSampler(bool mirrored, const Facets &facets, const Model &model,
                                     float even)
    : mirrored_(mirrored), columns_(mirrored ? kColumnsOfQuarter + 1 : 4 * kFullColumnsOfQuarter),
      blocks_(static_cast<std::size_t>(kBlocks * kBlocks)),
      nodes_(static_cast<std::size_t>(kRows * columns_)) {
    tabulate_blocks(facets);
    tbb::parallel_for(0, kRows * columns_, [&](int k) {
        nodes_[static_cast<std::size_t>(k)] =
            tabulate(model, even, fixed_direction(k),
                     k / columns_ < kRows - kGrazingRows ? kProbes : kGrazingProbes);
    });
}

// What mirrors a direction into the first quadrant, where that changes nothing.
glm::vec2 HalfVectorSampler::sign_of(const glm::vec3 &fixed) const {
    return mirrored_ ? glm::vec2(std::copysign(1.0f, fixed.x), std::copysign(1.0f, fixed.y))
                     : glm::vec2(1);
}

glm::vec3 HalfVectorSampler::fixed_direction(int index) const {
    const float z = cosine_of_row(index / columns_);
    const int of_quarter = mirrored_ ? kColumnsOfQuarter : kFullColumnsOfQuarter;
    const float quarter = static_cast<float>(index % columns_) / static_cast<float>(of_quarter);
    return {azimuth_of(quarter) * std::sqrt(1 - z * z), z};
}

// The square keeps areas of the disk of the horizontal part of H.
void HalfVectorSampler::tabulate_blocks(const Facets &facets) {
    constexpr int kCells = kBlocks * kParts;
    std::vector<float> mass(static_cast<std::size_t>(kCells * kCells));
    tbb::parallel_for(0, kCells, [&](int j) {
        for (int i = 0; i < kCells; ++i) {
            float sum = 0;
            for (int k = 0; k < kFine * kFine; ++k) {
                const glm::vec2 part = (glm::vec2(k % kFine, k / kFine) + 0.5f) / float(kFine);
                const glm::vec2 p = disk_of_square((glm::vec2(i, j) + part) / float(kCells));
                sum += facets({p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f))});
            }
            mass[static_cast<std::size_t>(j * kCells + i)] = sum / (kFine * kFine);
        }
    });
    double total = 0;
    for (const float m : mass)
        total += m;
    const auto even = static_cast<float>(total > 0 ? kEvenShare * total / (kCells * kCells) : 1.0);
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const std::size_t left = b % kBlocks * kParts, top = b / kBlocks * kParts;
        Block &block = blocks_[b];
        float sum = 0;
        for (std::size_t j = 0; j < kParts; ++j) {
            float row = 0;
            for (std::size_t i = 0; i < kParts; ++i) {
                block.density[j][i] = mass[(top + j) * kCells + left + i] + even;
                block.column_cdf[j][i] = row += block.density[j][i];
            }
            for (float &c : block.column_cdf[j])
                c /= row;
            block.row_cdf[j] = sum += row;
        }
        for (std::size_t j = 0; j < kParts; ++j) {
            block.row_cdf[j] /= sum;
            for (float &d : block.density[j])
                d *= kParts * kParts / sum;
        }
    }
}

// A block has what the model makes of it at the probes.
HalfVectorSampler::Node HalfVectorSampler::tabulate(const Model &model, float even,
                                                    const glm::vec3 &fixed, int probes) const {
    double total = 0;
    std::vector<double> mass(blocks_.size());
    for (std::size_t b = 0; b < mass.size(); ++b)
        for (int k = 0; k < probes * probes; ++k) {
            const glm::vec2 u =
                glm::vec2(b % kBlocks, b / kBlocks) +
                (glm::vec2(k % probes, k / probes) + 0.5f) / static_cast<float>(probes);
            const glm::vec2 p = disk_of_square(u / float(kBlocks));
            const glm::vec3 half(p, std::sqrt(std::max(1 - glm::dot(p, p), 1e-12f)));
            const float cosine = glm::dot(fixed, half);
            const glm::vec3 drawn = 2 * cosine * half - fixed;
            // dL = 4 V.H dH, and the disk has the area element N.H dH
            if (cosine > 0 && drawn.z > 0)
                mass[b] += model(fixed, drawn) * cosine / half.z;
        }
    for (const double m : mass)
        total += m;
    const double seen = total * 4 * kPiF / (kBlocks * kBlocks * probes * probes);
    const auto share = static_cast<float>(even / std::max(even + seen, 1e-30));
    return {{mass, kBlocks, kBlocks}, std::max(share, kLeastEvenDraws)};
}

std::array<HalfVectorSampler::Corner, 4> HalfVectorSampler::corners(const glm::vec3 &fixed) const {
    const float y = row_of(fixed.z);
    const float x =
        quarters(fixed) * static_cast<float>(mirrored_ ? kColumnsOfQuarter : kFullColumnsOfQuarter);
    const int j = std::min(static_cast<int>(y), kRows - 2);
    const int i = std::min(static_cast<int>(x), mirrored_ ? columns_ - 2 : columns_ - 1);
    const int next = i + 1 < columns_ ? i + 1 : 0;
    const float t = std::min(y - static_cast<float>(j), 1.0f);
    const float s = std::min(x - static_cast<float>(i), 1.0f);
    const int row = j * columns_;
    return {{{row + i, (1 - t) * (1 - s)},
             {row + next, (1 - t) * s},
             {row + columns_ + i, t * (1 - s)},
             {row + columns_ + next, t * s}}};
}

glm::vec2 HalfVectorSampler::Block::point(const glm::vec2 &u) const {
    const auto invert = [](const std::array<float, kParts> &cdf, float x) {
        std::size_t k = 0;
        for (std::size_t i = 0; i + 1 < kParts; ++i)
            k += x >= cdf[i] ? 1 : 0;
        const float from = k > 0 ? cdf[k - 1] : 0.0f, width = cdf[k] - from;
        const float offset = width > 0 ? std::clamp((x - from) / width, 0.0f, 1.0f) : 0.5f;
        return std::pair(k, (static_cast<float>(k) + offset) / kParts);
    };
    const auto [row, y] = invert(row_cdf, u.y);
    return {invert(column_cdf[row], u.x).second, y};
}

// The third coordinate picks the way. Zero where the facet looks away.
glm::vec3 HalfVectorSampler::draw(const Node &node, const glm::vec3 &fixed,
                                  const glm::vec3 &u) const {
    if (u.z < node.even_draws) {
        const glm::vec2 p = disk_of_square({u.x, u.y});
        return {p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f))};
    }
    const glm::vec2 at = node.blocks.sample({u.x, u.y}).point * float(kBlocks);
    const glm::ivec2 cell = glm::min(glm::ivec2(at), glm::ivec2(kBlocks - 1));
    const Block &block = blocks_[static_cast<std::size_t>(cell.y * kBlocks + cell.x)];
    const glm::vec2 start(cell),
        p = disk_of_square((start + block.point(at - start)) / float(kBlocks));
    const glm::vec3 half(p, std::sqrt(std::max(1 - glm::dot(p, p), 0.0f)));
    const float facing = glm::dot(fixed, half);
    return facing > 0 ? 2 * facing * half - fixed : glm::vec3(0);
}

glm::vec3 HalfVectorSampler::sample(const glm::vec3 &fixed, const glm::vec3 &u) const {
    const glm::vec2 sign = sign_of(fixed);
    const glm::vec3 folded(sign * glm::vec2(fixed), fixed.z);
    const std::array<Corner, 4> corner = corners(folded);
    // Branch-free: these branches are unpredictable
    std::size_t k = 0;
    float before = 0, sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        sum += corner[i].weight;
        const bool beyond = u.z >= sum;
        k += beyond ? 1 : 0;
        before = beyond ? sum : before;
    }
    const float way =
        std::clamp((u.z - before) / std::max(corner[k].weight, 1e-9f), 0.0f, 0x1.fffffep-1f);
    const glm::vec3 drawn =
        draw(nodes_[static_cast<std::size_t>(corner[k].index)], folded, {u.x, u.y, way});
    return {sign * glm::vec2(drawn), drawn.z};
}

float HalfVectorSampler::pdf(const glm::vec3 &fixed, const glm::vec3 &half, float facing,
                             float drawn_cosine) const {
    const glm::vec2 sign = sign_of(fixed);
    const glm::vec2 square = square_of_disk(sign * glm::vec2(half));
    // A square counted in cells; beyond its edge by rounding is in the last
    const auto cell_of = [](float x) {
        const int cell = static_cast<int>(x * (kBlocks * kParts));
        return static_cast<std::size_t>(std::clamp(cell, 0, kBlocks * kParts - 1));
    };
    const std::size_t column = cell_of(square.x), row = cell_of(square.y);
    float of_block = 0, even = 0;
    for (const Corner &c : corners({sign * glm::vec2(fixed), fixed.z})) {
        const Node &node = nodes_[static_cast<std::size_t>(c.index)];
        of_block += c.weight * (1 - node.even_draws) *
                    node.blocks.density_of(row / kParts, column / kParts);
        even += c.weight * node.even_draws;
    }
    const float within =
        blocks_[row / kParts * kBlocks + column / kParts].density[row % kParts][column % kParts];
    // dH/dL = 1 / (4 V.H); the disk of the horizontal part of H has the area element N.H dH
    return (of_block * within * std::max(half.z, 0.0f) / (4 * facing) + even * drawn_cosine) / kPiF;
}

std::size_t HalfVectorSampler::bytes() const {
    std::size_t sum = blocks_.size() * sizeof(Block);
    for (const Node &node : nodes_)
        sum += sizeof(Node) + node.blocks.bytes();
    return sum;
}

} // namespace tsuya
