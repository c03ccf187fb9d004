#include "yarn_paths.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya::lab::detail {
namespace {

// Most places lie in the repeat, and divisions are slow.
int wrap(int i, int n) { return i >= 0 && i < n ? i : ((i % n) + n) % n; }

void check_stop(const Progress &progress) {
    if (progress.stopped())
        throw Interrupted("stopped while the paths of yarns were found");
}

/// The places of a yarn about a crossing, and how much room the crossed yarn needs there.
struct Window {
    int reach = 0; ///< places on either side
    std::vector<double> room{};
};

/// Two yarns (all within their radius of a ribbon) keep clear if, at a distance dx beyond the edge
/// of one ribbon and dy beyond that of the other, their axes differ in height by sqrt(R^2 - dx^2 -
/// dy^2), R being the sum of the radii. We ask for the sum of a term in x and one in y, sqrt(R^2 -
/// dx^2) + sqrt(R^2 - dy^2) - R, which is never less, since with p and q for the first two as
/// shares of R, (p + q - 1)^2 - (p^2 + q^2 - 1) = 2 (1 - p)(1 - q) >= 0. Returns the term of
/// `crossed` with the radius of the other yarn taken from it.
Window window_of(const YarnSection &crossed, double other_radius, double step, int places) {
    const double sum = crossed.radius + other_radius;
    Window window;
    window.reach = std::min(static_cast<int>((crossed.half_flat + sum) / step), places / 2 - 1);
    for (int m = -window.reach; m <= window.reach; ++m) {
        const double beyond = std::max(0.0, std::abs(m) * step - crossed.half_flat);
        window.room.push_back(std::sqrt(std::max(0.0, sum * sum - beyond * beyond)) - other_radius);
    }
    // Between places the path cuts the corner of a round obstacle: it is raised by as much.
    const std::vector<double> exact = window.room;
    const double most = step * step / (4 * sum);
    for (std::size_t k = 1; k + 1 < exact.size(); ++k)
        window.room[k] +=
            std::clamp(exact[k] - (exact[k - 1] + exact[k + 1]) / 2, 0.0, 4 * most) / 4;
    return window;
}

/// Finds the heights of least energy by projected gradient descent with momentum ([ODonoghue],
/// restarted where it overshoots).
class Solver {
  public:
    explicit Solver(const PathProblem &problem)
        : draft_(problem.draft), points_(problem.points), ny_(draft_.picks * points_),
          nx_(draft_.ends * points_), apart_(problem.warp.radius + problem.weft.radius),
          across_weft_(
              window_of(problem.weft, problem.warp.radius, problem.weft_spacing / points_, ny_)),
          across_warp_(
              window_of(problem.warp, problem.weft.radius, problem.warp_spacing / points_, nx_)),
          bending_(std::pow(problem.stiffness_length * points_, 2)), pull_{problem.warp_tension,
                                                                           problem.weft_tension} {}

    /// Warp yarns, then weft yarns.
    std::vector<double> solve(const Progress &progress) {
        constexpr int kIterations = 8000, kPolish = 10000;
        const double enough = 1e-7 * apart_;
        std::vector<double> now = start(), next, ahead = now;
        double momentum = 1;
        for (int i = 0; i < kIterations; ++i) {
            check_stop(progress);
            next = ahead;
            descend(ahead, next);
            project(next);
            const std::size_t first_weft = weft_at(0, 0);
            double uphill = 0, change = 0;
            for (std::size_t k = 0; k < now.size(); ++k) {
                uphill += pull_[k < first_weft ? 0 : 1] * (ahead[k] - next[k]) * (next[k] - now[k]);
                change = std::max(change, std::abs(next[k] - now[k]));
            }
            const double larger = (1 + std::sqrt(1 + 4 * momentum * momentum)) / 2;
            const double share = uphill > 0 ? 0 : (momentum - 1) / larger;
            momentum = uphill > 0 ? 1 : larger;
            for (std::size_t k = 0; k < now.size(); ++k)
                ahead[k] = next[k] + share * (next[k] - now[k]);
            now.swap(next);
            if (i > 10 && change < enough)
                break;
        }
        for (int i = 0; i < kPolish; ++i) {
            check_stop(progress);
            overlap_ = project(now);
            if (overlap_ <= 1e-4 * apart_)
                break;
        }
        return now;
    }
    /// That was left by solve(), metres.
    double overlap() const { return overlap_; }

