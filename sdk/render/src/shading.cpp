#include "shading.h"

#include <cmath>
#include <utility>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr LambertBrdf kLambert{};
// Least share of the samples that either part gets where both reflect.
constexpr float kLeastShare = 0.1f;

} // namespace

Shading::Shading(const Material &material, const MeanColours &means, bool keep_idle_parts)
    : diffuse_(material.has_diffuse() || keep_idle_parts), couples_(material.has_specular()),
      two_tints_(material.weft_tint != material.warp_tint),
      two_dyes_(material.weft_body != material.warp_body), means_(means),
      transmitted_share_(
          means.transmittance > 0 ? means.transmittance / (means.dye + means.transmittance) : 0) {
    body_ = material.body;
    near_ = material.near;
    if (!material.specular || !(material.has_specular() || keep_idle_parts))
        return;
    specular_ = material.specular;
    mean_passed_ = mean_passed(*specular_);
}

float Shading::albedo(const glm::vec3 &direction) const {
    // Of models that are not limited in energy it may exceed 1
    return std::min(1.0f, specular_->albedo_of_light(direction));
}

ViewTerms Shading::view_terms(const glm::vec3 &to_viewer) const {
    if (!specular_)
        return {};
    ViewTerms view;
    if (couples_)
        view.diffuse_scale = (1 - albedo(to_viewer)) / mean_passed_;
    share_samples(to_viewer, view);
    return view;
}

// In proportion to what each part reflects, but for the least share of the two.
void Shading::share_samples(const glm::vec3 &to_viewer, ViewTerms &view) const {
    const float bright = specular_ ? means_.specular * specular_->albedo_of_view(to_viewer) : 0;
    const float even = diffuse_ ? (means_.dye + means_.transmittance) * view.diffuse_scale : 0.0f;
    const float body = body_ ? means_.body * body_->albedo(to_viewer) : 0.0f;
    const float dyed = even + body;
    if (!diffuse_ && !body_)
        view.specular_share = 1;
    else
        view.specular_share = dyed > 0 && bright > 0 ? std::clamp(bright / (bright + dyed),
                                                                  kLeastShare, 1 - kLeastShare)
                                                     : (bright > 0 ? 1.0f : 0.0f);
    if (body > 0)
        view.body_share = (1 - view.specular_share) * body / dyed;
}

float Shading::diffuse_cos(const glm::vec3 &to_light, const ViewTerms &view) const {
    const float f = kLambert.evaluate_cos(to_light, {0, 0, 1});
    return couples_ ? f * view.diffuse_scale * (1 - albedo(to_light)) : f;
}

// What is scattered diffusely to the side of the light.
float Shading::even_cos(const glm::vec3 &to_light, const ViewTerms &view) const {
    const float f = diffuse_cos(to_light, view);
    return view.near ? f * near_->diffuse(*view.near) : f;
}

void Shading::add_specular(Response &response, glm::vec2 all_and_weft, const glm::vec3 &to_light,
                           const glm::vec3 &to_viewer, const ViewTerms &view) const {
    auto [all, weft] = std::pair(all_and_weft.x, all_and_weft.y);
    if (view.near) {
        const glm::vec2 here = near_->surface(*view.near, to_light, to_viewer);
        const float warp = all - weft;
        weft *= here.x;
        all = weft + warp * here.y;
    }
    response.weft = two_tints_ ? weft : 0.0f;
    response.warp = all - response.weft;
}

void Shading::add_body(Weighed &weighed, const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                       const ViewTerms &view) const {
    WeighedLight b = body_->weigh(to_light, to_viewer);
    if (view.near) {
        const glm::vec2 here = near_->body(*view.near, to_light, to_viewer);
        const float warp = b.f_cos - b.weft;
        b.weft *= here.x;
        b.f_cos = b.weft + warp * here.y;
    }
    weighed.f_cos.weft_body = two_dyes_ ? b.weft : 0.0f;
    weighed.f_cos.warp_body = b.f_cos - weighed.f_cos.weft_body;
    weighed.pdf += view.body_share * b.pdf_per_sr;
}

Weighed Shading::weigh(const glm::vec3 &to_light, const glm::vec3 &to_viewer,
                       const ViewTerms &view) const {
    Weighed w;
    if (!(to_viewer.z > 0))
        return w;
    const float diffuse_share = view.diffuse_share();
    if (to_light.z < 0 && transmits()) {
        const glm::vec3 through(to_light.x, to_light.y, -to_light.z);
        w.f_cos.transmitted = diffuse_cos(through, view);
        w.pdf = diffuse_share * transmitted_share_ * kLambert.pdf(through, to_viewer);
    }
    if (!(to_light.z > 0))
        return w;
    if (diffuse_) {
        w.f_cos.diffuse = even_cos(to_light, view);
        w.pdf = diffuse_share * (1 - transmitted_share_) * kLambert.pdf(to_light, to_viewer);
    }
    if (specular_) {
        const WeighedLight s = specular_->weigh(to_light, to_viewer);
        add_specular(w.f_cos, {s.f_cos, s.weft}, to_light, to_viewer, view);
        w.pdf += view.specular_share * s.pdf_per_sr;
    }
    if (body_)
        add_body(w, to_light, to_viewer, view);
    return w;
}

std::optional<LightSample> Shading::sample(const glm::vec3 &to_viewer, const ViewTerms &view,
                                           glm::vec2 choice, glm::vec2 direction) const {
    if (!(to_viewer.z > 0))
        return std::nullopt;
    const glm::vec3 u(direction, choice.y);
    if (specular_ && choice.x < view.specular_share) {
        const auto sampled = specular_->sample(to_viewer, u);
        if (!sampled)
            return std::nullopt;
        LightSample light{
            sampled->direction, {{}, view.specular_share * sampled->pdf_per_sr}, true};
        Weighed &w = light.weighed;
        add_specular(w.f_cos,
                     {sampled->weight * sampled->pdf_per_sr, sampled->weft * sampled->pdf_per_sr},
                     light.to_light, to_viewer, view);
        if (diffuse_) {
            w.f_cos.diffuse = even_cos(light.to_light, view);
            w.pdf += view.diffuse_share() * (1 - transmitted_share_) *
                     kLambert.pdf(light.to_light, to_viewer);
        }
        if (body_)
            add_body(w, light.to_light, to_viewer, view);
        return light;
    }
    if (body_ && choice.x < view.specular_share + view.body_share) {
        const glm::vec3 to_light = body_->draw(to_viewer, u);
        if (!(to_light.z > 0))
            return std::nullopt;
        return LightSample{to_light, weigh(to_light, to_viewer, view)};
    }
    glm::vec3 to_light = kLambert.draw(to_viewer, u);
    if (!(to_light.z > 0) || !diffuse_)
        return std::nullopt;
    if (choice.y < transmitted_share_)
        to_light.z = -to_light.z;
    return LightSample{to_light, weigh(to_light, to_viewer, view)};
}

} // namespace tsuya
