#include "path_tracer.h"

#include <cmath>
#include <limits>

#include "ray_offset.h"

namespace tsuya {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// A shadow ray ends this share short of the light.
constexpr float kShadowReach = 1.0f - 1e-4f;
// Paths may end by chance from this vertex on.
constexpr std::uint32_t kSurvivalFrom = 3;

// A tent of two pixels width.
float tent(float u) { return u < 0.5f ? std::sqrt(2 * u) - 1 : 1 - std::sqrt(2 * (1 - u)); }

// The light seen in the mirror of the surface's geometric plane.
glm::vec3 mirrored(const glm::vec3 &d, const glm::vec3 &geometric_normal) {
    return d - 2 * glm::dot(d, geometric_normal) * geometric_normal;
}

} // namespace

template <int K> struct PathTracer<K>::Vertex {
    const SurfacePoint &point;
    const Shading &shading;
    const Colours<Channels<K>> &colours;
    glm::vec3 to_viewer; // local
    ViewTerms view;
    std::uint32_t depth;

    // f cos and pdf of a light on either side of the geometric surface. Directions that the shading
    // normal's hemisphere has on the other side of it are folded back, so that no energy is lost
    // and none leaks through.
    Shading::Weighed weigh(const glm::vec3 &to_light) const {
        const bool above = glm::dot(to_light, point.geometric_normal) > 0;
        Shading::Weighed w;
        for (const glm::vec3 &light : {to_light, mirrored(to_light, point.geometric_normal)}) {
            const glm::vec3 local = point.frame.to_local(light);
            if ((local.z > 0) != above)
                continue;
            const Shading::Weighed part = shading.weigh(local, to_viewer, view);
            w.f_cos.add(part.f_cos);
            w.pdf += part.pdf;
        }
        return w;
    }

    // Rays start on this side of the surface.
    glm::vec3 origin(const glm::vec3 &direction) const {
        const bool above = glm::dot(direction, point.geometric_normal) > 0;
        return offset_ray(point.position, above ? point.geometric_normal : -point.geometric_normal);
    }

    void colour(const Response &r, float scale, Channels<K> &result) const {
        for (std::size_t k = 0; k < K; ++k)
            result.v[k] = (colours.dye.v[k] * r.diffuse + colours.warp.v[k] * r.warp) * scale;
        if (r.weft > 0)
            result.add(colours.weft, r.weft * scale);
        if (r.transmitted > 0)
            result.add(colours.transmittance, r.transmitted * scale);
    }
};

template <int K> PathTracer<K>::PathTracer(const PreparedScene &prepared) : p_(prepared) {
    for (const Colours<std::vector<float>> &from : prepared.colours) {
        Colours<Channels<K>> &to = colours_.emplace_back();
        std::copy_n(from.dye.begin(), K, to.dye.v.begin());
        std::copy_n(from.transmittance.begin(), K, to.transmittance.v.begin());
        std::copy_n(from.weft.begin(), K, to.weft.v.begin());
        std::copy_n(from.warp.begin(), K, to.warp.v.begin());
    }
}

template <int K>
void PathTracer<K>::light_directly(const Vertex &vertex, std::size_t light, float probability,
                                   const Sampler &sampler, const Channels<K> &throughput,
                                   Channels<K> *radiance) {
    const auto ray = p_.lights.sample(
        light, vertex.point.position,
        sampler.pair(vertex.depth, Purpose::light_point, static_cast<std::uint32_t>(light)));
    if (!ray || !(ray->radiance > 0) ||
        !(vertex.shading.transmits() || glm::dot(ray->to_light, vertex.point.geometric_normal) > 0))
        return;
    const Shading::Weighed w = vertex.weigh(ray->to_light);
    if (!(w.f_cos.sum() > 0))
        return;
    ++rays_;
    if (p_.accelerator.occluded(vertex.origin(ray->to_light), ray->to_light,
                                ray->distance * kShadowReach))
        return;
    // [Veach] balance heuristic
    const float light_pdf = ray->pdf * probability;
    Channels<K> f;
    vertex.colour(w.f_cos, ray->radiance / (light_pdf + w.pdf), f);
    radiance[ray->group].add(f, throughput, 1.0f);
}

