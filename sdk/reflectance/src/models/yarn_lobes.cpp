#include "tsuya/sdk/yarn_lobes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Dense>

#include <tbb/parallel_for.h>

#include "models/facets.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/yarn_optics.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

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

// Depths of pits that views under oblique light choose from: a coarse mesh for every roughness,
// then around the best
constexpr std::array<double, 6> kDepths = {0, 0.05, 0.1, 0.2, 0.3, 0.45};
constexpr std::array<double, 2> kDepthSteps = {0.05, 0.025}; // a dozen views resolve no finer
// Least share of the diffuse part of views from above that a fit keeps: bright oblique views would
// trade it for slopes, and views on the side of the light would go dark
constexpr double kLeastEven = 0.5;
constexpr std::size_t kLeastOblique = 4;
constexpr double kLowest = 1e-4; // cosine; a view on the horizon weighs nothing

using LightAngles = std::pair<double, double>; // theta_i, phi_i

// The rows that no light from straight above belongs to, light by light.
std::map<LightAngles, std::vector<ReflectanceRow>> oblique_rows(const ReflectanceTable &table,
                                                                const std::string &where) {
    std::map<LightAngles, std::vector<ReflectanceRow>> lights;
    std::size_t count = 0;
    for (const ReflectanceRow &row : table.rows)
        if (!row.from_above()) {
            const double turn = 2 * kPi;
            lights[{row.theta_i, row.phi_i - turn * std::floor(row.phi_i / turn)}].push_back(row);
            ++count;
        }
    if (count < kLeastOblique)
        throw Error(
            {"the table has " + std::to_string(count) + " views under oblique light", where,
             "expected " + std::to_string(kLeastOblique) +
                 " or more rows with theta_i_deg above 0, such as 2 under each of 6 lights"});
    for (const auto &[angles, rows] : lights)
        if (std::none_of(rows.begin(), rows.end(),
                         [](const ReflectanceRow &row) { return row.brdf_per_sr > 0; }))
            throw Error({"the views under light at theta_i " +
                             std::to_string(std::lround(angles.first / kDegree)) + ", phi_i " +
                             std::to_string(std::lround(angles.second / kDegree)) +
                             " degrees are all 0",
                         where, "expected a value above 0 under every light"});
    return lights;
}

struct View {
    glm::vec3 to_light, to_viewer;
    double value, weight;
    YarnHalf half;
};

// The problem min |B x - f|^2 + bending + steepness over x >= 0 for one roughness. Unknown are the
// surfaces at the slopes of weft and warp and the diffuse part; a symmetric cloth has as much at a
// slope as at its opposite. The views under light from straight above have a weight of 1 together,
// those under oblique light, each direction of light alike, as well.
class Fit {
  public:
    Fit(const Bard &bard, double f0, const Progress &progress);
    /// Adds the oblique rows of the table. Throws Error naming `where`.
    void add_oblique(const ReflectanceTable &table, const std::string &where);
    /// What the lobes of all unknowns have at the views: a row a view.
    Eigen::MatrixXd shapes(double roughness) const;
    /// Returns the weighted relative error; sets the surfaces and the diffuse part, which is
    /// `least_even` or more.
    double solve(const Eigen::MatrixXd &shapes, YarnLobes &lobes, double least_even = 0) const;
    /// The same with the pits that follow from the shares of the systems.
    double solve_with_pits(const Eigen::MatrixXd &shapes, YarnLobes &lobes) const;

  private:
    int unknowns_of_system() const { return symmetric_ ? kMiddle + 1 : kYarnSlopes; }
    double slope(int unknown) const { return (symmetric_ ? unknown : unknown - kMiddle) * kStep; }
    void add_light(const glm::dvec3 &to_light, const std::vector<ReflectanceRow> &rows,
                   double share, Symmetry symmetry);
    Eigen::MatrixXd basis(const Eigen::MatrixXd &shapes, const std::array<double, 2> &pit) const;
    Eigen::MatrixXd bending() const;
    void store(const Eigen::VectorXd &x, YarnLobes &lobes) const;

    const Progress &progress_; // every step throws Interrupted
    bool symmetric_;
    YarnOptics optics_;
    std::vector<View> views_{};
    Eigen::Index above_ = 0;   // views under light from straight above, the first
    Eigen::VectorXd target_{}; // weight times the value
};

