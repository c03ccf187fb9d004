// Rays within a filament that is a tube: as no ray meets anything but the wall of its own filament,
// that is looked for segment by segment, without the acceleration structure.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "filament_scene.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::lab {
namespace {

constexpr float kNowhere = std::numeric_limits<float>::infinity();
constexpr int kMostSegments = 100000;        // that one ray goes through
constexpr std::size_t kMostRingPoints = 256; // as check_settings() has it
constexpr float kBeyondWall = 1e-3f;         // radii, by which rounding puts points outside

// Between two rings.
struct TubeSegment {
    const glm::vec3 *first, *second; // points of the rings
    std::uint32_t size;              // of a ring
    glm::vec3 first_normal, second_normal;

    TubeSegment(const Tubes &tubes, std::uint32_t segment) : size(tubes.ring_size) {
        const std::uint32_t ring = tubes.ring[segment];
        first = &tubes.position[ring];
        second = first + size;
        first_normal = tubes.tangent[ring / size];
        second_normal = tubes.tangent[ring / size + 1];
    }
    // Distance to the plane of the ring that the ray goes to, and whether that is the second one.
    std::pair<float, bool> end(const glm::vec3 &point, const glm::vec3 &direction) const {
        const float back = glm::dot(direction, first_normal);
        const float ahead = glm::dot(direction, second_normal);
        const float to_first = back < 0 ? glm::dot(*first - point, first_normal) / back : kNowhere;
        const float to_second =
            ahead > 0 ? glm::dot(*second - point, second_normal) / ahead : kNowhere;
        return {std::max(0.0f, std::min(to_first, to_second)), to_second <= to_first};
    }
};

struct Wall {
    float distance = kNowhere;
    glm::vec3 normal{}; // outward, of any length
};

// The wall through which a ray from inside leaves the tube, if it is long enough. Along the tube go
// edges and diagonals, and between each two neighbours lies a triangle of a wall. Seen along the
// ray they are lines: the ray leaves by the triangle whose first line it has on its left and the
// second on its right.
Wall wall_of(const TubeSegment &tube, const glm::vec3 &point, const Frame &along) {
    std::array<float, 2 * kMostRingPoints> x, y;
    for (std::uint32_t k = 0; k < 2 * tube.size; ++k) {
        const glm::vec3 p = tube.first[k] - point;
        x[k] = glm::dot(p, along.weft);
        y[k] = glm::dot(p, along.warp);
    }
    const auto passes_left = [&](std::uint32_t i, std::uint32_t j) {
        return x[i] * y[j] - y[i] * x[j] < 0;
    };
    Wall wall;
    const auto try_triangle = [&](const glm::vec3 &a, const glm::vec3 &b, const glm::vec3 &c) {
        const glm::vec3 normal = glm::cross(b - a, c - a);
        const float distance = glm::dot(normal, a - point) / glm::dot(normal, along.normal);
        if (distance > -kBeyondWall && distance < wall.distance)
            wall = {std::max(0.0f, distance), normal};
    };
    const std::uint32_t m = tube.size;
    const glm::vec3 *const first = tube.first, *const second = tube.second;
    bool edge = passes_left(0, m);
    for (std::uint32_t k = 0; k < m; ++k) { // the triangles of Tubes::quad
        const std::uint32_t next = k + 1 < m ? k + 1 : 0;
        const bool diagonal = passes_left(next, m + k), next_edge = passes_left(next, m + next);
        if (edge && !diagonal)
            try_triangle(first[k], first[next], second[k]);
        if (diagonal && !next_edge)
            try_triangle(second[next], second[k], first[next]);
        edge = next_edge;
    }
    return wall;
}

} // namespace

Fate FilamentScene::within_tube(Inside &place, const glm::vec3 &direction, float reach, Hit &hit,
                                float &travelled) const {
    const Tubes &tubes = cell_.tubes;
    const Strand &strand = cell_.strands[tubes.strand[place.segment]];
    const Frame along = make_frame(direction);
    travelled = 0;
    for (int step = 0; step < kMostSegments; ++step) {
        const TubeSegment tube(tubes, place.segment);
        const Wall wall = wall_of(tube, place.point, along);
        const auto [end, next] = tube.end(place.point, direction);
        const float t = std::min(wall.distance, end);
        if (travelled + t >= reach) {
            if (reach < kNowhere)
                place.point += (reach - travelled) * direction;
            travelled = reach;
            return Fate::lost;
        }
        travelled += t;
        place.point += t * direction;
        if (wall.distance <= end) {
            hit = {.point = place.point,
                   .normal = glm::normalize(wall.normal),
                   .system = strand.system,
                   .on_cone = false,
                   .segment = place.segment};
            return Fate::hit;
        }
        const Neighbour n = neighbour(strand, place.segment, next, cell_.size[strand.axis]);
        place.point[strand.axis] += n.shift;
        place.segment = n.segment;
    }
    return Fate::lost;
}

} // namespace tsuya::lab
