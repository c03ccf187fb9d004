#include "models/yarn_problem.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "models/facets.h"
#include "models/least_positive.h"
#include "models/slope_lobes.h"

namespace tsuya {
namespace {

constexpr int kMiddle = kYarnSlopes / 2;
// What holds the slopes where the views do not: their second differences, and a preference for
// gentle ones, (slope / 45 degrees)^6
constexpr double kBending = 1e-3, kSteepness = 0.02;
constexpr int kSteepnessPower = 6;
constexpr int kRounds = 3;
// Of the search: slopes that the views do not tell apart stay as even as they start. Where it
// starts from a neighbour's solution, few are left to do
constexpr int kFirstUpdates = 500, kNextUpdates = 120;
// A system with less than this share of the face lies in pits; at the second share, in the deepest
constexpr double kPitShare = 0.42, kDeepestShare = 0.22, kDeepest = 0.2;

double pit_of(double share) {
    return kDeepest * std::clamp((kPitShare - share) / (kPitShare - kDeepestShare), 0.0, 1.0);
}

} // namespace

double total(const std::array<double, kYarnSlopes> &surface) {
    return std::accumulate(surface.begin(), surface.end(), 0.0);
}

int YarnProblem::unknowns_of_system() const { return symmetric_ ? kMiddle + 1 : kYarnSlopes; }

std::size_t YarnProblem::index(int unknown) const {
    return static_cast<std::size_t>(symmetric_ ? kMiddle + unknown : unknown);
}

YarnProblem::YarnProblem(const Bard &bard, double f0, const Progress &progress)
    : progress_(progress), symmetric_(bard.symmetry() != Symmetry::none), f0_(checked_f0(f0)) {
    std::vector<ReflectanceRow> rows;
    for (const BardView &v : bard.views())
        rows.push_back({0, 0, v.theta, v.phi, v.brdf_per_sr, v.sigma_per_sr});
    LitViews above({0, 0, 1}, rows, bard.symmetry());
    worth_above_ = above.worth();
    above.forget_sigma(); // so that they tell the same as without oblique ones
    add_light(above, 1);
    above_ = target_.size();
}

// Views under one light, with `share` of the weight.
void YarnProblem::add_light(const LitViews &lit, double share) {
    double square = 0;
    for (const LitView &view : lit.views) {
        views_.push_back({glm::vec3(lit.to_light), glm::vec3(view.to_viewer), view.value,
                          std::sqrt(view.solid_angle * view.trust) * view.to_viewer.z});
        square += std::pow(views_.back().weight * views_.back().value, 2);
    }
    square = std::max(square, std::numeric_limits<double>::min());
    const auto first = static_cast<Eigen::Index>(views_.size() - lit.views.size());
    target_.conservativeResize(static_cast<Eigen::Index>(views_.size()));
    for (Eigen::Index i = first; i < target_.size(); ++i) {
        FittedView &view = views_[static_cast<std::size_t>(i)];
        view.weight *= std::sqrt(share / square);
        target_[i] = view.weight * view.value;
    }
}

void YarnProblem::add(const LitViews &oblique) {
    add_light(oblique,
              oblique.worth() / std::max(worth_above_, std::numeric_limits<double>::min()));
}

Seen YarnProblem::seen(double roughness) const {
    stop_if_asked(progress_);
    Seen made;
    const YarnOptics optics(f0_, roughness);
    const SlopeLobes shapes(roughness);
    const int count = unknowns_of_system();
    made.lobes.resize(target_.size(), both_systems());
    for (Eigen::Index i = 0; i < target_.size(); ++i) {
        const FittedView &view = views_[static_cast<std::size_t>(i)];
        const glm::vec3 &l = view.to_light, &v = view.to_viewer;
        const YarnHalf both = optics.half(l, v);
        const glm::dvec3 half = both.half;
        made.views.push_back({both.half, YarnSpan(l, v),
                              view.weight / l.z * glm::dvec2(optics.reach(both, l, v)),
                              view.weight / (2 * kPi) * both.fresnel / (l.z + v.z)});
        for (int k = 0; k < 2 * count; ++k) {
            const double along = half[k / count];
            const int at = static_cast<int>(index(k % count));
            double &lobe = made.lobes(i, k);
            lobe = shapes.at(at, along, half.z);
            if (symmetric_ && at != kMiddle)
                lobe = 0.5 * (lobe + shapes.at(2 * kMiddle - at, along, half.z));
        }
    }
    return made;
}

// The lobes times what light and viewer reach; the last column is the rest.
Eigen::MatrixXd YarnProblem::basis(const Seen &seen, const YarnLobes &lobes, Rest rest) const {
    const int count = unknowns_of_system();
    const YarnDepth depth(lobes);
    Eigen::MatrixXd b(seen.lobes.rows(), 2 * count + 1);
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
        const SeenView &view = seen.views[static_cast<std::size_t>(i)];
        const glm::dvec2 value = view.reach * glm::dvec2(depth.in_sight(view.half, view.span));
        for (int axis = 0; axis < 2; ++axis)
            b.row(i).segment(Eigen::Index{axis} * count, count) =
                value[axis] * seen.lobes.row(i).segment(Eigen::Index{axis} * count, count);
        b(i, both_systems()) =
            rest == Rest::even ? views_[static_cast<std::size_t>(i)].weight / kPi : view.loose;
    }
    return b;
}

