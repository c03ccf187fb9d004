#include "tsuya/sdk/yarn_lobes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>

#include <tbb/parallel_for.h>

#include "models/facets.h"
#include "models/yarn_problem.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// Roughnesses that are tried first, then between the neighbours of the best. Of fits that are equal
// within a per cent the roughest is taken: the error may grow as this power of it
constexpr std::array<double, 9> kRoughness = {0.005, 0.012, 0.03, 0.05, 0.08, 0.13, 0.2, 0.35, 0.6};
// Of the angle between views: half of it is between half vectors, and narrower lobes look alike
constexpr double kResolved = 0.25, kCoarsestLeast = 0.04;
constexpr int kRefinements = 5;
constexpr double kRougher = 0.01;
// Depths to which yarns dive that are tried, in their widths: no deeper than yarns are thick
constexpr std::array<double, 4> kDives = {0, 0.1, 0.2, 0.3};
constexpr double kFirstDive = 0.2;
constexpr double kNearRoughness = 1.4; // factor of those that oblique views choose from
// More surface than this is none of filaments that are seen from above
constexpr double kMostSurface = 2 * kFullCover;

// Depths of pits that views under oblique light choose from: a coarse mesh for every roughness,
// then around the best
constexpr std::array<double, 6> kDepths = {0, 0.05, 0.1, 0.2, 0.3, 0.45};
constexpr std::array<double, 2> kDepthSteps = {0.05, 0.025}; // a dozen views resolve no finer
// Least share of the diffuse part of views from above that a fit keeps: bright oblique views would
// trade it for slopes, and views on the side of the light would go dark
constexpr double kLeastEven = 0.5;

struct Solution {
    YarnLobes lobes{};
    Rest rest = Rest::loose;
    Eigen::VectorXd x{}; // the unknowns that make the lobes
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
Solution best_of_depths(const YarnProblem &fit, const Solution &start,
                        const std::vector<double> &weft, const std::vector<double> &warp) {
    const Seen seen = fit.seen(start.lobes.roughness);
    std::vector<Solution> tried(weft.size() * warp.size(), start);
    tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t i) {
        tried[i].lobes.pit = {weft[i / warp.size()], warp[i % warp.size()]};
        tried[i].error = fit.solve(seen, tried[i].lobes, start.rest, tried[i].x, start.least_even);
    });
    return least_error(tried);
}

std::vector<double> around(double depth, double step) {
    return {std::max(depth - step, 0.0), depth, depth + step};
}

// Of equal errors the roughest.
double cost(const Solution &s) { return s.error / std::pow(s.lobes.roughness, kRougher); }

const Solution &least_cost(std::span<const Solution> tried) {
    return *std::min_element(tried.begin(), tried.end(), [](const Solution &a, const Solution &b) {
        return cost(a) < cost(b);
    });
}

// The fit to views from above with filaments of given roughnesses.
class FitFromAbove {
  public:
    /// \param least roughness that the views tell from smaller ones
    FitFromAbove(const YarnProblem &fit, double f0, Rest rest, double least)
        : fit_(fit), f0_(f0), rest_(rest), roughness_{least} {
        std::copy_if(kRoughness.begin(), kRoughness.end(), std::back_inserter(roughness_),
                     [&](double r) { return r > least; });
    }

    Solution with(double roughness, double dive) const {
        Solution made{.lobes = {.f0 = f0_, .roughness = roughness, .dive = dive}, .rest = rest_};
        made.error = fit_.solve_with_pits(fit_.seen(roughness), made.lobes, rest_, made.x);
        return made;
    }
    Solution best() const {
        const Solution coarse = best_of(roughness_, [&](double r) { return with(r, kFirstDive); });
        const Solution deep = best_of(std::vector(kDives.begin(), kDives.end()), [&](double dive) {
            return with(coarse.lobes.roughness, dive);
        });
        return refined(deep);
    }

