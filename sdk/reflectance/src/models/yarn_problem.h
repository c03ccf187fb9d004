#pragma once
// The least-squares problem of which filaments a cloth is made of.

#include <array>
#include <vector>

#include <Eigen/Dense>
#include <glm/glm.hpp>

#include "models/lit_views.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/yarn_depth.h"
#include "tsuya/sdk/detail/yarn_optics.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

inline constexpr double kFullCover = kPi / 2; // surface of level filaments side by side

// Surface of one system over that of the cloth.
double total(const std::array<double, kYarnSlopes> &surface);

// A row that is fitted.
struct FittedView {
    glm::vec3 to_light, to_viewer;
    double value, weight;
};

// What is neither of the weft nor of the warp: loose filaments, or the diffuse part.
enum class Rest { loose, even };

// A view by filaments of one roughness. What follows is times the view's weight.
struct SeenView {
    glm::vec3 half;
    YarnSpan span;
    glm::dvec2 reach; // of weft and warp, but for their depth
    double loose;     // of a surface of 1
};

// The views by filaments of one roughness.
struct Seen {
    std::vector<SeenView> views{};
    Eigen::MatrixXd lobes{}; // of all unknowns at the views, a row a view
};

// The problem min |B x - f|^2 + bending + steepness over x >= 0 for one roughness. Unknown are the
// surfaces at the slopes of weft and warp and the rest; a symmetric cloth has as much at a slope as
// at its opposite. The views under light from straight above have a weight of 1 together, those
// under an oblique light as much as they are worth in views from above.
class YarnProblem {
  public:
    YarnProblem(const Bard &bard, double f0, const Progress &progress);
    /// Adds views under an oblique light.
    void add(const LitViews &oblique);
    Seen seen(double roughness) const;
    /// Returns the weighted relative error; sets the surfaces and the rest. Of the diffuse part it
    /// is `least_even` or more.
    /// \param x the unknowns: where the search starts if it is not empty, and what it found
    double solve(const Seen &seen, YarnLobes &lobes, Rest rest, Eigen::VectorXd &x,
                 double least_even = 0) const;
    /// The same with the pits that follow from the shares of the systems, and the depths from the
    /// slopes.
    double solve_with_pits(const Seen &seen, YarnLobes &lobes, Rest rest, Eigen::VectorXd &x) const;

  private:
    int unknowns_of_system() const;
    Eigen::Index both_systems() const { return Eigen::Index{2} * unknowns_of_system(); }
    // Radians
    double slope(int unknown) const { return yarn_slope(static_cast<int>(index(unknown))); }
    std::size_t index(int unknown) const;
    void add_light(const LitViews &lit, double share);
    Eigen::MatrixXd basis(const Seen &seen, const YarnLobes &lobes, Rest rest) const;
    Eigen::MatrixXd bending() const;
    void store(const Eigen::VectorXd &x, Rest rest, YarnLobes &lobes) const;

    const Progress &progress_; // every step throws Interrupted
    bool symmetric_;
    float f0_;
    std::vector<FittedView> views_{};
    Eigen::Index above_ = 0;   // views under light from straight above, the first
    double worth_above_ = 0;   // of them
    Eigen::VectorXd target_{}; // weight times the value
};

} // namespace tsuya
