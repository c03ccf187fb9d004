#pragma once
// Least squares over numbers that are not negative.

#include <vector>

#include <Eigen/Dense>

namespace tsuya {

// Unknowns whose sum may not pass a limit.
struct LimitedSum {
    Eigen::Index first = 0, count = 0;
    double limit = 0;
};

// Least of x'Ax/2 - b'x over x >= 0 by the multiplicative updates of [Sha]; a is symmetric. A sum
// that passes its limit is scaled back at every update. The number of updates is fixed: slopes that
// the views do not tell apart stay as even as they start.
Eigen::VectorXd least_positive(const Eigen::MatrixXd &a, const Eigen::VectorXd &b, double start,
                               const std::vector<LimitedSum> &limits);

} // namespace tsuya
