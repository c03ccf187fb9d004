#pragma once
// The rough surface of a filament, in the frame of its mean normal.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "random.h"
#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

// Share of unpolarised light that a smooth boundary reflects, seen from the thinner side.
double fresnel(double cosine, double refractive_index);

// A lobe per solid angle proportional to g(mu) mu, mu the cosine with the normal; g tabulated.
class CosineLobe {
  public:
    CosineLobe() = default;
    // \param g values at mu = (k / (size - 1))^2
    explicit CosineLobe(std::vector<double> g);
    double value(double mu) const; // g
    double per_sr(double mu) const { return value(mu) * mu * scale_; }
    double integral() const { return integral_; } // of g mu over the hemisphere
    double sample(Random &random) const;          // mu

  private:
    std::vector<double> g_{};
    double largest_ = 0, integral_ = 0, scale_ = 0;
};

// Facets with Gaussian slopes and Smith's uncorrelated-height shadowing of correlated heights
// [Heitz]; what single reflection loses in the roughness comes back as the lobe of [KullaConty].
class RoughSurface {
  public:
    explicit RoughSurface(const FilamentOptics &optics);

    // What a photon with the cosine mu becomes. All members are shares of its energy.
    struct Reflection {
        glm::vec3 direction;
        double weight; // reflected; the rest enters
    };
    // Draws a reflection. \param from points away from the surface, from.z > 0
    Reflection sample(const glm::vec3 &from, Random &random) const;
    // Share per solid angle that one reflection at a facet sends from -> to.
    double single_per_sr(const glm::vec3 &from, const glm::vec3 &to) const;
    // The same for the lobe of several reflections.
    double multiple_per_sr(double mu_from, double mu_to) const;
    // Share of energy that several reflections take without Fresnel losses.
    double multiple_share(double mu) const { return lost_.value(mu); }
    // Where light that entered comes out.
    const CosineLobe &exit() const { return exit_; }

    double slope() const { return slope_; }
    double transmission() const { return transmission_; }

  private:
    double lambda(double mu) const;
    glm::vec2 visible_slopes(double mu, Random &random) const;
    // Sums over facets for one direction: reflected without and with Fresnel losses.
    glm::dvec2 single_albedo(double mu) const;

    double slope_, index_, transmission_;
    CosineLobe lost_{}, exit_{};
};

} // namespace tsuya::lab
