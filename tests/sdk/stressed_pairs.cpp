#include "sdk/stressed_pairs.h"

#include <cmath>

#include "sdk/synthetic_table.h"

namespace tsuya::test {

glm::vec3 low(double z, double phi) {
    const double s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

std::pair<glm::vec3, glm::vec3> stressed_pair(Random &random) {
    const auto near_horizon = [&] {
        return low(std::pow(10.0, -7.0 * random.number()), 6.2831853 * random.number());
    };
    const auto near_pole = [&] {
        return glm::vec3(
            direction(90 * std::pow(10.0, -8.0 * random.number()), 360 * random.number()));
    };
    const float kind = random.number();
    const glm::vec3 l = kind < 0.4f   ? random.direction()
                        : kind < 0.7f ? near_horizon()
                                      : near_pole();
    const float other = random.number();
    if (other < 0.3f)
        return {l, random.direction()};
    if (other < 0.5f)
        return {l, near_horizon()};
    if (other < 0.6f)
        return {l, near_pole()};
    const glm::vec3 spread = std::pow(10.0f, -8 * random.number()) * random.direction();
    glm::vec3 v = glm::vec3(-l.x, -l.y, other < 0.8f ? l.z : 0.01f * l.z) + spread;
    return {l, glm::normalize(v)};
}

std::vector<std::pair<glm::vec3, glm::vec3>> directed_pairs() {
    std::vector<glm::vec3> all = {{0, 0, 1}};
    for (const double z : {0.7, 0.1, 1e-2, 1.7453e-5, 1e-7, 1e-12, 1e-20, 1e-30})
        for (const double phi : {0.0, 0.3, 1.5707963267948966, 3.0, 3.141592653589793, 4.5})
            all.push_back(low(z, phi));
    std::vector<std::pair<glm::vec3, glm::vec3>> pairs;
    for (const glm::vec3 &l : all) {
        for (const glm::vec3 &v : all)
            pairs.emplace_back(l, v);                      // V = N, L = N, both grazing
        pairs.emplace_back(l, glm::vec3(-l.x, -l.y, l.z)); // the mirror direction
        const glm::vec2 level(l.x, l.y);
        if (glm::length(level) > 0) // from 1e-30 on L = -V, as near as it gets
            for (const float z : {1e-3f, 1e-6f, 1e-12f, 1e-30f})
                for (const float sign : {-1.0f, 1.0f}) // beta -> 0 and pi
                    pairs.emplace_back(l,
                                       glm::normalize(glm::vec3(sign * glm::normalize(level), z)));
    }
    return pairs;
}

} // namespace tsuya::test