template <int K>
void PathTracer<K>::meet_lights(const glm::vec3 &from, const glm::vec3 &direction, float distance,
                                bool missed, float pdf, std::uint32_t depth,
                                const Channels<K> &throughput, Channels<K> *radiance) const {
    // At the first vertex every light is sampled, later one
    const auto share = [&](std::size_t light) {
        return depth == 0 ? 1.0f : p_.lights.choice_probability(light);
    };
    p_.lights.meet_rectangles(
        from, direction, distance,
        [&](float emitted, std::uint32_t group, float light_pdf, std::size_t light) {
            radiance[group].add(throughput, emitted * pdf / (pdf + light_pdf * share(light)));
        });
    if (missed && p_.lights.has_environment()) {
        const float emitted = p_.lights.environment_radiance(direction);
        const float light_pdf = p_.lights.environment_pdf(direction);
        const float weight =
            light_pdf > 0 ? pdf / (pdf + light_pdf * share(p_.lights.environment_light())) : 1.0f;
        radiance[p_.lights.environment_group()].add(throughput, emitted * weight);
    }
}

template <int K>
void PathTracer<K>::trace(int x, int y, const Sampler &sampler, Channels<K> *radiance,
                          std::size_t groups, FirstHit *first) {
    std::fill_n(radiance, groups, Channels<K>{});
    const glm::vec2 filter = sampler.pair(0, Purpose::pixel);
    glm::vec3 origin = p_.eye;
    glm::vec3 direction = p_.camera_direction(static_cast<float>(x) + 0.5f + tent(filter.x),
                                              static_cast<float>(y) + 0.5f + tent(filter.y));
    Hit hit;
    ++rays_;
    if (!p_.accelerator.intersect(origin, direction, kInfinity, hit)) {
        if (p_.lights.has_environment() && p_.lights.environment_visible())
            radiance[p_.lights.environment_group()] =
                Channels<K>::filled(p_.lights.environment_radiance(direction));
        return;
    }

    Channels<K> throughput = Channels<K>::filled(1.0f);
    for (std::uint32_t depth = 0;; ++depth) {
        const SurfacePoint point = p_.point(direction, hit);
        if (depth == 0 && first)
            *first = {true, hit.distance, point.frame.normal, point.frame.warp, hit.object};
        Vertex vertex{point,
                      p_.shading[point.fabric],
                      colours_[point.fabric],
                      point.frame.to_local(-direction),
                      {},
                      depth};
        vertex.view = vertex.shading.view_terms(vertex.to_viewer);

        // Light that arrives straight from a light
        if (depth == 0)
            for (std::size_t i = 0; i < p_.lights.count(); ++i)
                light_directly(vertex, i, 1.0f, sampler, throughput, radiance);
        else if (p_.lights.count() > 0) {
            const std::size_t i = p_.lights.choose(sampler.pair(depth, Purpose::light_choice).x);
            light_directly(vertex, i, p_.lights.choice_probability(i), sampler, throughput,
                           radiance);
        }

        // Go on in a direction that the fabric draws
        const auto drawn = vertex.shading.sample(vertex.to_viewer, vertex.view,
                                                 sampler.pair(depth, Purpose::lobe_and_strategy),
                                                 sampler.pair(depth, Purpose::direction));
        if (!drawn)
            return;
        glm::vec3 next = point.frame.to_world(drawn->to_light);
        const bool through = drawn->to_light.z < 0;
        if ((glm::dot(next, point.geometric_normal) > 0) == through)
            next = mirrored(next, point.geometric_normal);
        Shading::Weighed w{drawn->response, drawn->pdf};
        const glm::vec3 folded = point.frame.to_local(mirrored(next, point.geometric_normal));
        if ((folded.z > 0) != through)
            w = vertex.weigh(next);
        if (!(w.pdf > 0))
            return;
        Channels<K> f;
        vertex.colour(w.f_cos, 1 / w.pdf, f);
        throughput.multiply(f);
        if (!(throughput.largest() > 0))
            return;

        origin = vertex.origin(next);
        direction = next;
        ++rays_;
        const bool found = p_.accelerator.intersect(origin, direction, kInfinity, hit);
        meet_lights(origin, direction, found ? hit.distance : kInfinity, !found, w.pdf, depth,
                    throughput, radiance);
        if (!found || depth >= static_cast<std::uint32_t>(p_.plan.max_bounces))
            return;
        if (depth + 1 >= kSurvivalFrom) {
            const float survives = std::fmin(1.0f, throughput.largest());
            if (sampler.pair(depth, Purpose::survival).x >= survives)
                return;
            throughput.scale(1 / survives);
        }
    }
}

template class PathTracer<8>;
template class PathTracer<16>;
template class PathTracer<32>;

} // namespace tsuya
