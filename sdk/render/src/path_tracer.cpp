// What one sample adds to the transport T of a light group. The camera ray hits the path's vertex
// x_0; at each vertex x_n the direction w_n of the next ray is sampled from the cloth's response,
// with density p:
//
//   T = L(camera ray, where it leaves the scene) + sum over n >= 0 of beta_n (S_n + M_n)
//
//   throughput       beta_0 = 1,  beta_{n+1} = beta_n f(w_n) |cos| / (p(w_n) q_n)
//   sampled lights   S_n = sum over lights i of  f(w) |cos| L_i(w) V / (c_i p_i(w))  m_i(w)
//   lights met       M_n = f(w_n) |cos| / p(w_n)  sum over lights i of  L_i(w_n) m_p(w_n)
//
// with f the BRDF, L_i the radiance of light i, V its visibility, and q_n the probability that the
// path goes on (Russian roulette, [Veach] chapter Monte Carlo Integration). Light i is sampled with
// density p_i: at x_0 every light of a few (c_i = 1), else one chosen with probability c_i by what
// it may give to the vertex; of many lights several are chosen at x_0, in expectation c_i times i.
// The sums over both ways to find a light are weighted by the power heuristic, [Veach] chapter
// Multiple Importance Sampling:
//
//   m_i(w) = (c_i p_i(w))^2 / ((c_i p_i(w))^2 + p(w)^2),    m_p(w) = 1 - m_i(w)

#include "path_tracer.h"

#include <cmath>
#include <limits>
#include <optional>

#include "coloured.h"
#include "near_place.h"
#include "pixel_filter.h"
#include "vertex.h"

namespace tsuya {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
// A shadow ray ends this share short of the light.
constexpr float kShadowReach = 1.0f - 1e-4f;
// As many are chosen at the camera's vertex of more than kFewLights.
constexpr std::uint32_t kChosenAtFirst = 2;
// Number of the lone random pair that chooses lights there; those of holes stand before it.
constexpr std::uint32_t kLightChoice = Rays::kLonePairs;
// Russian roulette from this vertex on.
constexpr std::uint32_t kRouletteFrom = 3;

// What is lost to NaN or overflow makes the sample not finite: it is counted, and left out.
template <int K> void spoil(Channels<K> *radiance) {
    radiance[0] = Channels<K>::filled(std::numeric_limits<float>::quiet_NaN());
}

// The power heuristic's weight of the density `of` against `other`, divided by `of`:
// of / (of^2 + other^2), without squares that overflow. One of the two is above 0.
float power_weight_over_pdf(float of, float other) {
    if (of >= other) {
        const float ratio = other / of;
        return 1 / (of * (1 + ratio * ratio));
    }
    const float ratio = of / other;
    return ratio / (other * (1 + ratio * ratio));
}

} // namespace

// A path up to its last vertex, with the ray that goes on from there.
template <int K> struct PathTracer<K>::Path {
    Sampler sampler;       // at the last vertex
    Channels<K> *radiance; // per light group
    glm::vec3 origin{}, direction{};
    std::uint32_t vertex = 0; // index of the last vertex
    Channels<K> throughput = Channels<K>::filled(1.0f);
    bool wide = false;  // lobes are wider from now on, see widened_material.h
    bool tells = false; // what that changes; `plain` is the throughput of the lobes as they are
    Channels<K> plain{};

    glm::vec2 random(Purpose purpose, std::size_t which = 0) const {
        return sampler.pair(purpose, static_cast<std::uint32_t>(which));
    }
    void go_on() { sampler.go_to(++vertex); }
};

// The path's last vertex.
template <int K> struct PathTracer<K>::Place {
    const Vertex &vertex;
    const Colours &colours;
    const Vertex *plain; // without wider lobes, where the path tells what they change; else null
};

// What the ray from a vertex meets. After the last vertex only the lights count: where none lies in
// the ray's direction, a hit at distance 0 stands for whatever the ray would meet.
template <int K> bool PathTracer<K>::find_next(const Path &path, Hit &hit) {
    if (is_last(path) && scene_.plan.short_last_rays &&
        !scene_.lights.crosses_light(path.origin, path.direction)) {
        hit.distance = 0;
        if (!scene_.lights.has_environment())
            return true;
        return rays_.meets_any(path.origin, path.direction); // no holes, see plan
    }
    return rays_.meet_next(path.sampler, path.origin, path.direction, hit);
}

