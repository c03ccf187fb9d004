#pragma once
// A material with its colours in K channels: the specular model, and below it the dye.

#include <algorithm>
#include <optional>

#include "channels.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya {

// f cos of the two parts, before their colours: 1/sr.
struct Response {
    float diffuse = 0;
    float specular = 0;
};

// What is the same for all lights of one view.
struct ViewTerms {
    float diffuse_scale = 1;  // (1 - albedo(V)) / (1 - mean albedo)
    float specular_share = 0; // probability of drawing from the specular part
};

struct DrawnLight {
    glm::vec3 to_light;
    Response response;
    float pdf;
};

// Colourless part of a material. The dye lies below the specular surface: light that the surface
// reflects does not reach it, so rho_d is scaled by (1 - A(L)) (1 - A(V)) / (1 - mean A), A the
// specular albedo. Differs from [Takeda] Eq. 18, which adds rho_d/pi as it is and then reflects
// more than it receives; the coupling is that of [Kelemen].
class Shading {
  public:
    Shading(const Material &material, float dye_mean, float tint_mean, bool keep_idle_parts);

    ViewTerms view_terms(const glm::vec3 &to_viewer) const;
    struct Weighed {
        Response f_cos;
        float pdf = 0; // of `sample`
    };
    Weighed weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                  const ViewTerms &view) const;
    std::optional<DrawnLight> sample(const glm::vec3 &to_viewer, const ViewTerms &view,
                                     glm::vec2 choice, glm::vec2 direction) const;

  private:
    float diffuse_cos(const glm::vec3 &to_light, const ViewTerms &view) const;
    float albedo(const glm::vec3 &direction) const;

    std::optional<Brdf> specular_;
    bool diffuse_, couples_;
    float dye_mean_, tint_mean_;
    float mean_albedo_ = 0;
};

} // namespace tsuya
