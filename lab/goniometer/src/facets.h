#pragma once
// The facets of a rough surface, in the frame of its mean normal: Gaussian slopes, all directions
// alike (Beckmann's distribution [Walter]), with Smith's shadowing.

#include <cmath>

#include <glm/glm.hpp>

#include "random.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::lab {

// Share of unpolarised light that a smooth boundary reflects; 1 where all of it is.
// \param refractive_index of the far side over that of the near one
double fresnel(double cosine, double refractive_index);

class Facets {
  public:
    // \param slope standard deviation along one axis
    explicit Facets(double slope) : slope_(slope) {}

    double slope() const { return slope_; }
    // Smith's Lambda of a direction with the cosine mu > 0.
    double lambda(double mu) const;
    // Facets per solid angle, `cosine` being that of their normal with the mean one.
    double density(double cosine) const;
    // Draws the normal of a facet as seen from `from`: in proportion to the area that it shows.
    // \param from from.z > 0
    glm::vec3 visible_normal(const glm::vec3 &from, Random &random) const;
    // Draws the normal of a facet, whatever it shows.
    glm::vec3 any_normal(Random &random) const;

    // Sums over facets that face a direction with the cosine mu: add(shown, cosine, height), where
    // `shown` is the density of slopes times the area that is shown, `cosine` that of the direction
    // with the facet's normal and `height` that of the latter with the mean one. The sum over
    // `shown` times kCell is mu (1 + lambda(mu)).
    template <class Add> void each_facing(double mu, Add add) const {
        const double sine = std::sqrt(std::max(0.0, 1 - mu * mu));
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps / 2; ++j) { // symmetric across the plane of incidence
                const glm::dvec2 z{(i + 0.5) * kStep - kReach, (j + 0.5) * kStep};
                const double facing = mu + sine * slope_ * z.x;
                if (facing <= 0)
                    continue;
                const glm::dvec3 m = glm::normalize(glm::dvec3(slope_ * z, 1.0));
                const double density = std::exp(-0.5 * glm::dot(z, z)) / kPi; // of both halves
                add(density * facing, m.x * sine + m.z * mu, m.z);
            }
    }

  private:
    static constexpr int kSteps = 96;
    static constexpr double kReach = 6; // standard deviations
    static constexpr double kStep = 2 * kReach / kSteps;

    glm::vec2 visible_slopes(double mu, Random &random) const;

    double slope_;

  public:
    static constexpr double kCell = kStep * kStep;
};

} // namespace tsuya::lab
