#include "tsuya/sdk/bard.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <Eigen/Dense>
#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "views/mirror_views.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr std::size_t kMinViews = 6;
constexpr double kMinReach = 20 * kDegree;
// Values below this share of the peak, zeros among them, count as this share: log needs a floor.
constexpr double kFloor = 1e-6;
constexpr double kBright = 0.01;        // of the peak: darker views tell nothing of the symmetry
constexpr double kContradiction = 0.2;  // log10, root mean square: a factor of 1.6
constexpr double kLargestAlbedo = 2;    // some slack for what lies beyond the views
constexpr double kSteep = 10 * kDegree; // views nearer to the normal have no azimuth

// The compactly supported C2 function of Wendland for up to three dimensions, [Wendland] phi_{3,1}.
double kernel(double dx, double dy) {
    const double r = std::sqrt(dx * dx + dy * dy);
    const double s = std::max(0.0, 1.0 - r), s2 = s * s;
    return s2 * s2 * (4.0 * r + 1.0);
}

// Refuses views that leave most azimuths unseen: less than a third of what the symmetry leaves.
void check_azimuths(const std::vector<BardView> &views, Symmetry symmetry,
                    const std::string &where) {
    const double turn = 2 * std::numbers::pi;
    const double period = symmetry == Symmetry::none ? turn : turn / 2;
    std::vector<double> azimuths;
    for (const BardView &view : views)
        if (view.theta > kSteep) {
            double phi = view.phi - period * std::floor(view.phi / period);
            if (symmetry == Symmetry::orthotropic)
                phi = std::min(phi, period - phi);
            azimuths.push_back(phi);
        }
    std::sort(azimuths.begin(), azimuths.end());
    double covered = 0, whole = period;
    if (symmetry == Symmetry::orthotropic) {
        whole = period / 2;
        covered = azimuths.back() - azimuths.front();
    } else {
        double gap = azimuths.front() + period - azimuths.back();
        for (std::size_t i = 1; i < azimuths.size(); ++i)
            gap = std::max(gap, azimuths[i] - azimuths[i - 1]);
        covered = period - gap;
    }
    const auto degrees = [](double angle) {
        return std::to_string(std::lround(angle / kDegree)) + " degrees";
    };
    if (covered < whole / 3)
        throw Error({"the views cover " + degrees(covered) + " of azimuth out of " +
                         degrees(whole) + " that the symmetry '" + name_of(symmetry) + "' leaves",
                     where, "expected views over a third of them or more"});
}

struct WeightedSquares {
    double sum = 0, weights = 0;

    void add(double weight, double square) {
        sum += weight * square;
        weights += weight;
    }
    double root_mean_square() const { return weights > 0 ? std::sqrt(sum / weights) : 0; }
};

// One node for each group of views, with their mean.
struct Averages {
    std::vector<glm::dvec2> at{};
    std::vector<double> log_value{}, relative_sigma{};
    WeightedSquares mirrored{}; // log10 of views over their mean
    WeightedSquares bright{};   // the same of bright ones, where noise does not explain it
};

Averages average_mirrors(const std::vector<BardView> &views, Symmetry symmetry, double peak) {
    const double floor = std::max(peak * kFloor, std::numeric_limits<double>::min());
    Averages averages;
    for (const MirrorGroup &group : mirror_groups(views, symmetry)) {
        const auto count = static_cast<double>(group.members.size());
        double mean = 0, variance = 0;
        for (const std::size_t i : group.members) {
            mean += views[i].brdf_per_sr / count;
            variance += views[i].sigma_per_sr * views[i].sigma_per_sr;
        }
        mean = std::max(mean, floor);
        averages.at.push_back(group.p);
        averages.log_value.push_back(std::log(mean));
        averages.relative_sigma.push_back(std::sqrt(variance) / (mean * count));
        if (group.members.size() == 1)
            continue;
        for (const std::size_t i : group.members) {
            const double value = views[i].brdf_per_sr;
            const double d = std::log10(std::max(value, floor) / mean);
            const bool noise = std::abs(value - mean) < 4 * views[i].sigma_per_sr;
            averages.mirrored.add(1, d * d);
            // By value, or many views of a level ground would hide a highlight that is turned
            if (mean > kBright * peak)
                averages.bright.add(mean, noise ? 0 : d * d);
        }
    }
    return averages;
}

// What the surface is fitted to: one point of the disk for each distinct view.
struct Points {
    std::vector<glm::dvec2> at{};
    std::vector<double> value{}; // log rho less its mean
    const std::vector<double> &relative_sigma;
    Symmetry symmetry;
};

struct Solution {
    Eigen::VectorXd weight{};
    double error = std::numeric_limits<double>::infinity();
};

