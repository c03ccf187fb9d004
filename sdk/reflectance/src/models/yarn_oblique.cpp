#include "tsuya/sdk/yarn_lobes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "models/lit_views.h"
#include "models/oblique_rows.h"
#include "models/yarn_from_above.h"
#include "models/yarn_problem.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/yarn.h"
#include "views/mirror_views.h"

namespace tsuya {
namespace {

// Depths of pits that views under oblique light choose from: a coarse mesh, then around the best
constexpr std::array<double, 6> kDepths = {0, 0.05, 0.1, 0.2, 0.3, 0.45};
constexpr std::array<double, 2> kDepthSteps = {0.05, 0.025}; // a dozen views resolve no finer
// Least share of the diffuse part of views from above that a fit keeps: bright oblique views would
// trade it for slopes, and views on the side of the light would go dark
constexpr double kLeastEven = 0.5;

// Lights that the symmetry makes one, with their views.
using LightGroup = std::vector<LitViews>;

std::vector<double> around(double depth, double step) {
    return {std::max(depth - step, 0.0), depth, depth + step};
}

std::vector<LightGroup> groups_of(const ReflectanceTable &table, const std::string &where) {
    std::vector<LitViews> lights;
    std::vector<BardView> directions;
    for (const auto &[angles, rows] : oblique_rows(table, where)) {
        lights.emplace_back(direction_of(angles.first, angles.second), rows, table.symmetry);
        directions.push_back({.theta = angles.first, .phi = angles.second});
    }
    std::vector<LightGroup> groups;
    for (const MirrorGroup &group : mirror_groups(directions, table.symmetry)) {
        groups.emplace_back();
        for (const std::size_t i : group.members)
            groups.back().push_back(lights[i]);
    }
    return groups;
}

double worth_of(const LightGroup &group) {
    double sum = 0;
    for (const LitViews &light : group)
        sum += light.worth();
    return sum;
}

// Errors of the group's lights, each times what it is worth. Black has an error of 1, and no fit
// has more: views that are far too dark would decide for all, since nothing bounds their errors.
double error_of(const YarnBrdf &brdf, const LightGroup &group) {
    double sum = 0;
    for (const LitViews &light : group)
        sum += light.worth() *
               std::min(1.0, light.error([&](const glm::dvec3 &l, const glm::dvec3 &v) {
                   return static_cast<double>(brdf.evaluate(glm::vec3(l), glm::vec3(v)));
               }));
    return sum;
}

// Fits to the views from above and those under some of the oblique lights. The roughness and what
// yarns dive are those of the views from above, which tell them better than a dozen oblique ones.
class ObliqueSearch {
  public:
    ObliqueSearch(const Bard &bard, double f0, const Progress &progress)
        : above_(bard, f0, progress), symmetry_(bard.symmetry()), progress_(progress),
          start_(best_from_above(above_, f0, least_roughness(bard))), from_above_(start_.lobes) {
        start_.least_even = kLeastEven * from_above_.even;
    }
    const YarnLobes &from_above() const { return from_above_; }

    YarnLobes fit(const std::vector<LightGroup> &groups) const {
        return fit(groups, groups.size());
    }
    YarnLobes fit(const std::vector<LightGroup> &groups, std::size_t left_out) const {
        YarnProblem all = above_;
        std::size_t lights = 0;
        for (std::size_t i = 0; i < groups.size(); ++i)
            for (const LitViews &light : groups[i])
                if (i != left_out) {
                    all.add(light);
                    ++lights;
                }
        if (lights == 0)
            return from_above_;
        const Seen seen = all.seen(start_.lobes.roughness);
        const std::vector<double> depths(kDepths.begin(), kDepths.end());
        Solution best = best_of_depths(all, seen, start_, depths, depths);
        for (const double step : kDepthSteps)
            best = best_of_depths(all, seen, best, around(best.lobes.pit[0], step),
                                  around(best.lobes.pit[1], step));
        return best.lobes;
    }

    YarnBrdf rendered(const YarnLobes &lobes) const {
        return YarnBrdf(lobes, symmetry_, progress_);
    }

  private:
    // The best of all pairs of depths.
    static Solution best_of_depths(const YarnProblem &fit, const Seen &seen, const Solution &start,
                                   const std::vector<double> &weft,
                                   const std::vector<double> &warp) {
        std::vector<Solution> tried(weft.size() * warp.size(), start);
        tbb::parallel_for(std::size_t{0}, tried.size(), [&](std::size_t i) {
            Solution &next = tried[i];
            next.lobes.pit = {weft[i / warp.size()], warp[i % warp.size()]};
            next.error = fit.solve(seen, next.lobes, next.rest, next.x, next.least_even);
        });
        return best_of(tried);
    }

    YarnProblem above_;
    Symmetry symmetry_;
    const Progress &progress_;
    Solution start_;
    YarnLobes from_above_;
};

} // namespace

ObliqueFit fit_yarn_lobes(const Bard &bard, const ReflectanceTable &table, double f0,
                          const std::string &where, const Progress &progress) {
    check_table(table, where);
    if (!(bard.peak() > 0))
        throw Error({"the views under light from straight above are all 0", where,
                     "expected a value above 0"});
    const std::vector<LightGroup> groups = groups_of(table, where);
    const ObliqueSearch search(bard, f0, progress);
    const YarnBrdf from_above = search.rendered(search.from_above());
    std::vector<double> without(groups.size());
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
        without[i] = error_of(search.rendered(search.fit(groups, i)), groups[i]);
    });
    double worth = 0;
    ObliqueFit found{.lobes = search.from_above()};
    for (std::size_t i = 0; i < groups.size(); ++i) {
        worth += worth_of(groups[i]);
        found.left_out_l2_cos += without[i];
        found.from_above_l2_cos += error_of(from_above, groups[i]);
    }
    found.left_out_l2_cos /= worth;
    found.from_above_l2_cos /= worth;
    found.kept = found.left_out_l2_cos < found.from_above_l2_cos;
    if (found.kept)
        found.lobes = search.fit(groups);
    return found;
}

} // namespace tsuya