  private:
    std::size_t warp_at(int end, int place) const {
        return static_cast<std::size_t>(end) * static_cast<std::size_t>(ny_) +
               static_cast<std::size_t>(wrap(place, ny_));
    }
    std::size_t weft_at(int pick, int place) const {
        return static_cast<std::size_t>(draft_.ends) * static_cast<std::size_t>(ny_) +
               static_cast<std::size_t>(pick) * static_cast<std::size_t>(nx_) +
               static_cast<std::size_t>(wrap(place, nx_));
    }

    std::vector<double> start() const {
        std::vector<double> z(
            static_cast<std::size_t>(draft_.ends) * static_cast<std::size_t>(ny_) +
            static_cast<std::size_t>(draft_.picks) * static_cast<std::size_t>(nx_));
        for (int e = 0; e < draft_.ends; ++e)
            for (int k = 0; k < ny_; ++k)
                z[warp_at(e, k)] = (draft_.up(e, k / points_) ? 0.5 : -0.5) * apart_;
        for (int p = 0; p < draft_.picks; ++p)
            for (int k = 0; k < nx_; ++k)
                z[weft_at(p, k)] = (draft_.up(k / points_, p) ? -0.5 : 0.5) * apart_;
        return z;
    }

    /// One step down the gradient of tension times sum (dz)^2 / 2 + bending (ddz)^2 / 2, in the
    /// metric that weighs each place by the tension of its yarn, which takes the tension out again.
    void descend(const std::vector<double> &z, std::vector<double> &result) const {
        const auto yarn = [&](std::size_t first, int n) {
            const double step = 1 / (4 + 16 * bending_);
            const auto at = [&](int k) { return z[first + static_cast<std::size_t>(wrap(k, n))]; };
            for (int k = 0; k < n; ++k) {
                const double second = at(k - 1) - 2 * at(k) + at(k + 1);
                const double fourth =
                    at(k - 2) - 4 * at(k - 1) + 6 * at(k) - 4 * at(k + 1) + at(k + 2);
                result[first + static_cast<std::size_t>(k)] += step * (second - bending_ * fourth);
            }
        };
        for (int e = 0; e < draft_.ends; ++e)
            yarn(warp_at(e, 0), ny_);
        for (int p = 0; p < draft_.picks; ++p)
            yarn(weft_at(p, 0), nx_);
    }

    /// Moves yarns apart where they overlap; returns the largest overlap found.
    double project(std::vector<double> &z) {
        double worst = 0;
        for (int e = 0; e < draft_.ends; ++e)
            for (int p = 0; p < draft_.picks; ++p)
                worst = std::max(worst, project_crossing(z, e, p));
        return worst;
    }