// The kernels of all nodes at all nodes, mirrored with the symmetry; the lower half.
Eigen::MatrixXd kernels(const Points &points, const BardSmoothness &s) {
    const auto n = static_cast<Eigen::Index>(points.at.size());
    Eigen::ArrayXd x(n), y(n);
    for (Eigen::Index i = 0; i < n; ++i) {
        x[i] = points.at[static_cast<std::size_t>(i)].x / s.weft_support;
        y[i] = points.at[static_cast<std::size_t>(i)].y / s.warp_support;
    }
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
        int count = 0;
        const auto image = images(x[i], y[i], points.symmetry, count);
        double *const column = &k(0, i);
        for (int g = 0; g < count; ++g) {
            const glm::dvec2 p = image[static_cast<std::size_t>(g)];
            for (Eigen::Index j = i; j < n; ++j)
                column[j] += kernel(p.x - x[j], p.y - y[j]);
        }
    }
    return k;
}

// The weights of the nodes for the kernels, and the mean squared leave-one-out error of log rho if
// a progress is given, which may stop that.
Solution solve(const Points &points, Eigen::MatrixXd k, double noise_share,
               const Progress *with_error) {
    const Eigen::Index n = k.rows();
    const auto y = Eigen::Map<const Eigen::VectorXd>(points.value.data(), n);
    const double variance = std::max(y.squaredNorm() / static_cast<double>(n), 1e-12);
    for (Eigen::Index i = 0; i < n; ++i) {
        const double sigma = points.relative_sigma[static_cast<std::size_t>(i)];
        k(i, i) += std::max(noise_share, sigma * sigma / variance);
    }
    const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor(k); // in place
    Solution solution{.weight = factor.solve(y)};
    if (!with_error)
        return solution;
    // Columns of the inverse of the factor, which has nothing above its diagonal: the diagonal of
    // the inverse of k is their squares. Leave-one-out residual of a linear smoother, [Rasmussen]
    // Eq. 5.12
    constexpr Eigen::Index kColumns = 48;
    solution.error = 0;
    for (Eigen::Index begin = 0; begin < n; begin += kColumns) {
        stop_if_asked(*with_error);
        const Eigen::Index rows = n - begin, columns = std::min(kColumns, rows);
        Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(rows, columns);
        k.bottomRightCorner(rows, rows).triangularView<Eigen::Lower>().solveInPlace(inverse);
        solution.error += (solution.weight.segment(begin, columns).array() /
                           inverse.colwise().squaredNorm().transpose().array())
                              .square()
                              .sum() /
                          static_cast<double>(n);
    }
    if (!std::isfinite(solution.error))
        solution.error = std::numeric_limits<double>::infinity();
    return solution;
}

// The smoothness with the least leave-one-out error of those tried, and its weights.
struct Search {
    BardSmoothness smoothness{};
    Solution best{};

    // Tries some at once; of equals the first is taken.
    void attempt(const Points &points, const std::vector<BardSmoothness> &some,
                 const Progress &progress) {
        const bool one_shape = std::all_of(some.begin(), some.end(), [&](const BardSmoothness &s) {
            return s.weft_support == some[0].weft_support && s.warp_support == some[0].warp_support;
        });
        const Eigen::MatrixXd shared = one_shape ? kernels(points, some[0]) : Eigen::MatrixXd();
        std::vector<Solution> solutions(some.size());
        tbb::parallel_for(std::size_t{0}, some.size(), [&](std::size_t i) {
            stop_if_asked(progress);
            solutions[i] = solve(points, one_shape ? shared : kernels(points, some[i]),
                                 some[i].noise_share, &progress);
        });
        for (std::size_t i = 0; i < some.size(); ++i)
            if (solutions[i].error < best.error) {
                best = std::move(solutions[i]);
                smoothness = some[i];
            }
    }
};

// One support for both axes, then each axis by itself, then the noise.
Search search(const Points &points, const Progress &progress) {
    constexpr double kLittle = 1e-6;
    Search found;
    std::vector<BardSmoothness> some;
    for (const double support : {0.25, 0.5, 1.0, 2.0, 4.0})
        some.push_back({support, support, kLittle});
    found.attempt(points, some, progress);
    const double weft = found.smoothness.weft_support, warp = found.smoothness.warp_support;
    found.attempt(points,
                  {{weft / 2, warp, kLittle},
                   {weft, warp / 2, kLittle},
                   {weft * 2, warp, kLittle},
                   {weft, warp * 2, kLittle}},
                  progress);
    const BardSmoothness shaped = found.smoothness;
    some.clear();
    for (const double noise : {1e-5, 1e-4, 1e-3, 1e-2})
        some.push_back({shaped.weft_support, shaped.warp_support, noise});
    found.attempt(points, some, progress);
    return found;
}

} // namespace