Eigen::MatrixXd YarnProblem::bending() const {
    const int count = unknowns_of_system();
    Eigen::MatrixXd r = Eigen::MatrixXd::Zero(2 * count + 1, 2 * count + 1);
    for (int axis = 0; axis < 2; ++axis)
        for (int k = 0; k < count; ++k) {
            Eigen::VectorXd v = Eigen::VectorXd::Zero(r.rows());
            v[axis * count + k] = -2;
            const int below = k > 0 ? k - 1 : symmetric_ ? 1 : -1;
            if (below >= 0)
                v[axis * count + below] += 1;
            if (k + 1 < count)
                v[axis * count + k + 1] += 1;
            r += v * v.transpose();
        }
    return r;
}

void YarnProblem::store(const Eigen::VectorXd &x, Rest rest, YarnLobes &lobes) const {
    const int count = unknowns_of_system();
    for (int axis = 0; axis < 2; ++axis) {
        auto &surface = lobes.surface[static_cast<std::size_t>(axis)];
        surface.fill(0);
        for (int k = 0; k < count; ++k) {
            const double value = x[axis * count + k];
            if (!symmetric_ || k == 0)
                surface[static_cast<std::size_t>(symmetric_ ? kMiddle : k)] = value;
            else
                surface[static_cast<std::size_t>(kMiddle + k)] =
                    surface[static_cast<std::size_t>(kMiddle - k)] = 0.5 * value;
        }
    }
    lobes.loose = rest == Rest::loose ? x[both_systems()] : 0;
    lobes.even = rest == Rest::even ? x[both_systems()] : 0;
}

double YarnProblem::solve(const Seen &seen, YarnLobes &lobes, Rest rest, Eigen::VectorXd &x,
                          double least_even) const {
    stop_if_asked(progress_);
    const int count = unknowns_of_system();
    const Eigen::MatrixXd b = basis(seen, lobes, rest);
    Eigen::MatrixXd a = b.transpose() * b;
    const Eigen::VectorXd target = target_ - least_even * b.col(both_systems());
    Eigen::VectorXd linear = b.transpose() * target;
    const double scale =
        std::max(b.topLeftCorner(above_, both_systems()).squaredNorm() / (2 * count),
                 std::numeric_limits<double>::min());
    a += kBending * scale * bending();
    for (int k = 0; k < 2 * count; ++k)
        linear[k] -=
            kSteepness * std::sqrt(scale) * std::pow(slope(k % count) / (kPi / 4), kSteepnessPower);
    const bool first = x.size() == 0;
    if (first)
        x = Eigen::VectorXd::Constant(linear.size(), 1 / (std::sqrt(scale) * count));
    x = least_positive(a, linear, x, first ? kFirstUpdates : kNextUpdates,
                       {{0, count, kFullCover}, {count, count, kFullCover}});
    store(x, rest, lobes);
    lobes.even += least_even;
    return (b * x - target).norm();
}

double YarnProblem::solve_with_pits(const Seen &seen, YarnLobes &lobes, Rest rest,
                                    Eigen::VectorXd &x) const {
    double error = 0;
    lobes.pit = {0, 0};
    for (int round = 0; round < kRounds; ++round) {
        error = solve(seen, lobes, rest, x);
        const double weft = total(lobes.surface[0]), warp = total(lobes.surface[1]);
        const double share = weft + warp > 0 ? weft / (weft + warp) : 0.5;
        lobes.pit = {pit_of(share), pit_of(1 - share)};
    }
    return error;
}

} // namespace tsuya
