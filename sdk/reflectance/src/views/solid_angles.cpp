#include "tsuya/sdk/accuracy.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "views/lights.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr int kRings = 360;            // of the counting grid: a quarter of a degree
constexpr double kSameAngle = 1e-9;    // radians, against rounding
constexpr double kKeptLight = 1e-6;    // a mirror image as near as this is the light itself
constexpr int kLeastPointsOfRing = 48; // about the pole

struct Node {
    glm::dvec3 direction;
    std::size_t owner;
};

// Lambert's equal-area map of the hemisphere to the unit disk. Lengths on the disk are 1/2 to 1 of
// those on the sphere.
glm::dvec2 disk_of(const glm::dvec3 &d) {
    return glm::dvec2(d) / std::sqrt(1 + std::max(d.z, 0.0));
}

// Signs of x and y under the operations of a symmetry that leave the light where it is.
std::vector<glm::dvec3> kept_mirrors(const glm::dvec3 &to_light, Symmetry symmetry) {
    std::vector<glm::dvec3> all = {{1, 1, 1}};
    if (symmetry != Symmetry::none)
        all.push_back({-1, -1, 1});
    if (symmetry == Symmetry::orthotropic)
        all.insert(all.end(), {{1, -1, 1}, {-1, 1, 1}});
    std::erase_if(all, [&](const glm::dvec3 &mirror) {
        return glm::distance(mirror * to_light, to_light) > kKeptLight;
    });
    return all;
}

// Nodes in square cells of the disk, to find the nearest of a direction among few.
class NodeGrid {
  public:
    NodeGrid(std::span<const glm::dvec3> to_viewer, const std::vector<glm::dvec3> &mirrors) {
        const double count = static_cast<double>(to_viewer.size() * mirrors.size());
        side_ = std::clamp(static_cast<int>(std::sqrt(count)), 1, 256);
        cells_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
        for (std::size_t i = 0; i < to_viewer.size(); ++i)
            for (const glm::dvec3 &mirror : mirrors) {
                const glm::dvec3 d = mirror * to_viewer[i];
                const glm::ivec2 at = cell_of(disk_of(d));
                cell(at.x, at.y).push_back({d, i});
            }
    }

    // The owners of the nodes at the least distance from a direction; there are several where nodes
    // coincide. Looks at squares of cells about the direction until all others are too far.
    void find_nearest(const glm::dvec3 &d, std::vector<std::size_t> &nearest) const {
        const glm::dvec2 p = disk_of(d);
        const glm::ivec2 middle = cell_of(p);
        double best = -2; // cosine of the nearest so far
        nearest.clear();
        for (int ring = 0; ring <= side_ && is_near(ring, best); ++ring)
            visit_ring(middle, ring, [&](const Node &node) {
                const double cosine = glm::dot(node.direction, d);
                if (cosine > best + kSameCosine) {
                    best = cosine;
                    nearest.clear();
                }
                if (cosine >= best - kSameCosine)
                    nearest.push_back(node.owner);
            });
    }

  private:
    static constexpr double kSameCosine = 1e-15; // rounding

    // A ring of cells may hold a node as near as the one found, for lengths on the disk are no
    // longer than on the sphere.
    bool is_near(int ring, double best) const {
        return best < -1 || (ring - 1) * 2.0 / side_ <= std::acos(std::min(best, 1.0)) + kSameAngle;
    }

    glm::ivec2 cell_of(const glm::dvec2 &p) const {
        const auto one = [&](double x) {
            return std::clamp(static_cast<int>((x + 1) / 2 * side_), 0, side_ - 1);
        };
        return {one(p.x), one(p.y)};
    }
    std::vector<Node> &cell(int x, int y) {
        return cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(side_) +
                      static_cast<std::size_t>(x)];
    }

    // The nodes of the cells on the border of a square of 2 ring + 1 cells.
    template <class Visit> void visit_ring(const glm::ivec2 &middle, int ring, Visit visit) const {
        const int low = std::max(middle.y - ring, 0), high = std::min(middle.y + ring, side_ - 1);
        for (int y = low; y <= high; ++y) {
            const bool whole = std::abs(y - middle.y) == ring;
            for (int x = middle.x - ring; x <= middle.x + ring; x += whole ? 1 : 2 * ring)
                if (x >= 0 && x < side_)
                    for (const Node &node : cells_[static_cast<std::size_t>(y * side_ + x)])
                        visit(node);
        }
    }

    int side_ = 1;
    std::vector<std::vector<Node>> cells_{};
};

// What the solid angles of a light's views depend on.
struct Question {
    std::vector<glm::dvec3> to_viewer, mirrors;
    bool operator==(const Question &other) const {
        return to_viewer == other.to_viewer && mirrors == other.mirrors;
    }
};

} // namespace

std::vector<double> solid_angles(std::span<const glm::dvec3> to_viewer, const glm::dvec3 &to_light,
                                 Symmetry symmetry) {
    const NodeGrid nodes(to_viewer, kept_mirrors(to_light, symmetry));
    std::vector<double> area(to_viewer.size(), 0.0);
    std::vector<std::size_t> nearest;
    constexpr double kStep = 0.5 * kPi / kRings;
    for (int ring = 0; ring < kRings; ++ring) {
        const double theta = (ring + 0.5) * kStep, sine = std::sin(theta), cosine = std::cos(theta);
        const int points = 4 * std::max(kLeastPointsOfRing / 4, static_cast<int>(kRings * sine));
        const double share =
            (std::cos(ring * kStep) - std::cos((ring + 1) * kStep)) * 2 * kPi / points;
        for (int i = 0; i < points; ++i) {
            const double phi = (i + 0.5) * 2 * kPi / points;
            nodes.find_nearest({sine * std::cos(phi), sine * std::sin(phi), cosine}, nearest);
            for (const std::size_t owner : nearest)
                area[owner] += share / static_cast<double>(nearest.size());
        }
    }
    return area;
}

std::vector<std::vector<double>>
solid_angles_by_light(const std::vector<std::vector<ReflectanceRow>> &lights, Symmetry symmetry,
                      const Progress &progress) {
    std::vector<Question> questions;
    std::vector<std::size_t> first, question_of; // first light of a question; question of a light
    for (std::size_t i = 0; i < lights.size(); ++i) {
        Question question{views_of(lights[i]), kept_mirrors(lights[i][0].to_light(), symmetry)};
        const auto known = std::ranges::find(questions, question);
        question_of.push_back(static_cast<std::size_t>(known - questions.begin()));
        if (known != questions.end())
            continue;
        questions.push_back(std::move(question));
        first.push_back(i);
    }
    std::vector<std::vector<double>> answers(questions.size());
    tbb::parallel_for(std::size_t{0}, questions.size(), [&](std::size_t q) {
        stop_if_asked(progress);
        answers[q] = solid_angles(questions[q].to_viewer, lights[first[q]][0].to_light(), symmetry);
    });
    std::vector<std::vector<double>> result;
    for (const std::size_t q : question_of)
        result.push_back(answers[q]);
    return result;
}

} // namespace tsuya