  private:
    template <class Make> Solution best_of(const std::vector<double> &choices, Make make) const {
        std::vector<Solution> tried(choices.size());
        tbb::parallel_for(std::size_t{0}, tried.size(),
                          [&](std::size_t i) { tried[i] = make(choices[i]); });
        return least_cost(tried);
    }

    // Ever nearer to the best on both sides.
    Solution refined(Solution best) const {
        const auto at = std::find(roughness_.begin(), roughness_.end(), best.lobes.roughness) -
                        roughness_.begin();
        const auto last = static_cast<std::ptrdiff_t>(roughness_.size()) - 1;
        double below = roughness_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(at - 1, 0))];
        double above = roughness_[static_cast<std::size_t>(std::min(at + 1, last))];
        for (int i = 0; i < kRefinements; ++i) {
            const double middle = best.lobes.roughness;
            const double low = std::sqrt(below * middle), high = std::sqrt(middle * above);
            const Solution next = best_of({low, middle, high}, [&](double r) {
                return r == middle ? best : with(r, best.lobes.dive);
            });
            below = next.lobes.roughness == low    ? below
                    : next.lobes.roughness == high ? middle
                                                   : low;
            above = next.lobes.roughness == high  ? above
                    : next.lobes.roughness == low ? middle
                                                  : high;
            best = next;
        }
        return best;
    }

    const YarnProblem &fit_;
    double f0_;
    Rest rest_;
    std::vector<double> roughness_;
};

// The least that the views nearest to straight above resolve.
double least_roughness(const Bard &bard) {
    double nearest = kPi / 2;
    for (const BardView &view : bard.views())
        if (view.theta > 0)
            nearest = std::min(nearest, view.theta);
    return std::clamp(kResolved * nearest, kRoughness.front(), kCoarsestLeast);
}

Solution best_from_above(const YarnProblem &fit, double f0, double least) {
    const Solution dark = FitFromAbove(fit, f0, Rest::loose, least).best();
    const YarnLobes &lobes = dark.lobes;
    if (total(lobes.surface[0]) + total(lobes.surface[1]) + lobes.loose <= kMostSurface)
        return dark;
    return FitFromAbove(fit, f0, Rest::even, least).best();
}

} // namespace

YarnLobes fit_yarn_lobes(const Bard &bard, double f0, const Progress &progress) {
    if (!(bard.peak() > 0))
        return {.f0 = checked_f0(f0)}; // black: nothing is on any slope
    return best_from_above(YarnProblem(bard, f0, progress), f0, least_roughness(bard)).lobes;
}

YarnLobes fit_yarn_lobes(const Bard &bard, const ReflectanceTable &table, double f0,
                         const std::string &where, const Progress &progress) {
    check_table(table, where);
    if (!(bard.peak() > 0))
        throw Error({"the views under light from straight above are all 0", where,
                     "expected a value above 0"});
    const YarnProblem above(bard, f0, progress);
    YarnProblem fit(bard, f0, progress);
    fit.add_oblique(table, where);
    const std::vector<double> depths(kDepths.begin(), kDepths.end());
    const double least = least_roughness(bard);
    const Solution start = best_from_above(above, f0, least);
    std::vector<Solution> tried;
    // Views from above tell the roughness better than a dozen oblique ones
    for (const double factor : {1 / kNearRoughness, 1.0, kNearRoughness}) {
        const double roughness = std::max(factor * start.lobes.roughness, least);
        Solution next =
            FitFromAbove(above, f0, start.rest, least).with(roughness, start.lobes.dive);
        next.least_even = kLeastEven * next.lobes.even;
        tried.push_back(best_of_depths(fit, next, depths, depths));
    }
    Solution best = least_error(tried);
    for (const double step : kDepthSteps)
        best = best_of_depths(fit, best, around(best.lobes.pit[0], step),
                              around(best.lobes.pit[1], step));
    return best.lobes;
}

} // namespace tsuya
