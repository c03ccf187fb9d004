#pragma once
// A material without its colours: the specular model above the diffuse part.

#include <algorithm>
#include <memory>
#include <optional>

#include "channels.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/near_yarn.h"

namespace tsuya {

// f cos of the parts, before their colours: 1/sr.
struct Response {
    float diffuse = 0;
    float transmitted = 0; // diffuse, of light from behind
    // Specular, and coloured light that follows the yarns; all of it warp where one colour serves
    // both systems
    float weft = 0, warp = 0, weft_body = 0, warp_body = 0;

    float sum() const { return diffuse + transmitted + weft + warp + weft_body + warp_body; }
    void add(const Response &r) {
        diffuse += r.diffuse;
        transmitted += r.transmitted;
        weft += r.weft;
        warp += r.warp;
        weft_body += r.weft_body;
        warp_body += r.warp_body;
    }
};

// f cos of one direction, and the density of sampling it.
struct Weighed {
    Response f_cos{};
    float pdf = 0; // 1/sr

    void add(const Weighed &w) {
        f_cos.add(w.f_cos);
        pdf += w.pdf;
    }
};

struct LightSample {
    glm::vec3 to_light; // in the cloth's frame z < 0: behind it
    Weighed weighed{};
    bool mirrored = false; // at the surface; else scattered diffusely, or in the body
};

// Means of a material's colours over the channels.
struct MeanColours {
    float dye = 0, transmittance = 0, specular = 0, body = 0;
};

// What is the same for all lights of one view.
struct ViewTerms {
    float diffuse_scale = 1;         // (1 - albedo(V)) / (1 - mean albedo)
    float specular_share = 0;        // probability of sampling the specular part
    float body_share = 0;            // and the body
    const NearPlace *near = nullptr; // of the weave; null: the far field

    float diffuse_share() const { return 1 - specular_share - body_share; }
};

// How a material scatters, before its colours. The dye lies below the specular surface: light that
// the surface reflects does not reach it, so rho_d is scaled by (1 - A(L)) (1 - A(V)) / (1 - mean
// A), A the specular albedo. Differs from [Takeda] Eq. 18, which adds rho_d/pi as it is and then
// reflects more than it receives; the coupling is that of [Kelemen]. What the dyed cloth lets
// through to its other side is scaled in the same way.
class Shading {
  public:
    Shading(const Material &material, const MeanColours &means, bool keep_idle_parts);

    // The near field of the cloth; null where it has none.
    const NearYarn *near() const { return near_.get(); }
    // Light from behind is scattered to the viewer.
    bool transmits() const { return transmitted_share_ > 0; }
    ViewTerms view_terms(const glm::vec3 &to_viewer) const;
    // to_light.z < 0: from behind
    Weighed weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                  const ViewTerms &view) const;
    std::optional<LightSample> sample(const glm::vec3 &to_viewer, const ViewTerms &view,
                                      glm::vec2 choice, glm::vec2 direction) const;

  private:
    float diffuse_cos(const glm::vec3 &to_light, const ViewTerms &view) const;
    float even_cos(const glm::vec3 &to_light, const ViewTerms &view) const;
    void add_specular(Response &response, glm::vec2 all_and_weft, const glm::vec3 &to_light,
                      const glm::vec3 &to_viewer, const ViewTerms &view) const;
    void add_body(Weighed &weighed, const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                  const ViewTerms &view) const;
    void share_samples(const glm::vec3 &to_viewer, ViewTerms &view) const;
    float albedo(const glm::vec3 &direction) const;

    std::shared_ptr<const Brdf> specular_; // of the material
    std::shared_ptr<const NearYarn> near_;
    std::shared_ptr<const BodyBrdf> body_; // the coloured part that follows the yarns
    bool diffuse_, couples_;
    bool two_tints_, two_dyes_;
    MeanColours means_;
    float transmitted_share_; // of the samples of the diffuse part
    float mean_passed_ = 1;   // of what the specular part does not reflect
};

} // namespace tsuya
