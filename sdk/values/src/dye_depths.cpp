#include "tsuya/sdk/dye_depths.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using Degrees = std::array<int, kMostDyes>;

// F is a power series in the reflectance of a dye whose terms shrink a little by each meeting: as
// if it had a pole here.
constexpr double kPole = 1.3;

// By how much the error of interpolation shrinks with a degree in this dye: the sum of the half
// axes of the ellipse that reaches the pole, [Trefethen] Theorem 8.2.
double convergence(const DyeVariable &dye) {
    const double half = 0.5 * (dye.highest - dye.lowest);
    const double pole = kPole - 0.5 * (dye.highest + dye.lowest);
    return (pole + std::sqrt(pole * pole - half * half)) / half;
}

// The degrees of so many products whose terms are the largest.
std::vector<Degrees> largest_terms(const std::vector<DyeVariable> &dyes, int channels) {
    const double first = std::log(convergence(dyes[0]));
    const double second = dyes.size() > 1 ? std::log(convergence(dyes[1])) : 0;
    std::vector<Degrees> all;
    for (int j = 0; j < (dyes.size() > 1 ? channels : 1); ++j)
        for (int i = 0; i < channels; ++i)
            all.push_back({i, j});
    std::stable_sort(all.begin(), all.end(), [&](const Degrees &a, const Degrees &b) {
        return a[0] * first + a[1] * second < b[0] * first + b[1] * second;
    });
    all.resize(static_cast<std::size_t>(channels));
    return all;
}

// Points of which every first few are good to interpolate at: each makes the product of its
// distances from those before the largest, [DeMarchi].
std::vector<double> leja_points(std::size_t count) {
    constexpr int kCandidates = 2000;
    std::vector<double> points{0.0};
    while (points.size() < count) {
        double best = 0, most = -1;
        for (int i = 0; i <= kCandidates; ++i) {
            const double x = 1 - 2.0 * i / kCandidates;
            double product = 1;
            for (const double p : points)
                product *= std::abs(x - p);
            if (product > most * (1 + 1e-9)) {
                most = product;
                best = x;
            }
        }
        points.push_back(best);
    }
    return points;
}

std::vector<double> lobatto_points(std::size_t count) {
    std::vector<double> points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back(-std::cos(kPi * static_cast<double>(i) / static_cast<double>(count - 1)));
    return points;
}

// The place of a reflectance in the dye's range, from -1 to 1.
double unit(const DyeVariable &dye, double reflectance) {
    const double x = (2 * reflectance - dye.lowest - dye.highest) / (dye.highest - dye.lowest);
    return std::clamp(x, -1.0, 1.0);
}

double chebyshev(int degree, double x) { return std::cos(degree * std::acos(x)); }

// The products of Chebyshev polynomials, one a channel.
Eigen::VectorXd products(const DyeDepths &depths, const std::array<double, kMostDyes> &at) {
    Eigen::VectorXd values(static_cast<Eigen::Index>(depths.degree.size()));
    for (std::size_t k = 0; k < depths.degree.size(); ++k) {
        double product = 1;
        for (std::size_t d = 0; d < depths.dyes.size(); ++d)
            product *= chebyshev(depths.degree[k][d], unit(depths.dyes[d], at[d]));
        values[static_cast<Eigen::Index>(k)] = product;
    }
    return values;
}

Eigen::MatrixXd node_matrix(const DyeDepths &depths) {
    const auto count = static_cast<Eigen::Index>(depths.node.size());
    Eigen::MatrixXd matrix(count, count);
    for (Eigen::Index k = 0; k < count; ++k)
        matrix.row(k) = products(depths, depths.node[static_cast<std::size_t>(k)]).transpose();
    return matrix;
}

void check_dyes(const std::vector<DyeVariable> &dyes, const std::string &where) {
    if (dyes.empty() || dyes.size() > kMostDyes)
        throw Error({detail::counted(dyes.size(), "dye"), where,
                     "expected 1 to " + std::to_string(kMostDyes)});
    for (const DyeVariable &dye : dyes) {
        if (!(dye.lowest >= 0 && dye.lowest < dye.highest && dye.highest <= 1))
            throw Error({"the reflectances of the dye '" + dye.name + "' go from " +
                             std::to_string(dye.lowest) + " to " + std::to_string(dye.highest),
                         where, "expected a range within 0 to 1"});
        check_spectrum(dye.dye, 0, 1, where + "." + dye.name);
    }
}

} // namespace

