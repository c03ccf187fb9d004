#pragma once
// Integrals over the upper hemisphere, by bins of theta and phi, and the test of a sample of
// directions against them. Nothing here knows a reflectance model.

#include <functional>
#include <optional>
#include <random>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::test {

struct HemisphereBins {
    int thetas = 12, phis = 24;
    int count() const { return thetas * phis; }
    int bin_of(const glm::vec3 &direction) const;
};

// Integrals of a function over every bin, by cells that are split where the function varies most
// until `evaluations` are spent. Steps are resolved, which Gauss rules would ring at.
std::vector<double> integrate_bins(const std::function<double(const glm::vec3 &)> &function,
                                   const HemisphereBins &bins, int evaluations);

// The integral over the whole hemisphere.
double integrate(const std::function<double(const glm::vec3 &)> &function, int evaluations);

// Probability of a chi-square at least this high.
double chi_square_tail(double chi_square, int degrees_of_freedom);

// Pearson's test of counts against expected counts; bins that expect less than 5 are merged.
double chi_square_p_value(const std::vector<double> &observed, const std::vector<double> &expected);

// The p-value below which one of `tests` fails, so that all hold with probability 99 %.
double sidak_threshold(int tests);

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    // In [0, 1), 24 bits
    float number() { return static_cast<float>(engine_() >> 40) * 0x1p-24f; }
    glm::vec3 point() {
        const float x = number(), y = number();
        return {x, y, number()};
    }
    // Even over the upper hemisphere
    glm::vec3 direction();

  private:
    std::mt19937_64 engine_;
};

} // namespace tsuya::test
