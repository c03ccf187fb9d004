#include "models/least_positive.h"

#include <limits>

namespace tsuya {

Eigen::VectorXd least_positive(const Eigen::MatrixXd &a, const Eigen::VectorXd &b,
                               const Eigen::VectorXd &start, int updates,
                               const std::vector<LimitedSum> &limits) {
    const Eigen::MatrixXd plus = a.cwiseMax(0), minus = (-a).cwiseMax(0);
    Eigen::ArrayXd x = start;
    for (int i = 0; i < updates; ++i) {
        const Eigen::ArrayXd up = plus * x.matrix(), down = minus * x.matrix();
        x *= (b.array() + (b.array().square() + 4 * up * down).sqrt()) /
             (2 * up).max(std::numeric_limits<double>::min());
        for (const LimitedSum &l : limits)
            if (const double sum = x.segment(l.first, l.count).sum(); sum > l.limit)
                x.segment(l.first, l.count) *= l.limit / sum;
    }
    return x;
}

} // namespace tsuya