// The c_i of the estimator.
template <int K>
float PathTracer<K>::light_share(const Path &path, const Vertex &vertex, std::size_t light) const {
    return every_light(path) ? 1.0f
                             : scene_.lights.choice_probability(vertex.receiver(), light) *
                                   static_cast<float>(chosen_lights(path));
}

// Each light is sampled at the path's last vertex.
template <int K> bool PathTracer<K>::every_light(const Path &path) const {
    return path.vertex == 0 && scene_.lights.count() <= kFewLights;
}

template <int K> std::uint32_t PathTracer<K>::chosen_lights(const Path &path) const {
    return path.vertex == 0 ? kChosenAtFirst : 1;
}

// Adds beta_n S_n.
template <int K> void PathTracer<K>::sample_lights(const Path &path, const Place &at) {
    const std::size_t count = scene_.lights.count();
    if (every_light(path)) {
        for (std::uint32_t i = 0; i < count; ++i)
            sample_light(path, at, {i, 1}, i);
        return;
    }
    const std::uint32_t choices = count > 0 ? chosen_lights(path) : 0;
    if (choices == 0)
        return;
    const float u = path.vertex == 0 ? path.sampler.lone_pair(kLightChoice).x
                                     : path.random(Purpose::choice_and_survival).x;
    for (std::uint32_t i = 0; i < choices; ++i) {
        // One in each part of the range
        const float of_part = (static_cast<float>(i) + u) / static_cast<float>(choices);
        if (auto chosen = scene_.lights.choose(at.vertex.receiver(), of_part)) {
            chosen->probability *= static_cast<float>(choices);
            sample_light(path, at, *chosen, i);
        }
    }
}

// \param chosen with the number of its samples, c_i, as probability
// \param which of the samples at this vertex
template <int K>
void PathTracer<K>::sample_light(const Path &path, const Place &at, const ChosenLight &chosen,
                                 std::uint32_t which) {
    const Vertex &vertex = at.vertex;
    const auto ray = scene_.lights.sample(chosen.light, vertex.position(),
                                          path.random(Purpose::light_point, which));
    if (!ray || !(ray->radiance > 0) || !vertex.accepts(ray->to_light))
        return;
    const Weighed w = vertex.weigh(ray->to_light);
    if (!(w.f_cos.sum() > 0))
        return;
    const Lights::Parts parts = scene_.lights.parts(chosen.light, ray->to_light);
    ShadowRay shadow{vertex.ray_origin(ray->to_light),
                     ray->to_light,
                     ray->distance * kShadowReach,
                     path.radiance + parts.group[0],
                     {}};
    const float weight = ray->pdf < kOnlyDirection
                             ? power_weight_over_pdf(ray->pdf * chosen.probability, w.pdf)
                             : 1 / chosen.probability;
    const Channels<K> response = coloured<K>(w.f_cos, at.colours, ray->radiance * weight);
    const bool splits = path.vertex == 0 && split_.is_wanted();
    Channels<K> surface;
    if (splits)
        surface = coloured_surface<K>(w.f_cos, at.colours, ray->radiance * weight);
    const bool shadows = scene_.lights.throws_shadows(chosen.light);
    if (shadows &&
        scene_.lights.block(shadow.origin, shadow.direction, shadow.distance, chosen.light))
        return;
    if (path.vertex > 0 || scene_.has_holes() || !shadows || parts.count > 1) {
        const float arrives =
            shadows ? rays_.transmission(shadow.origin, shadow.direction, shadow.distance) : 1.0f;
        for (std::size_t part = 0; part < parts.count && arrives > 0; ++part) {
            Channels<K> &to = path.radiance[parts.group[part]];
            to.add(response, path.throughput, arrives * parts.share[part]);
            if (splits)
                split_.add_sampled(&to, response, surface, arrives * parts.share[part]);
        }
        if (arrives > 0 && at.plain) {
            Channels<K> plain = coloured<K>(at.plain->weigh(ray->to_light).f_cos, at.colours,
                                            ray->radiance * weight);
            plain.multiply(path.plain);
            tell_change(path, response, plain, arrives);
        }
        return;
    }
    if (splits)
        shadow_surface_.push_back(surface);
    shadow.brings.add(response, path.throughput, 1);
    shadow_rays_.push_back(shadow);
}

