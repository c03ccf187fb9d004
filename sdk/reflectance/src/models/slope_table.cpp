#include "tsuya/sdk/detail/slope_table.h"

#include <tbb/parallel_for.h>

#include "models/slope_lobes.h"
#include "views/stop.h"

namespace tsuya {
namespace {

// Nodes of a quarter turn: so many in a roughness at the pole, where the nodes are closest
constexpr double kNodesOfRoughness = 7;
constexpr int kLeastNodes = 96, kMostNodes = 800; // of all turns: 0.5 MB

int nodes_of(double roughness, bool mirrored) {
    const double quarter = kNodesOfRoughness / roughness;
    return std::clamp(static_cast<int>(mirrored ? quarter : 2 * quarter), kLeastNodes, kMostNodes);
}

} // namespace

SlopeTable::SlopeTable(const YarnLobes &lobes, bool mirrored, const Progress &progress)
    : mirrored_(mirrored), nodes_(nodes_of(lobes.roughness, mirrored)), columns_(nodes_ + 2) {
    for (auto &table : value_)
        table.resize(static_cast<std::size_t>(columns_ * (kRows + 2)));
    const SlopeLobes shapes(lobes.roughness);
    // Nodes beyond an end have what the function has there: D is the same at the opposite of a
    // point
    tbb::parallel_for(-1, kRows + 1, [&](int j) {
        stop_if_asked(progress);
        const double root = static_cast<double>(j) / (kRows - 1), radius = root * root;
        for (int i = -1; i <= nodes_; ++i) {
            const double x = static_cast<double>(i) / (nodes_ - 1);
            const double turn = mirrored_ ? x : 2 * x - 1;
            const glm::dvec2 part = radius * glm::normalize(glm::dvec2(turn, 1 - std::abs(turn)));
            for (std::size_t axis = 0; axis < 2; ++axis)
                value_[axis][static_cast<std::size_t>((j + 1) * columns_ + i + 1)] =
                    static_cast<float>(shapes.of_system(lobes, axis, part.x, part.y));
        }
    });
}

} // namespace tsuya