void Bard::take_views(const ReflectanceTable &table, const std::string &where) {
    check_table(table.normal_incidence(), where);
    symmetry_ = table.symmetry;
    double reach = 0;
    for (const ReflectanceRow &row : table.normal_incidence().rows) {
        views_.push_back({row.theta_r, row.phi_r, row.brdf_per_sr, row.sigma_per_sr, 0});
        peak_ = std::max(peak_, row.brdf_per_sr);
        reach = std::max(reach, row.theta_r);
    }
    if (views_.size() < kMinViews || reach < kMinReach)
        throw Error({"the table has " + detail::counted(views_.size(), "view") +
                         " with light from straight above, the farthest " +
                         std::to_string(std::lround(reach / kDegree)) + " degrees from the normal",
                     where,
                     "expected 6 or more rows with theta_i_deg = 0, some beyond 20 degrees"});

    check_azimuths(views_, symmetry_, where);

    Averages averages = average_mirrors(views_, symmetry_, peak_);
    for (const glm::dvec2 &p : averages.at)
        nodes_.push_back({p.x, p.y, 0});
    log_value_ = std::move(averages.log_value);
    relative_sigma_ = std::move(averages.relative_sigma);
    asymmetry_ = averages.mirrored.root_mean_square();
    contradiction_ = averages.bright.root_mean_square();
    check_symmetry(where);
    for (const double v : log_value_)
        mean_log_ += v / static_cast<double>(log_value_.size());
}

void Bard::check_symmetry(const std::string &where) const {
    if (contradiction_ > kContradiction)
        throw Error({std::string("the views contradict the declared symmetry '") +
                         name_of(symmetry_) + "': mirror images differ by a factor of " +
                         std::to_string(std::pow(10, contradiction_)) +
                         " (root mean square, weighted by value)",
                     where, "expected `# symmetry: half-turn` for twisted yarn, or `none`"});
}

void Bard::check_albedo(const std::string &where) const {
    constexpr int kRings = 24, kParts = 48;
    double sum = 0;
    for (int i = 0; i < kRings; ++i)
        for (int j = 0; j < kParts; ++j) {
            const double sine2 = (i + 0.5) / kRings, s = std::sqrt(sine2);
            const double phi = 2 * std::numbers::pi * (j + 0.5) / kParts;
            sum += at({s * std::cos(phi), s * std::sin(phi), std::sqrt(1 - sine2)});
        }
    const double albedo = sum * std::numbers::pi / (kRings * kParts);
    if (!(albedo < kLargestAlbedo))
        throw Error(
            {"the views reflect " + std::to_string(albedo) + " times what they receive", where,
             "expected BRDF values in 1/sr without the cosine: a white diffuser has 0.318"});
}

void Bard::finish() {
    int count = 0;
    for (const Node &n : nodes_) {
        const auto image = images(n.x, n.y, symmetry_, count);
        for (int g = 0; g < count; ++g)
            mirrored_.push_back({image[static_cast<std::size_t>(g)].x,
                                 image[static_cast<std::size_t>(g)].y, n.weight});
    }
    for (BardView &v : views_) {
        const glm::dvec2 p = disk_of(v.theta, v.phi);
        v.fitted_per_sr = peak_ > 0 ? std::exp(log_at(p.x, p.y)) : 0;
    }
}

Bard Bard::fit(const ReflectanceTable &table, const BardSmoothness &smoothness,
               const std::string &where, const Progress &progress) {
    return fit_with(&smoothness, table, where, progress);
}

Bard Bard::fit(const ReflectanceTable &table, const std::string &where, const Progress &progress) {
    return fit_with(nullptr, table, where, progress);
}

Bard Bard::fit_with(const BardSmoothness *smoothness, const ReflectanceTable &table,
                    const std::string &where, const Progress &progress) {
    stop_if_asked(progress);
    Bard bard;
    bard.take_views(table, where);
    Points points{.relative_sigma = bard.relative_sigma_, .symmetry = bard.symmetry_};
    for (std::size_t i = 0; i < bard.nodes_.size(); ++i) {
        points.at.emplace_back(bard.nodes_[i].x, bard.nodes_[i].y);
        points.value.push_back(bard.log_value_[i] - bard.mean_log_);
    }
    Search found;
    if (smoothness) {
        found.smoothness = *smoothness;
        found.best = solve(points, kernels(points, *smoothness), smoothness->noise_share, nullptr);
    } else {
        found = search(points, progress);
    }
    bard.smoothness_ = found.smoothness;
    for (std::size_t i = 0; i < bard.nodes_.size(); ++i)
        bard.nodes_[i].weight = found.best.weight[static_cast<Eigen::Index>(i)];
    bard.finish();
    bard.check_albedo(where);
    return bard;
}

double Bard::log_at(double x, double y) const {
    const double sx = 1 / smoothness_.weft_support, sy = 1 / smoothness_.warp_support;
    double sum = 0;
    for (const Node &n : mirrored_)
        sum += n.weight * kernel((x - n.x) * sx, (y - n.y) * sy);
    return mean_log_ + sum;
}

double Bard::at(const glm::dvec3 &to_viewer) const {
    if (peak_ == 0)
        return 0;
    const double scale = 1 / std::sqrt(1 + std::max(0.0, to_viewer.z));
    return std::exp(log_at(to_viewer.x * scale, to_viewer.y * scale));
}

double Bard::residual() const {
    double squares = 0;
    for (const BardView &v : views_)
        if (v.brdf_per_sr > 0)
            squares += std::pow(std::log10(v.fitted_per_sr / v.brdf_per_sr), 2);
    return std::sqrt(squares / static_cast<double>(views_.size()));
}

} // namespace tsuya
