#pragma once
// The search for the filaments that views under light from straight above show.

#include <limits>
#include <span>
#include <vector>

#include "models/yarn_problem.h"

namespace tsuya {

// Filaments that were found.
struct Solution {
    YarnLobes lobes{};
    Rest rest = Rest::loose;
    Eigen::VectorXd x{}; // the unknowns that make the lobes
    double least_even = 0;
    double error = std::numeric_limits<double>::infinity();
};

// That of the least error; of errors that are equal within a per cent the roughest.
const Solution &best_of(std::span<const Solution> tried);

// The fit to views from above with filaments of given roughnesses.
class FitFromAbove {
  public:
    /// \param least roughness that the views tell from smaller ones
    FitFromAbove(const YarnProblem &fit, double f0, Rest rest, double least);

    Solution with(double roughness, double dive) const;
    Solution best() const;

  private:
    template <class Make> Solution best_made(const std::vector<double> &choices, Make make) const;
    // Ever nearer to the best on both sides.
    Solution refined(Solution best) const;

    const YarnProblem &fit_;
    double f0_;
    Rest rest_;
    std::vector<double> roughness_;
};

// The least that the views nearest to straight above resolve.
double least_roughness(const Bard &bard);

// With loose filaments; with a diffuse part in their place where filaments cannot be so many.
Solution best_from_above(const YarnProblem &fit, double f0, double least);

} // namespace tsuya
