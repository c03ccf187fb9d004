#include "page/shape_basis.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <Eigen/Dense>
#include <glm/common.hpp>

#include "tsuya/color/difference.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

const float *channels_of(const SpectralImage &image, std::size_t group, std::size_t pixel) {
    const std::size_t size =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    return image.transport.data() +
           (group * size + pixel) * static_cast<std::size_t>(image.basis.count);
}

/// The quadratic form that gives the square of a change of colour for a change of shape: CIELAB
/// about the mean shape, chroma as CIEDE2000 weighs it, averaged over the looks.
Matrix colour_metric(const std::vector<JudgedLook> &looks, const Vector &mean) {
    constexpr double kUnitsOfCode = 255 * 0.3; // CIELAB units that count as much as all codes
    constexpr double kLeast = 0.01;            // share of white below which CIELAB is no cube root
    Matrix metric = Matrix::Zero(mean.size(), mean.size());
    for (const JudgedLook &look : looks) {
        glm::dvec3 xyz(0.0);
        for (Eigen::Index k = 0; k < mean.size(); ++k)
            xyz += mean[k] * look.channels[static_cast<std::size_t>(k)];
        xyz = glm::max(xyz, kLeast * look.white);
        const glm::dvec3 lab = lab_of(xyz, look.white);
        const double chroma_weight = 1 / (1 + 0.045 * std::hypot(lab.y, lab.z)); // [Sharma] S_C
        Matrix cones(mean.size(), 3); // a third of the change of the cube roots
        for (Eigen::Index k = 0; k < mean.size(); ++k)
            for (int c = 0; c < 3; ++c)
                cones(k, c) = std::cbrt(xyz[c] / look.white[c]) / 3 *
                              look.channels[static_cast<std::size_t>(k)][c] / xyz[c];
        Matrix change(mean.size(), 3); // [CIE015] section 8: L*, a*, b*
        change << 116 * cones.col(1), chroma_weight * 500 * (cones.col(0) - cones.col(1)),
            chroma_weight * 200 * (cones.col(1) - cones.col(2));
        metric += change * change.transpose();
        const glm::dvec3 rgb = srgb_from_xyz() * xyz;
        for (int c = 0; c < 3; ++c) {
            if (!(rgb[c] > 0))
                continue;
            const double light = std::max(rgb[c], kLeast);
            const double slope = srgb_encode(light) / (2.4 * light) * kUnitsOfCode;
            Vector codes(mean.size());
            for (Eigen::Index k = 0; k < mean.size(); ++k)
                codes[k] =
                    slope * (srgb_from_xyz() * look.channels[static_cast<std::size_t>(k)])[c];
            metric += codes * codes.transpose();
        }
    }
    return metric / static_cast<double>(looks.size());
}

} // namespace

double shape_weight(double mean) { return std::cbrt(std::min(mean, 1.0)); }

ShapeBasis make_shape_basis(const SpectralImage &image, std::size_t group,
                            const std::vector<std::size_t> &pixels,
                            const std::vector<JudgedLook> &looks) {
    const Eigen::Index channels = image.basis.count;
    std::vector<Vector> shapes;
    std::vector<double> weights;
    Vector mean = Vector::Zero(channels);
    double sum = 0;
    for (const std::size_t pixel : pixels) {
        const Eigen::Map<const Eigen::VectorXf> t(channels_of(image, group, pixel), channels);
        const double level = t.cast<double>().mean();
        if (!(level > 0) || !std::isfinite(level))
            continue;
        shapes.emplace_back(t.cast<double>() / level);
        weights.push_back(std::pow(shape_weight(level), 2));
        mean += weights.back() * shapes.back();
        sum += weights.back();
    }
    if (sum > 0)
        mean /= sum;
    else
        mean.setOnes();
    Matrix covariance = Matrix::Zero(channels, channels);
    for (std::size_t i = 0; i < shapes.size(); ++i)
        covariance += weights[i] / sum * (shapes[i] - mean) * (shapes[i] - mean).transpose();

    // Directions that no look shows have a small metric in place of none.
    Matrix metric = colour_metric(looks, mean);
    metric += 1e-6 * metric.trace() * Matrix::Identity(channels, channels);
    const Eigen::SelfAdjointEigenSolver<Matrix> roots(metric);
    const Matrix to = roots.operatorSqrt(), from = roots.operatorInverseSqrt();
    const Eigen::SelfAdjointEigenSolver<Matrix> parts(to * covariance * to);

    ShapeBasis basis{.mean = {mean.begin(), mean.end()}};
    for (Eigen::Index i = channels; i-- > 0;) {
        const Vector part = parts.eigenvectors().col(i);
        const Vector direction = from * part, reading = to * part;
        basis.direction.emplace_back(direction.begin(), direction.end());
        basis.reading.emplace_back(reading.begin(), reading.end());
        basis.spread.push_back(std::sqrt(std::max(0.0, parts.eigenvalues()[i])));
    }
    return basis;
}

} // namespace tsuya
