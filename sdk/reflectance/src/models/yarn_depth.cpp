#include "tsuya/sdk/detail/yarn_depth.h"

#include "models/slope_lobes.h"

namespace tsuya {
namespace {

constexpr double kLeastFacets = 1e-9; // 1/sr: where there are fewer filaments the depth goes on

} // namespace

YarnDepth::YarnDepth(const YarnLobes &lobes) : pit_(lobes.pit[0], lobes.pit[1]) {
    if (!(lobes.dive > 0))
        return;
    const SlopeLobes shapes(lobes.roughness);
    YarnLobes deep = lobes;
    for (std::size_t axis = 0; axis < 2; ++axis) {
        const std::array<double, kYarnSlopes> depth = lobes.depth(axis);
        for (std::size_t k = 0; k < depth.size(); ++k)
            deep.surface[axis][k] *= depth[k];
        double before = 0;
        for (int i = 0; i < kNodes; ++i) {
            const double x = static_cast<double>(i) / (kNodes - 1);
            const glm::dvec2 part = glm::normalize(glm::dvec2(x, 1 - x));
            const auto both = [&](const YarnLobes &of) {
                return shapes.of_system(of, axis, part.x, part.y) +
                       shapes.of_system(of, axis, -part.x, part.y);
            };
            if (const double all = both(lobes); all > kLeastFacets)
                before = both(deep) / all;
            dive_[axis][static_cast<std::size_t>(i + 1)] = static_cast<float>(before);
        }
        dive_[axis].front() = dive_[axis][2]; // about level it is even
        dive_[axis].back() = dive_[axis][kNodes];
    }
}

} // namespace tsuya