template <int K> void PathTracer<K>::add_shadow_rays() {
    for (std::size_t begin = 0; begin < shadow_rays_.size(); begin += RayPacket::kMost) {
        const auto waiting = std::span(shadow_rays_).subspan(begin);
        RayPacket rays{.count = std::min(waiting.size(), RayPacket::kMost)};
        for (std::size_t i = 0; i < rays.count; ++i) {
            rays.origin[i] = waiting[i].origin;
            rays.direction[i] = waiting[i].direction;
            rays.farthest[i] = waiting[i].distance;
        }
        std::array<bool, RayPacket::kMost> occluded;
        rays_.occluded(rays, occluded);
        for (std::size_t i = 0; i < rays.count; ++i) {
            if (occluded[i])
                continue;
            waiting[i].to->add(waiting[i].brings, 1);
            if (split_.is_wanted())
                split_.add_sampled(waiting[i].to, waiting[i].brings, shadow_surface_[begin + i], 1);
        }
    }
    shadow_rays_.clear();
    shadow_surface_.clear();
}

// Of what is added to the transport.
// \param factor of the path's throughput
// \param plain in its place, were no lobe wider; throughput included
template <int K>
void PathTracer<K>::tell_change(const Path &path, const Channels<K> &factor,
                                const Channels<K> &plain, float scale) {
    Channels<K> added;
    added.add(factor, path.throughput, scale);
    added.add(plain, -scale);
    if (added.finite())
        change_ += static_cast<double>(added.mean());
}

// Adds beta_n M_n; the path's throughput is beta_{n+1} already, but for the roulette.
// \param distance to what ends the ray; infinite where nothing does
// \param pdf of the path's direction
template <int K>
void PathTracer<K>::add_lights_met(const Path &path, const Vertex &vertex, float distance,
                                   float pdf) {
    const auto add = [&](const LightMet &met) {
        const float sampled = met.pdf > 0 ? met.pdf * light_share(path, vertex, met.light) : 0.0f;
        const float weight = met.radiance * (pdf * power_weight_over_pdf(pdf, sampled));
        path.radiance[met.group].add(path.throughput, weight);
        if (path.tells && path.wide)
            tell_change(path, Channels<K>::filled(1), path.plain, weight);
    };
    scene_.lights.meet(path.origin, path.direction, distance, add);
}

// No vertex follows the path's last one.
template <int K> bool PathTracer<K>::is_last(const Path &path) const {
    return path.vertex >= static_cast<std::uint32_t>(scene_.plan.max_bounces);
}

// Russian roulette, whose probability is the throughput's.
template <int K> bool PathTracer<K>::survives(Path &path) const {
    if (path.vertex + 1 < kRouletteFrom)
        return true;
    const float probability = std::fmin(1.0f, path.throughput.largest());
    if (path.random(Purpose::choice_and_survival).y >= probability)
        return false;
    path.throughput.scale(1 / probability);
    path.plain.scale(1 / probability);
    return true;
}

template <int K>
void PathTracer<K>::trace(int x, int y, std::span<const Sampler> samplers, Channels<K> *radiance,
                          std::size_t groups, FirstHit *first, const LightParts<K> &parts) {
    std::fill_n(radiance, samplers.size() * groups, Channels<K>{});
    split_.start(parts, radiance, groups);
    for (std::size_t begin = 0; begin < samplers.size(); begin += RayPacket::kMost) {
        // Camera rays through samples of the pixel filter
        RayPacket rays{.count = std::min(samplers.size() - begin, RayPacket::kMost)};
        for (std::size_t i = 0; i < rays.count; ++i) {
            const glm::vec2 place = filter_sample(samplers[begin + i].pair(Purpose::pixel));
            const CameraRay ray =
                scene_.camera.through(static_cast<float>(x) + 0.5f + place.x,
                                      static_cast<float>(y) + 0.5f + place.y, samplers[begin + i]);
            rays.origin[i] = ray.origin;
            rays.direction[i] = ray.direction;
            rays.farthest[i] = kInfinity;
        }
        std::array<Hit, RayPacket::kMost> hits;
        rays_.meet_first(rays, hits);
        for (std::size_t i = 0; i < rays.count; ++i) {
            Path path{.sampler = samplers[begin + i],
                      .radiance = radiance + (begin + i) * groups,
                      .origin = rays.origin[i],
                      .direction = rays.direction[i],
                      .tells = scene_.plan.widens && samplers[begin + i].index() % kTelling == 0};
            told_ += path.tells ? 1 : 0;
            follow(path, hits[i], first ? first + begin + i : nullptr);
            if (split_.is_wanted())
                split_.end(path.radiance);
        }
    }
    add_shadow_rays();
}

