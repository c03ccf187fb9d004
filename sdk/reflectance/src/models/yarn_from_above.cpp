#include "models/yarn_from_above.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include <tbb/parallel_for.h>

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
// More surface than this is none of filaments that are seen from above
constexpr double kMostSurface = 2 * kFullCover;

// Of equal errors the roughest.
double cost(const Solution &s) { return s.error / std::pow(s.lobes.roughness, kRougher); }

} // namespace

const Solution &best_of(std::span<const Solution> tried) {
    return *std::min_element(tried.begin(), tried.end(), [](const Solution &a, const Solution &b) {
        return cost(a) < cost(b);
    });
}

FitFromAbove::FitFromAbove(const YarnProblem &fit, double f0, Rest rest, double least)
    : fit_(fit), f0_(f0), rest_(rest), roughness_{least} {
    std::copy_if(kRoughness.begin(), kRoughness.end(), std::back_inserter(roughness_),
                 [&](double r) { return r > least; });
}

Solution FitFromAbove::with(double roughness, double dive) const {
    Solution made{.lobes = {.f0 = f0_, .roughness = roughness, .dive = dive}, .rest = rest_};
    made.error = fit_.solve_with_pits(fit_.seen(roughness), made.lobes, rest_, made.x);
    return made;
}

template <class Make>
Solution FitFromAbove::best_made(const std::vector<double> &choices, Make make) const {
    std::vector<Solution> tried(choices.size());
    tbb::parallel_for(std::size_t{0}, tried.size(),
                      [&](std::size_t i) { tried[i] = make(choices[i]); });
    return best_of(tried);
}

Solution FitFromAbove::best() const {
    const Solution coarse = best_made(roughness_, [&](double r) { return with(r, kFirstDive); });
    const Solution deep = best_made(std::vector(kDives.begin(), kDives.end()), [&](double dive) {
        return with(coarse.lobes.roughness, dive);
    });
    return refined(deep);
}

Solution FitFromAbove::refined(Solution best) const {
    const auto at =
        std::find(roughness_.begin(), roughness_.end(), best.lobes.roughness) - roughness_.begin();
    const auto last = static_cast<std::ptrdiff_t>(roughness_.size()) - 1;
    double below = roughness_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(at - 1, 0))];
    double above = roughness_[static_cast<std::size_t>(std::min(at + 1, last))];
    for (int i = 0; i < kRefinements; ++i) {
        const double middle = best.lobes.roughness;
        const double low = std::sqrt(below * middle), high = std::sqrt(middle * above);
        const Solution next = best_made({low, middle, high}, [&](double r) {
            return r == middle ? best : with(r, best.lobes.dive);
        });
        below = next.lobes.roughness == low ? below : next.lobes.roughness == high ? middle : low;
        above = next.lobes.roughness == high ? above : next.lobes.roughness == low ? middle : high;
        best = next;
    }
    return best;
}

// The least that the views nearest to straight above resolve.
double least_roughness(const Bard &bard) {
    double nearest = kPi / 2;
    for (const BardView &view : bard.views())
        if (view.theta > 0)
            nearest = std::min(nearest, view.theta);
    return std::clamp(kResolved * nearest, kRoughness.front(), kCoarsestLeast);
}

Solution best_from_above(const YarnProblem &fit, double f0, double least) {
    Solution dark = FitFromAbove(fit, f0, Rest::loose, least).best();
    const YarnLobes &lobes = dark.lobes;
    if (total(lobes.surface[0]) + total(lobes.surface[1]) + lobes.loose <= kMostSurface)
        return dark;
    return FitFromAbove(fit, f0, Rest::even, least).best();
}

} // namespace tsuya