// A direction with a cosine that can be divided by.
glm::dvec3 raised(const glm::dvec3 &d) { return {d.x, d.y, std::max(d.z, kLowest)}; }

Fit::Fit(const Bard &bard, double f0, const Progress &progress)
    : progress_(progress), symmetric_(bard.symmetry() != Symmetry::none), optics_(checked_f0(f0)) {
    std::vector<ReflectanceRow> rows;
    for (const BardView &v : bard.views())
        rows.push_back({.theta_r = v.theta, .phi_r = v.phi, .brdf_per_sr = v.brdf_per_sr});
    add_light({0, 0, 1}, rows, 1, bard.symmetry());
    above_ = target_.size();
}

// Views under one light, weighted by solid angle and cosine, with `share` of the weight.
void Fit::add_light(const glm::dvec3 &to_light, const std::vector<ReflectanceRow> &rows,
                    double share, Symmetry symmetry) {
    std::vector<glm::dvec3> directions;
    for (const ReflectanceRow &row : rows)
        directions.push_back(raised(row.to_viewer()));
    const std::vector<double> area = solid_angles(directions, to_light, symmetry);
    double square = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const glm::vec3 light(to_light), viewer(directions[i]);
        views_.push_back({light, viewer, rows[i].brdf_per_sr, std::sqrt(area[i]) * directions[i].z,
                          optics_.half(light, viewer)});
        square += std::pow(views_.back().weight * views_.back().value, 2);
    }
    square = std::max(square, std::numeric_limits<double>::min());
    const auto first = static_cast<Eigen::Index>(views_.size() - rows.size());
    target_.conservativeResize(static_cast<Eigen::Index>(views_.size()));
    for (Eigen::Index i = first; i < target_.size(); ++i) {
        View &view = views_[static_cast<std::size_t>(i)];
        view.weight *= std::sqrt(share / square);
        target_[i] = view.weight * view.value;
    }
}

void Fit::add_oblique(const ReflectanceTable &table, const std::string &where) {
    const std::map<LightAngles, std::vector<ReflectanceRow>> lights = oblique_rows(table, where);
    for (const auto &[angles, rows] : lights)
        add_light(raised(direction_of(angles.first, angles.second)), rows,
                  1.0 / static_cast<double>(lights.size()), table.symmetry);
}

