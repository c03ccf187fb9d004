#include "tsuya/sdk/yarn_lobes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/Dense>

#include "facets.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/yarn_optics.h"

namespace tsuya {
namespace {

constexpr double kPi = std::numbers::pi;
const glm::vec3 kUp(0, 0, 1); // to the light
constexpr double kStep = 2 * kPi / 180;
constexpr int kMiddle = kYarnSlopes / 2;
constexpr std::array<double, 6> kRoughness = {0.03, 0.045, 0.06, 0.08, 0.1, 0.13};
// What holds the slopes where the views do not: their second differences, and a preference for
// gentle ones, (slope / 45 degrees)^6
constexpr double kBending = 1e-3, kSteepness = 0.02;
constexpr int kSteepnessPower = 6;
constexpr int kIterations = 500, kRounds = 3;
// A system with less than this share of the face lies in pits; at the second share, in the deepest
constexpr double kPitShare = 0.42, kDeepestShare = 0.22, kDeepest = 0.3;

// The problem min |B x - f|^2 + bending + steepness over x >= 0 for one roughness. Unknown are the
// surfaces at the slopes of weft and warp and the even part; a symmetric cloth has as much at a
// slope as at its opposite.
class Fit {
  public:
    Fit(const Bard &bard, double f0);
    /// Returns the weighted relative error; sets the surfaces, pits and even part.
    double solve(YarnLobes &lobes) const;

  private:
    struct View {
        glm::vec3 direction;
        double value, weight;
        YarnHalf half;
    };
    int unknowns_of_system() const { return symmetric_ ? kMiddle + 1 : kYarnSlopes; }
    double slope(int unknown) const { return (symmetric_ ? unknown : unknown - kMiddle) * kStep; }
    Eigen::MatrixXd lobes_of_views(double roughness) const;
    Eigen::MatrixXd basis(const Eigen::MatrixXd &lobes, const std::array<double, 2> &pit) const;
    Eigen::MatrixXd bending() const;
    void store(const Eigen::VectorXd &x, YarnLobes &lobes) const;

    bool symmetric_;
    YarnOptics optics_;
    std::vector<View> views_{};
    Eigen::VectorXd target_{}; // root of the weight times the value
    double square_ = 0;
};

Fit::Fit(const Bard &bard, double f0)
    : symmetric_(bard.symmetry() != Symmetry::none), optics_(checked_f0(f0)) {
    std::vector<glm::dvec3> directions;
    for (const BardView &v : bard.views())
        directions.emplace_back(std::sin(v.theta) * std::cos(v.phi),
                                std::sin(v.theta) * std::sin(v.phi), std::cos(v.theta));
    const std::vector<double> area = solid_angles(directions, {0, 0, 1}, bard.symmetry());
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const double z = std::max(directions[i].z, 1e-4); // a view on the horizon weighs nothing
        const glm::vec3 d(directions[i].x, directions[i].y, z);
        views_.push_back(
            {d, bard.views()[i].brdf_per_sr, std::sqrt(area[i]) * z, optics_.half(kUp, d)});
    }
    target_.resize(static_cast<Eigen::Index>(views_.size()));
    for (std::size_t i = 0; i < views_.size(); ++i)
        target_[static_cast<Eigen::Index>(i)] = views_[i].weight * views_[i].value;
    square_ = std::max(target_.squaredNorm(), std::numeric_limits<double>::min());
}

// A row a view: what the lobe of each unknown has there.
Eigen::MatrixXd Fit::lobes_of_views(double roughness) const {
    const int count = unknowns_of_system();
    Eigen::MatrixXd b(target_.size(), 2 * count);
    for (Eigen::Index i = 0; i < b.rows(); ++i)
        for (int k = 0; k < 2 * count; ++k) {
            const glm::dvec3 half = views_[static_cast<std::size_t>(i)].half.half;
            const int axis = k / count;
            const double s = slope(k % count);
            b(i, k) = yarn_lobe(axis, s, roughness, half);
            if (symmetric_ && s > 0)
                b(i, k) = 0.5 * (b(i, k) + yarn_lobe(axis, -s, roughness, half));
        }
    return b;
}

// The same times what reaches the view; the last column is the even part.
Eigen::MatrixXd Fit::basis(const Eigen::MatrixXd &lobes, const std::array<double, 2> &pit) const {
    const int count = unknowns_of_system();
    Eigen::MatrixXd b(lobes.rows(), lobes.cols() + 1);
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
        const View &view = views_[static_cast<std::size_t>(i)];
        const std::array<YarnReach, 2> reach = {
            optics_.reach<0>(static_cast<float>(pit[0]), view.half, kUp, view.direction),
            optics_.reach<1>(static_cast<float>(pit[1]), view.half, kUp, view.direction)};
        const float open = 1 / view.direction.z;
        for (int axis = 0; axis < 2; ++axis) {
            const double value =
                view.weight * reach[static_cast<std::size_t>(axis)].times_cosine(open, open);
            b.row(i).segment(axis * count, count) =
                value * lobes.row(i).segment(axis * count, count);
        }
        b(i, 2 * count) = view.weight / kPi;
    }
    return b;
}

