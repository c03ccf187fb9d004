#include "turntable.h"

#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::scene {
namespace {

// Maps +z to +x at a quarter.
template <class Vector> Vector turned_direction(const Vector &v, double angle) {
    using Number = typename Vector::value_type;
    const auto c = static_cast<Number>(std::cos(angle)), s = static_cast<Number>(std::sin(angle));
    return {c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}

} // namespace

glm::dvec3 turned(const glm::dvec3 &point, const glm::dvec3 &axis, double angle) {
    return axis + turned_direction(point - axis, angle);
}

double turn_of(int view, int views) { return 2 * kPi * view / views; }

Surface turned(const Surface &surface, const glm::dvec3 &axis, double angle) {
    Surface made = surface;
    for (glm::dvec3 &p : made.position)
        p = turned(p, axis, angle);
    for (std::vector<glm::vec3> *const directions : {&made.normal, &made.warp, &made.weft})
        for (glm::vec3 &d : *directions)
            d = turned_direction(d, angle);
    return made;
}

std::vector<glm::dvec3> all_turns(const std::vector<glm::dvec3> &points, const glm::dvec3 &axis,
                                  int views) {
    std::vector<glm::dvec3> all;
    all.reserve(points.size() * static_cast<std::size_t>(views));
    for (int view = 0; view < views; ++view)
        for (const glm::dvec3 &p : points)
            all.push_back(turned(p, axis, turn_of(view, views)));
    return all;
}

} // namespace tsuya::scene