Eigen::MatrixXd Fit::shapes(double roughness) const {
    stop_if_asked(progress_);
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

// The shapes times what light and viewer reach; the last column is the diffuse part.
Eigen::MatrixXd Fit::basis(const Eigen::MatrixXd &shapes, const std::array<double, 2> &pit) const {
    const int count = unknowns_of_system();
    Eigen::MatrixXd b(shapes.rows(), shapes.cols() + 1);
    for (Eigen::Index i = 0; i < b.rows(); ++i) {
        const View &view = views_[static_cast<std::size_t>(i)];
        const glm::vec3 &l = view.to_light, &v = view.to_viewer;
        const std::array<YarnReach, 2> reach = {
            optics_.reach<0>(static_cast<float>(pit[0]), view.half, l, v),
            optics_.reach<1>(static_cast<float>(pit[1]), view.half, l, v)};
        for (int axis = 0; axis < 2; ++axis) {
            const double value =
                view.weight / l.z *
                reach[static_cast<std::size_t>(axis)].times_cosine(1 / v.z, l.z / v.z);
            b.row(i).segment(axis * count, count) =
                value * shapes.row(i).segment(axis * count, count);
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
}

double Fit::solve(const Eigen::MatrixXd &shapes, YarnLobes &lobes, double least_even) const {
    stop_if_asked(progress_);
    const int count = unknowns_of_system();
    const Eigen::MatrixXd b = basis(shapes, lobes.pit);
    Eigen::MatrixXd a = b.transpose() * b;
    const Eigen::VectorXd target = target_ - least_even * b.col(2 * count);
    Eigen::VectorXd linear = b.transpose() * target;
    const double scale = std::max(b.topLeftCorner(above_, 2 * count).squaredNorm() / (2 * count),
                                  std::numeric_limits<double>::min());
    a += kBending * scale * bending();
    for (int k = 0; k < 2 * count; ++k)
        linear[k] -=
            kSteepness * std::sqrt(scale) * std::pow(slope(k % count) / (kPi / 4), kSteepnessPower);
    const Eigen::VectorXd x = least_positive(a, linear, 1 / (std::sqrt(scale) * count));
    store(x, lobes);
    lobes.even += least_even;
    return (b * x - target).norm();
}

double Fit::solve_with_pits(const Eigen::MatrixXd &shapes, YarnLobes &lobes) const {
    double error = 0;
    lobes.pit = {0, 0};
    for (int round = 0; round < kRounds; ++round) {
        error = solve(shapes, lobes);
        const double weft = std::accumulate(lobes.surface[0].begin(), lobes.surface[0].end(), 0.0);
        const double warp = std::accumulate(lobes.surface[1].begin(), lobes.surface[1].end(), 0.0);
        const double share = weft + warp > 0 ? weft / (weft + warp) : 0.5;
        lobes.pit = {pit_of(share), pit_of(1 - share)};
    }
    return error;
}

struct Solution {
    YarnLobes lobes{};
    double least_even = 0;
    double error = std::numeric_limits<double>::infinity();
};

// Of equals the first.
const Solution &least_error(std::span<const Solution> tried) {
    return *std::min_element(tried.begin(), tried.end(), [](const Solution &a, const Solution &b) {
        return a.error < b.error;
    });
}

// The best of all pairs of depths at the roughness of `start`.
Solution best_of_depths(const Fit &fit, const Solution &start, const std::vector<double> &weft,
                        const std::vector<double> &warp) {
    const Eigen::MatrixXd shapes = fit.shapes(start.lobes.roughness);
    std::vector<Solution> tried(weft.size() * warp.size(), start);
    tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t i) {
        tried[i].lobes.pit = {weft[i / warp.size()], warp[i % warp.size()]};
        tried[i].error = fit.solve(shapes, tried[i].lobes, start.least_even);
    });
    return least_error(tried);
}

std::vector<double> around(double depth, double step) {
    return {std::max(depth - step, 0.0), depth, depth + step};
}

} // namespace

double yarn_slope(int k) { return (k - kMiddle) * kStep; }

double yarn_lobe(int axis, double slope, double roughness, const glm::dvec3 &half) {
    return yarn_lobe(half[axis] * std::cos(slope) + half.z * std::sin(slope), roughness);
}

double yarn_lobe(double sine, double roughness) {
    const double angle = std::asin(std::clamp(sine, -1.0, 1.0)) / roughness;
    return std::exp(-0.5 * angle * angle) / (std::sqrt(2 * kPi) * roughness * kPi);
}

YarnLobes fit_yarn_lobes(const Bard &bard, double f0, const Progress &progress) {
    if (!(bard.peak() > 0))
        return {.f0 = checked_f0(f0)}; // black: nothing is on any slope
    const Fit fit(bard, f0, progress);
    std::array<Solution, kRoughness.size()> tried;
    tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t i) {
        tried[i].lobes = {.f0 = f0, .roughness = kRoughness[i]};
        tried[i].error = fit.solve_with_pits(fit.shapes(kRoughness[i]), tried[i].lobes);
    });
    return least_error(tried).lobes;
}

YarnLobes fit_yarn_lobes(const Bard &bard, const ReflectanceTable &table, double f0,
                         const std::string &where, const Progress &progress) {
    check_table(table, where);
    if (!(bard.peak() > 0))
        throw Error({"the views under light from straight above are all 0", where,
                     "expected a value above 0"});
    const Fit above(bard, f0, progress);
    Fit fit(bard, f0, progress);
    fit.add_oblique(table, where);
    const std::vector<double> depths(kDepths.begin(), kDepths.end());
    Solution best;
    for (const double roughness : kRoughness) {
        Solution start{.lobes = {.f0 = f0, .roughness = roughness}};
        above.solve_with_pits(above.shapes(roughness), start.lobes);
        start.least_even = kLeastEven * start.lobes.even;
        if (const Solution tried = best_of_depths(fit, start, depths, depths);
            tried.error < best.error)
            best = tried;
    }
    for (const double step : kDepthSteps)
        best = best_of_depths(fit, best, around(best.lobes.pit[0], step),
                              around(best.lobes.pit[1], step));
    return best.lobes;
}

} // namespace tsuya