// The path from where its camera ray hit.
template <int K> void PathTracer<K>::follow(Path &path, Hit &hit, FirstHit *first) {
    const bool hits =
        hit.distance < kInfinity && rays_.pass_holes_first(path.sampler, path.direction, hit);
    const auto see = [&](const LightMet &met) {
        path.radiance[met.group].add(Channels<K>::filled(1), met.radiance);
        if (split_.is_wanted())
            split_.add_seen(path.radiance + met.group, Channels<K>::filled(1), met.radiance);
    };
    const bool sees = scene_.plan.lights_seen;
    if (const auto seen =
            sees ? scene_.lights.seen(path.origin, path.direction, hits ? hit.distance : kInfinity)
                 : std::nullopt)
        return see(*seen);
    if (!hits)
        return sees ? scene_.lights.see_distant(path.direction, see) : void();

    for (;; path.go_on()) {
        // Vertex at the hit
        const SurfacePoint point = scene_.point(path.direction, hit);
        if (!point.is_finite())
            return spoil(path.radiance);
        const std::optional<NearPlace> near =
            path.vertex == 0 ? near_place(scene_, path.direction, hit, point) : std::nullopt;
        const Vertex vertex(scene_, point, path.direction, path.wide, near ? &*near : nullptr);
        std::optional<Vertex> plain;
        if (path.tells && path.wide)
            plain.emplace(scene_, point, path.direction, false);
        std::optional<Colours> printed;
        if (scene_.is_printed(point))
            printed = scene_.printed(point, hit.distance, path.vertex == 0);
        const Colours &colours = printed ? *printed : scene_.colours[point.colours];
        if (path.vertex == 0 && first)
            *first = first_hit_of(scene_, hit, point, colours, K);

        // Direct light, found by sampling the lights
        sample_lights(path, {vertex, colours, plain ? &*plain : nullptr});

        // Next direction, sampled from the cloth's response
        const auto next =
            vertex.sample(path.random(Purpose::lobe_and_strategy), path.random(Purpose::direction));
        if (!next)
            return;
        const auto &[f_cos, pdf] = next->weighed;
        path.throughput.multiply(coloured<K>(f_cos, colours, 1 / pdf));
        if (path.vertex == 0 && split_.is_wanted())
            split_.leave(path.radiance, f_cos, colours, path.throughput, pdf);
        if (!(path.throughput.largest() > 0))
            return;
        if (plain)
            path.plain.multiply(coloured<K>(plain->weigh(next->to_light).f_cos, colours, 1 / pdf));
        else if (!path.wide)
            path.plain = path.throughput;
        path.wide |= scene_.plan.widens && !next->mirrored;
        path.origin = vertex.ray_origin(next->to_light);
        path.direction = next->to_light;
        if (!std::isfinite(glm::dot(path.origin, path.direction)))
            return spoil(path.radiance);

        // Direct light, met by that ray
        const bool found = find_next(path, hit);
        float farthest = found ? hit.distance : kInfinity;
        const bool ended = scene_.lights.end_at_obstacle(path.origin, path.direction, farthest);
        add_lights_met(path, vertex, farthest, pdf);
        if (path.vertex == 0 && split_.is_wanted())
            split_.add_met(path.radiance);

        // End of the path
        if (!found || ended || is_last(path) || !survives(path))
            return;
    }
}

template class PathTracer<8>;
template class PathTracer<16>;
template class PathTracer<32>;

} // namespace tsuya
