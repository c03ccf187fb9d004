#include "views/mirror_views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tsuya {
namespace {

constexpr double kSameView = 1e-6;

// Whether the symmetry makes two points of the disk one; also on the edges of the domain, where
// rounding would fold them to opposite ends.
bool is_same_view(glm::dvec2 a, glm::dvec2 b, Symmetry symmetry) {
    int count = 0;
    const auto image = images(a.x, a.y, symmetry, count);
    return std::any_of(image.begin(), image.begin() + count,
                       [&](glm::dvec2 p) { return glm::length(p - b) < kSameView; });
}

} // namespace

glm::dvec2 disk_of(double theta, double phi) {
    const double r = std::numbers::sqrt2 * std::sin(theta / 2);
    return {r * std::cos(phi), r * std::sin(phi)};
}

std::array<glm::dvec2, 4> images(double x, double y, Symmetry symmetry, int &count) {
    count = symmetry == Symmetry::orthotropic ? 4 : symmetry == Symmetry::half_turn ? 2 : 1;
    return {{{x, y}, {-x, -y}, {x, -y}, {-x, y}}};
}

std::vector<MirrorGroup> mirror_groups(const std::vector<BardView> &views, Symmetry symmetry) {
    std::vector<MirrorGroup> groups;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const glm::dvec2 p = disk_of(views[i].theta, views[i].phi);
        const auto same = std::find_if(groups.begin(), groups.end(), [&](const MirrorGroup &g) {
            return is_same_view(g.p, p, symmetry);
        });
        if (same == groups.end())
            groups.push_back({p, {i}});
        else
            same->members.push_back(i);
    }
    return groups;
}

} // namespace tsuya
