#pragma once
// The rough boundary of a filament that light passes through, from both of its sides.

#include <array>

#include <glm/glm.hpp>

#include "facets.h"
#include "rough_surface.h"
#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

// The side of a boundary that light comes from.
enum class Side { outside, inside };

// Facets that reflect and refract by the exact Fresnel term [Walter]. Light that they lose because
// its way is shadowed comes back: what is reflected as the lobe of RoughSurface, the rest on both
// sides, in proportion to what is lost there. So the boundary neither makes nor loses light, and is
// reciprocal: p(from -> to) n_from^2 cos_from is the same there and back. Directions are in the
// frame whose z is the normal on the side of `from`, and point away from the surface.
class RoughDielectric {
  public:
    // How the normals of facets are drawn. Only `visible` is right; the other is what tests are
    // tested with.
    enum class Normals { visible, all };

    // \param surface of the same optics
    RoughDielectric(const FilamentOptics &optics, const RoughSurface &surface,
                    Normals normals = Normals::visible);

    struct Passage {
        glm::vec3 direction;
        bool through; // to the other side: direction.z < 0
    };
    // Draws what a photon does. \param from from.z > 0
    Passage sample(const glm::vec3 &from, Side side, Random &random) const;

    // Share per solid angle that one refraction sends from -> to. \param to to.z < 0
    double through_per_sr(const glm::vec3 &from, const glm::vec3 &to, Side side) const;
    // Where a smooth boundary refracts to; along the surface where nothing passes.
    glm::vec3 refracted(const glm::vec3 &from, Side side) const;
    // Whether more than 3e-7 of the facets let light pass.
    bool passes(const glm::vec3 &from, Side side) const;

    // What comes back on both sides: the share of the light from a direction, and that per solid
    // angle to a direction on one side. Cosines are positive.
    double even_share(double mu_from, Side side) const { return rest(side).value(mu_from); }
    double even_per_sr(double mu_from, Side side, double mu_to, Side to) const {
        const double share = to == Side::outside ? outside_share_ : 1 - outside_share_;
        return rest(side).value(mu_from) * share * rest(to).per_sr(mu_to);
    }

  private:
    const CosineLobe &rest(Side side) const { return rest_[side == Side::inside ? 1 : 0]; }
    double index_ratio(Side side) const { return side == Side::outside ? index_ : 1 / index_; }
    // Shares that single reflection and refraction send on their way.
    double single_albedo(double mu, Side side) const;
    Passage sample_lost(double mu, Side side, Random &random) const;

    Facets facets_;
    double index_;
    Normals normals_;
    CosineLobe lost_{};                // of reflections, without Fresnel losses
    std::array<double, 2> mean_{};     // per side: Fresnel's term over that lobe
    std::array<CosineLobe, 2> rest_{}; // per side: lost otherwise
    double outside_share_ = 0;         // of what comes back on both sides
};

} // namespace tsuya::lab
