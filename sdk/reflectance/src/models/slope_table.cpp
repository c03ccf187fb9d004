#include "tsuya/sdk/detail/slope_table.h"

#include <tbb/parallel_for.h>

#include "models/slope_lobes.h"
#include "views/stop.h"

namespace tsuya {
namespace {

// Nodes of a quarter turn: so many in a roughness at the pole, where the nodes are closest
constexpr double kNodesOfRoughness = 6;
constexpr int kLeastNodes = 96, kMostNodes = 800; // of all turns: 0.5 MB

int nodes_of(double roughness, bool mirrored) {
    const double quarter = kNodesOfRoughness / roughness;
    return std::clamp(static_cast<int>(mirrored ? quarter : 2 * quarter), kLeastNodes, kMostNodes);
}

// Values at nodes, [row][column] with one beyond each end, to coefficients.
void make_spline_surface(std::vector<double> &table, int rows, int columns, SplineEnd turn) {
    for (int j = 1; j + 1 < rows; ++j)
        make_spline(std::span(table).subspan(static_cast<std::size_t>(j * columns),
                                             static_cast<std::size_t>(columns)),
                    turn, turn);
    std::vector<double> line(static_cast<std::size_t>(rows));
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j)
            line[static_cast<std::size_t>(j)] = table[static_cast<std::size_t>(j * columns + i)];
        // At the axis across the yarn all turns are one
        make_spline(line, SplineEnd::mirrored, SplineEnd::smooth);
        for (int j = 0; j < rows; ++j)
            table[static_cast<std::size_t>(j * columns + i)] = line[static_cast<std::size_t>(j)];
    }
}

} // namespace

SlopeTable::SlopeTable(const YarnLobes &lobes, bool mirrored, const Progress &progress)
    : mirrored_(mirrored), nodes_(nodes_of(lobes.roughness, mirrored)), columns_(nodes_ + 2) {
    const SlopeLobes shapes(lobes.roughness);
    constexpr int kLines = kRows + 2;
    tbb::parallel_for(std::size_t{0}, std::size_t{2}, [&](std::size_t axis) {
        std::vector<double> table(static_cast<std::size_t>(columns_ * kLines));
        tbb::parallel_for(0, kRows, [&](int j) {
            stop_if_asked(progress);
            const double root = static_cast<double>(j) / (kRows - 1), radius = root * root;
            for (int i = 0; i < nodes_; ++i) {
                const double x = static_cast<double>(i) / (nodes_ - 1);
                const double turn = mirrored_ ? x : 2 * x - 1;
                const glm::dvec2 part =
                    radius * glm::normalize(glm::dvec2(turn, 1 - std::abs(turn)));
                table[static_cast<std::size_t>((j + 1) * columns_ + i + 1)] =
                    shapes.of_system(lobes, axis, part.x, part.y);
            }
        });
        make_spline_surface(table, kLines, columns_,
                            mirrored_ ? SplineEnd::mirrored : SplineEnd::round);
        value_[axis].assign(table.begin(), table.end());
        value_[axis].push_back(0); // four are read where three are used
    });
}

} // namespace tsuya