Eigen::MatrixXd Fit::bending() const {
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

// Least of x'Ax/2 - b'x over x >= 0 by the multiplicative updates of [Sha]; a is symmetric.
Eigen::VectorXd least_positive(const Eigen::MatrixXd &a, const Eigen::VectorXd &b, double start) {
    const Eigen::MatrixXd plus = a.cwiseMax(0), minus = (-a).cwiseMax(0);
    Eigen::ArrayXd x = Eigen::ArrayXd::Constant(b.size(), start);
    for (int i = 0; i < kIterations; ++i) {
        const Eigen::ArrayXd up = plus * x.matrix(), down = minus * x.matrix();
        x *= (b.array() + (b.array().square() + 4 * up * down).sqrt()) /
             (2 * up).max(std::numeric_limits<double>::min());
    }
    return x;
}

double pit_of(double share) {
    return kDeepest * std::clamp((kPitShare - share) / (kPitShare - kDeepestShare), 0.0, 1.0);
}

void Fit::store(const Eigen::VectorXd &x, YarnLobes &lobes) const {
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
    lobes.even = x[2 * count];
    const double weft = x.head(count).sum(), both = x.head(2 * count).sum();
    const double share = both > 0 ? weft / both : 0.5;
    lobes.pit = {pit_of(share), pit_of(1 - share)};
}

double Fit::solve(YarnLobes &lobes) const {
    const Eigen::MatrixXd shapes = lobes_of_views(lobes.roughness);
    const int count = unknowns_of_system();
    double error = 0;
    lobes.pit = {0, 0};
    for (int round = 0; round < kRounds; ++round) {
        const Eigen::MatrixXd b = basis(shapes, lobes.pit);
        Eigen::MatrixXd a = b.transpose() * b / square_;
        Eigen::VectorXd linear = b.transpose() * target_ / square_;
        const double scale =
            std::max(a.diagonal().head(2 * count).mean(), std::numeric_limits<double>::min());
        a += kBending * scale * bending();
        for (int k = 0; k < 2 * count; ++k)
            linear[k] -= kSteepness * std::sqrt(scale) *
                         std::pow(slope(k % count) / (kPi / 4), kSteepnessPower);
        const Eigen::VectorXd x = least_positive(a, linear, 1 / (std::sqrt(scale) * count));
        store(x, lobes);
        error = (b * x - target_).norm() / std::sqrt(square_);
    }
    return error;
}

} // namespace

double yarn_slope(int k) { return (k - kMiddle) * kStep; }

double yarn_lobe(int axis, double slope, double roughness, const glm::dvec3 &half) {
    // Angle of the half vector with the plane of the cylinder's normals
    const double sine = half[axis] * std::cos(slope) + half.z * std::sin(slope);
    const double angle = std::asin(std::clamp(sine, -1.0, 1.0)) / roughness;
    return std::exp(-0.5 * angle * angle) / (std::sqrt(2 * kPi) * roughness * kPi);
}

YarnLobes fit_yarn_lobes(const Bard &bard, double f0) {
    YarnLobes best{.f0 = checked_f0(f0)};
    if (!(bard.peak() > 0))
        return best; // black: nothing is on any slope
    const Fit fit(bard, f0);
    double least = std::numeric_limits<double>::infinity();
    for (const double roughness : kRoughness) {
        YarnLobes lobes{.f0 = f0, .roughness = roughness};
        if (const double error = fit.solve(lobes); error < least) {
            least = error;
            best = lobes;
        }
    }
    return best;
}

} // namespace tsuya
