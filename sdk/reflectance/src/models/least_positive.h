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

// Least of x'Ax/2 - b'x over x >= 0 by so many multiplicative updates of [Sha] from a start above
// 0; a is symmetric. A sum that passes its limit is scaled back at every update.
Eigen::VectorXd least_positive(const Eigen::MatrixXd &a, const Eigen::VectorXd &b,
                               const Eigen::VectorXd &start, int updates,
                               const std::vector<LimitedSum> &limits);

} // namespace tsuya
