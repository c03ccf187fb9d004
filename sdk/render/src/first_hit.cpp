#include "first_hit.h"

namespace tsuya {

FirstHit first_hit_of(const TracedScene &scene, const Hit &hit, const SurfacePoint &point,
                      const Colours &colours, int channels) {
    FirstHit first{.hit = true,
                   .distance = hit.distance,
                   .normal = point.frame.normal,
                   .warp = point.warp,
                   .weft = scene.weft_at(hit, point),
                   .uv = scene.uv_at(hit),
                   .dye = thirds(colours.dye.data(), channels),
                   .object = hit.object,
                   .fabric = scene.fabric_of(point),
                   .panel = scene.panel_of(hit)};
    for (std::size_t k = 0; k < static_cast<std::size_t>(channels); ++k)
        first.albedo[k] = colours.dye[k] + 0.5f * (colours.weft_body[k] + colours.warp_body[k]);
    return first;
}

} // namespace tsuya
