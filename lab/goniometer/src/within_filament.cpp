// Rays within a filament that is a chain of round rods of one radius: no ray meets anything but
// the wall of its own filament, which is found without the acceleration structure.

#include <algorithm>
#include <cmath>

#include "filament_scene.h"

namespace tsuya::lab {
namespace {

constexpr int kMostSegments = 100000;   // that one ray goes through
constexpr float kClearlyInside = 1e-4f; // radii, by which a point is within the next rod

// A rod with round ends.
struct Rod {
    glm::vec3 start, axis; // axis: of unit length
    float length, radius;

    Rod(const Cones &cones, std::uint32_t segment) {
        const glm::vec4 &a = cones.vertex[cones.first[segment]];
        const glm::vec4 &b = cones.vertex[cones.first[segment] + 1];
        start = glm::vec3(a);
        axis = glm::vec3(b) - start;
        length = glm::length(axis);
        axis /= length;
        radius = a.w;
    }
    // From the nearest point of the axis
    glm::vec3 radial(const glm::vec3 &point) const {
        const glm::vec3 p = point - start;
        return p - std::clamp(glm::dot(p, axis), 0.0f, length) * axis;
    }
    bool contains(const glm::vec3 &point) const {
        const glm::vec3 r = radial(point);
        const float least = radius - kClearlyInside;
        return glm::dot(r, r) < least * least;
    }
    // Distance from a point inside to the wall
    float exit(const glm::vec3 &point, const glm::vec3 &direction) const {
        const glm::vec3 p = point - start;
        const float ps = glm::dot(p, axis), ds = glm::dot(direction, axis);
        const glm::vec3 pr = p - ps * axis, dr = direction - ds * axis;
        const float a = glm::dot(dr, dr);
        float at = ds > 0 ? 2 * length : -length; // beyond an end, for a ray along the axis
        if (a > 1e-9f) {
            const float b = glm::dot(pr, dr), c = glm::dot(pr, pr) - radius * radius;
            const float t = (-b + std::sqrt(std::max(0.0f, b * b - a * c))) / a;
            at = ps + t * ds;
            if (at >= 0 && at <= length)
                return std::max(0.0f, t);
        }
        const glm::vec3 q = p - (at < 0 ? 0 : length) * axis; // the round end
        const float b = glm::dot(q, direction), c = glm::dot(q, q) - radius * radius;
        return std::max(0.0f, -b + std::sqrt(std::max(0.0f, b * b - c)));
    }
};

} // namespace

Fate FilamentScene::within_cones(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                                 float &travelled) const {
    const Cones &cones = cell_.cones;
    const Strand &strand = cell_.strands[cones.strand[place.segment]];
    travelled = 0;
    for (int step = 0; step < kMostSegments; ++step) {
        const Rod rod(cones, place.segment);
        const float t = rod.exit(place.point, direction);
        if (travelled + t >= reach) {
            place.point += (reach - travelled) * direction;
            travelled = reach;
            return Fate::lost;
        }
        travelled += t;
        place.point += t * direction;
        bool goes_on = false;
        for (const bool next : {true, false}) {
            const Neighbour n = neighbour(strand, place.segment, next, cell_.size[strand.axis]);
            glm::vec3 moved = place.point;
            moved[strand.axis] += n.shift;
            if (!Rod(cones, n.segment).contains(moved))
                continue;
            place.point = moved;
            place.segment = n.segment;
            goes_on = true;
            break;
        }
        if (goes_on)
            continue;
        hit.point = place.point;
        hit.normal = glm::normalize(rod.radial(place.point));
        hit.system = strand.system;
        hit.on_cone = true;
        hit.segment = place.segment;
        return Fate::hit;
    }
    return Fate::lost;
}

Fate FilamentScene::within(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                           float &travelled) const {
    return place.on_cone ? within_cones(place, direction, reach, hit, travelled)
                         : within_tube(place, direction, reach, hit, travelled);
}

} // namespace tsuya::lab