DyeDepths make_dye_depths(std::vector<DyeVariable> dyes, int channels) {
    check_dyes(dyes, "dyes");
    if (channels < 2)
        throw Error({detail::counted(static_cast<std::size_t>(std::max(0, channels)), "channel"),
                     "channels", "expected 2 or more"});
    DyeDepths depths{.dyes = std::move(dyes)};
    depths.degree = largest_terms(depths.dyes, channels);
    const auto count = static_cast<std::size_t>(channels);
    const std::vector<double> points =
        depths.dyes.size() > 1 ? leja_points(count) : lobatto_points(count);
    for (const Degrees &degree : depths.degree) {
        std::array<double, kMostDyes> node{};
        for (std::size_t d = 0; d < depths.dyes.size(); ++d) {
            const DyeVariable &dye = depths.dyes[d];
            const double x = points[static_cast<std::size_t>(degree[d])];
            node[d] = 0.5 * ((1 - x) * dye.lowest + (1 + x) * dye.highest);
        }
        depths.node.push_back(node);
    }
    return depths;
}

void check_dye_depths(const DyeDepths &depths, const std::string &where) {
    check_dyes(depths.dyes, where);
    const std::size_t count = depths.node.size();
    bool good = count > 0 && depths.degree.size() == count;
    for (std::size_t k = 0; good && k < count; ++k)
        for (std::size_t d = 0; d < depths.dyes.size(); ++d)
            good = good && depths.degree[k][d] >= 0 && std::isfinite(depths.node[k][d]);
    constexpr double kLeastPivot = 1e-9; // of products, which are at most 1
    if (!good ||
        Eigen::FullPivLU<Eigen::MatrixXd>(node_matrix(depths)).setThreshold(kLeastPivot).rank() <
            static_cast<Eigen::Index>(count))
        throw Error({"the " + detail::counted(count, "depth") + " of dye do not fit their degrees",
                     where, "expected nodes that determine a polynomial"});
}

DepthWeights::DepthWeights(const DyeDepths &depths) : depths_(depths) {
    check_dye_depths(depths, "depths");
    // F(r) = sum over products p of c_p p(r), with c = M^-1 F(nodes)
    const Eigen::MatrixXd inverse = node_matrix(depths).inverse();
    for (Eigen::Index product = 0; product < inverse.rows(); ++product)
        for (Eigen::Index k = 0; k < inverse.cols(); ++k)
            inverse_.push_back(inverse(product, k));
}

std::vector<double> DepthWeights::at(const std::array<double, kMostDyes> &reflectance) const {
    const Eigen::VectorXd values = products(depths_, reflectance);
    const std::size_t count = depths_.node.size();
    std::vector<double> weights(count);
    for (std::size_t p = 0; p < count; ++p)
        for (std::size_t k = 0; k < count; ++k)
            weights[k] += values[static_cast<Eigen::Index>(p)] * inverse_[p * count + k];
    return weights;
}

std::vector<double> DepthWeights::at_nm(double wavelength_nm) const {
    std::array<double, kMostDyes> reflectance{};
    for (std::size_t d = 0; d < depths_.dyes.size(); ++d)
        reflectance[d] = depths_.dyes[d].dye.at(wavelength_nm);
    return at(reflectance);
}

void set_dye(DyeDepths &depths, const std::string &name, const Spectrum &dye) {
    check_spectrum(dye, 0, 1, name.empty() ? "dye" : name);
    std::vector<std::string> open;
    bool found = false;
    for (DyeVariable &variable : depths.dyes)
        if (variable.open) {
            open.push_back(variable.name);
            if (name.empty() || name == variable.name) {
                variable.dye = dye;
                found = true;
            }
        }
    if (!found)
        throw Error({"no open dye" + (name.empty() ? std::string() : " '" + name + "'"), "dye",
                     open.empty() ? "expected a picture whose dye was left open"
                                  : accepted_names(name, open)});
}

} // namespace tsuya
