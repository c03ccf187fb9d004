#include "models/sky_share.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tsuya {
namespace {

constexpr std::array<std::array<int, 2>, 8> kWays{
    {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

int wrap(int i, int n) { return ((i % n) + n) % n; }

} // namespace

std::vector<float> sky_shares(const WeaveMap &map) {
    const int nx = map.size[0], ny = map.size[1];
    const auto index = [&](int x, int y) {
        return static_cast<std::size_t>(wrap(y, ny)) * static_cast<std::size_t>(nx) +
               static_cast<std::size_t>(wrap(x, nx));
    };
    float lowest = 0;
    for (const WeavePlace &p : map.place)
        lowest = std::min(lowest, p.height);
    std::vector<float> height;
    for (const WeavePlace &p : map.place)
        height.push_back(p.system == WeavePlace::kGap ? lowest : p.height);
    // As far as to the middle of the next yarn
    const int reach = std::max(nx / map.threads.x, ny / map.threads.y);
    const glm::vec2 step = map.repeat / glm::dvec2(nx, ny);
    std::vector<float> share(map.place.size(), 0.0f);
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const std::size_t at = index(x, y);
            if (map.place[at].system == WeavePlace::kGap)
                continue;
            float sum = 0;
            for (const auto &[dx, dy] : kWays) {
                const float far = glm::length(step * glm::vec2(dx, dy));
                float tangent = 0;
                for (int i = 1; i <= reach; ++i)
                    tangent =
                        std::max(tangent, (height[index(x + i * dx, y + i * dy)] - height[at]) /
                                              (far * static_cast<float>(i)));
                sum += 1 / (1 + tangent * tangent);
            }
            share[at] = sum / static_cast<float>(kWays.size());
        }
    return share;
}

} // namespace tsuya