    /// The nearest heights (in the same metric: what is pulled more gives way less) with a level
    /// between the two yarns of a crossing: all room above it for the one, all below for the other.
    double project_crossing(std::vector<double> &z, int end, int pick) {
        const double sign = draft_.up(end, pick) ? 1 : -1;
        const int k0 = pick * points_ + points_ / 2, l0 = end * points_ + points_ / 2;
        lower_.clear();
        upper_.clear();
        double least = 1e300, most = -1e300;
        for (int m = -across_weft_.reach; m <= across_weft_.reach; ++m) {
            upper_.push_back(sign * z[warp_at(end, k0 + m)] -
                             across_weft_.room[static_cast<std::size_t>(m + across_weft_.reach)]);
            least = std::min(least, upper_.back());
        }
        for (int m = -across_warp_.reach; m <= across_warp_.reach; ++m) {
            lower_.push_back(sign * z[weft_at(pick, l0 + m)] +
                             across_warp_.room[static_cast<std::size_t>(m + across_warp_.reach)]);
            most = std::max(most, lower_.back());
        }
        if (least >= most)
            return 0;
        const double level = level_between(least, most);
        for (int m = -across_weft_.reach; m <= across_weft_.reach; ++m) {
            const double value = upper_[static_cast<std::size_t>(m + across_weft_.reach)];
            z[warp_at(end, k0 + m)] += sign * std::max(0.0, level - value);
        }
        for (int m = -across_warp_.reach; m <= across_warp_.reach; ++m) {
            const double value = lower_[static_cast<std::size_t>(m + across_warp_.reach)];
            z[weft_at(pick, l0 + m)] -= sign * std::max(0.0, value - level);
        }
        return most - least;
    }

    /// Where what pushes up equals what pushes down: a root of a rising, piecewise linear function.
    double level_between(double low, double high) const {
        double level = (low + high) / 2;
        for (int i = 0; i < 30; ++i) {
            double force = 0, slope = 0;
            for (const double value : upper_)
                if (value < level) {
                    force += pull_[0] * (level - value);
                    slope += pull_[0];
                }
            for (const double value : lower_)
                if (value > level) {
                    force -= pull_[1] * (value - level);
                    slope += pull_[1];
                }
            (force > 0 ? high : low) = level;
            if (std::abs(force) < 1e-9 * apart_ * std::min(pull_[0], pull_[1]))
                break;
            const double newton = level - force / std::max(slope, std::min(pull_[0], pull_[1]));
            level = newton > low && newton < high ? newton : (low + high) / 2;
        }
        return level;
    }

    const Draft &draft_;
    int points_, ny_, nx_;
    double apart_;
    Window across_weft_, across_warp_;
    double bending_, overlap_ = 0;
    std::array<double, 2> pull_; // warp, weft
    std::vector<double> upper_{}, lower_{};
};

} // namespace

double YarnPaths::warp_height(int end, int place) const {
    return warp[static_cast<std::size_t>(end) * static_cast<std::size_t>(warp_points) +
                static_cast<std::size_t>(wrap(place, warp_points))];
}

double YarnPaths::weft_height(int pick, int place) const {
    return weft[static_cast<std::size_t>(pick) * static_cast<std::size_t>(weft_points) +
                static_cast<std::size_t>(wrap(place, weft_points))];
}

YarnPaths solve_paths(const PathProblem &problem, const Progress &progress) {
    Solver solver(problem);
    const std::vector<double> z = solver.solve(progress);
    YarnPaths paths;
    paths.overlap = solver.overlap();
    paths.warp_points = problem.draft.picks * problem.points;
    paths.weft_points = problem.draft.ends * problem.points;
    const auto middle = z.begin() + static_cast<std::ptrdiff_t>(problem.draft.ends) *
                                        static_cast<std::ptrdiff_t>(paths.warp_points);
    paths.warp.assign(z.begin(), middle);
    paths.weft.assign(middle, z.end());
    const auto warp = std::minmax_element(paths.warp.begin(), paths.warp.end());
    const auto weft = std::minmax_element(paths.weft.begin(), paths.weft.end());
    const double top =
        std::max(*warp.second + problem.warp.radius, *weft.second + problem.weft.radius);
    const double bottom =
        std::min(*warp.first - problem.warp.radius, *weft.first - problem.weft.radius);
    paths.thickness = top - bottom;
    for (std::vector<double> *heights : {&paths.warp, &paths.weft})
        for (double &height : *heights)
            height -= (top + bottom) / 2;
    return paths;
}

} // namespace tsuya::lab::detail
