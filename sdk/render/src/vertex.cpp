#include "vertex.h"

namespace tsuya {

Weighed Vertex::weigh(const glm::vec3 &to_light) const {
    if (bulges_)
        if (const glm::vec3 local = point_.frame.to_local(to_light); local.z > 0)
            return shading_.weigh(local, to_viewer_, view_);
    const bool above = is_above(to_light);
    Weighed sum;
    for (const glm::vec3 &light : {to_light, mirrored(to_light)}) {
        const glm::vec3 local = point_.frame.to_local(light);
        if ((local.z > 0) == above)
            sum.add(shading_.weigh(local, to_viewer_, view_));
    }
    return sum;
}

std::optional<LightSample> Vertex::sample(glm::vec2 part, glm::vec2 direction) const {
    std::optional<LightSample> sampled = shading_.sample(to_viewer_, view_, part, direction);
    if (!sampled)
        return std::nullopt;

    // To the side of the triangle that the cloth scatters to
    const bool through = sampled->to_light.z < 0;
    sampled->to_light = point_.frame.to_world(sampled->to_light);
    if (bulges_ && !through)
        return sampled->weighed.pdf > 0 ? sampled : std::nullopt;
    if (is_above(sampled->to_light) == through)
        sampled->to_light = mirrored(sampled->to_light);

    // Where its mirror image could have been sampled too, both count
    const glm::vec3 other = point_.frame.to_local(mirrored(sampled->to_light));
    if ((other.z > 0) != through)
        sampled->weighed = weigh(sampled->to_light);
    if (!(sampled->weighed.pdf > 0))
        return std::nullopt;
    return sampled;
}

glm::vec3 Vertex::ray_origin(const glm::vec3 &direction) const {
    const bool over = passes_over(direction);
    const glm::vec3 origin =
        point_.position +
        (over || is_above(direction) ? point_.error : -point_.error) * point_.geometric_normal;
    if (!over)
        return origin;
    const float height = glm::length(point_.bulge);
    return scene_.accelerator.occluded(origin, point_.bulge / height, height)
               ? origin
               : origin + point_.bulge;
}

} // namespace tsuya
