#pragma once
// The rough surface of a filament, in the frame of its mean normal.

#include <algorithm>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "facets.h"
#include "random.h"
#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

// A lobe per solid angle proportional to g(mu) mu, mu the cosine with the normal; g tabulated.
class CosineLobe {
  public:
    CosineLobe() = default;
    // \param g values at mu = (k / (size - 1))^2
    explicit CosineLobe(std::vector<double> g);
    // The lobe whose g is `of(mu)`, tabulated
    template <class Function> static CosineLobe tabulate(Function of) {
        std::vector<double> g(kNodes);
        for (std::size_t k = 0; k < kNodes; ++k)
            g[k] = of(node(k));
        return CosineLobe(std::move(g));
    }
    double value(double mu) const; // g
    double per_sr(double mu) const { return value(mu) * mu * scale_; }
    double integral() const { return integral_; } // of g mu over the hemisphere
    double sample(Random &random) const;          // mu

  private:
    static constexpr std::size_t kNodes = 128;
    static double node(std::size_t k) {
        const double x = static_cast<double>(k) / (kNodes - 1);
        return std::max(x * x, 1e-6);
    }

    std::vector<double> g_{};
    double largest_ = 0, integral_ = 0, scale_ = 0;
};

// Facets with the shadowing of correlated heights [Heitz]; what single reflection loses in the
// roughness comes back as the lobe of [KullaConty]. What enters is not followed here.
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
    // The lobe of several reflections before Fresnel losses.
    const CosineLobe &lost() const { return lost_; }

    double slope() const { return facets_.slope(); }

  private:
    // Share that single reflections without Fresnel losses send upwards.
    double single_albedo(double mu) const;

    Facets facets_;
    double index_;
    CosineLobe lost_{};
};

} // namespace tsuya::lab
