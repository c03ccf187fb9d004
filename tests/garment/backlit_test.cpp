// Cracks along seams, as a lamp behind the cloth would show them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

#include "test_meshes.h"
#include "tsuya/garment/garment.h"

namespace tsuya::garment {
namespace {

/// Depth of the front of a surface, seen along -z by parallel rays.
class DepthPicture {
  public:
    DepthPicture(const Surface &surface, double pixel) : pixel_(pixel) {
        glm::dvec3 upper(-1e9);
        lower_ = glm::dvec3(1e9);
        for (const glm::dvec3 &p : surface.position) {
            lower_ = glm::min(lower_, p);
            upper = glm::max(upper, p);
        }
        width_ = static_cast<int>((upper.x - lower_.x) / pixel) + 2;
        height_ = static_cast<int>((upper.y - lower_.y) / pixel) + 2;
        depth_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), kVoid);
        for (const glm::uvec3 &t : surface.triangle)
            draw(surface.position[t.x], surface.position[t.y], surface.position[t.z]);
    }

    /// Pixels near the points through which a ray passes between cloth: on two opposite sides the
    /// front is nearer by 2 cm and more. Those near openings are left out, whose corners are
    /// narrow.
    std::size_t cracks(const std::vector<glm::dvec3> &points,
                       const std::vector<glm::dvec3> &openings) const {
        constexpr float kBehind = 0.02f;
        std::vector<bool> counts(depth_.size(), false);
        mark(points, 2e-3, true, counts);
        mark(openings, 5e-3, false, counts);
        std::size_t count = 0;
        for (int y = 1; y < height_ - 1; ++y)
            for (int x = 1; x < width_ - 1; ++x) {
                bool between = false;
                for (const auto &[dx, dy] : {std::pair(1, 0), {0, 1}, {1, 1}, {1, -1}})
                    between |= at(x - dx, y - dy) > at(x, y) + kBehind &&
                               at(x + dx, y + dy) > at(x, y) + kBehind;
                count += between && counts[index(x, y)];
            }
        return count;
    }
    std::size_t covered() const {
        return static_cast<std::size_t>(
            std::count_if(depth_.begin(), depth_.end(), [](float d) { return d > kVoid; }));
    }

  private:
    static constexpr float kVoid = -1e9f;

    std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(x);
    }
    float at(int x, int y) const { return depth_[index(x, y)]; }

    /// Sets the pixels within a distance of the points.
    void mark(const std::vector<glm::dvec3> &points, double distance, bool value,
              std::vector<bool> &pixels) const {
        const int reach = static_cast<int>(distance / pixel_);
        for (const glm::dvec3 &p : points) {
            const int cx = static_cast<int>((p.x - lower_.x) / pixel_),
                      cy = static_cast<int>((p.y - lower_.y) / pixel_);
            for (int y = std::max(0, cy - reach); y <= std::min(height_ - 1, cy + reach); ++y)
                for (int x = std::max(0, cx - reach); x <= std::min(width_ - 1, cx + reach); ++x)
                    pixels[index(x, y)] = value;
        }
    }

    void draw(const glm::dvec3 &p, const glm::dvec3 &q, const glm::dvec3 &r) {
        const auto place = [&](const glm::dvec3 &v) {
            return glm::dvec3((v.x - lower_.x) / pixel_, (v.y - lower_.y) / pixel_, v.z);
        };
        const glm::dvec3 a = place(p), b = place(q), c = place(r);
        const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
        if (area == 0.0)
            return;
        const glm::dvec3 low = glm::min(glm::min(a, b), c), high = glm::max(glm::max(a, b), c);
        for (int y = static_cast<int>(low.y);
             y <= std::min<int>(height_ - 1, static_cast<int>(high.y)); ++y)
            for (int x = static_cast<int>(low.x);
                 x <= std::min<int>(width_ - 1, static_cast<int>(high.x)); ++x) {
                const double px = x + 0.5, py = y + 0.5;
                const double u = ((b.x - px) * (c.y - py) - (b.y - py) * (c.x - px)) / area,
                             v = ((c.x - px) * (a.y - py) - (c.y - py) * (a.x - px)) / area,
                             w = 1.0 - u - v;
                // An edge that two triangles share is on one side or the other, but for rounding.
                constexpr double kRounding = -1e-9;
                if (u < kRounding || v < kRounding || w < kRounding)
                    continue;
                float &depth = depth_[index(x, y)];
                depth = std::max(depth, static_cast<float>(u * a.z + v * b.z + w * c.z));
            }
    }

    double pixel_;
    glm::dvec3 lower_;
    int width_, height_;
    std::vector<float> depth_;
};

/// Vertices at which two panels meet, and those of open edges.
struct Edges {
    std::vector<glm::dvec3> seams, openings;
};

Edges edges_of(const Surface &surface) {
    const auto less = [](const glm::dvec3 &a, const glm::dvec3 &b) {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    };
    std::map<glm::dvec3, std::uint32_t, decltype(less)> first(less);
    std::vector<std::uint32_t> place;
    for (std::uint32_t v = 0; v < surface.position.size(); ++v)
        place.push_back(first.try_emplace(surface.position[v], v).first->second);
    std::vector<std::set<std::uint32_t>> panels(place.size());
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
    for (std::size_t f = 0; f < surface.triangle.size(); ++f)
        for (int c = 0; c < 3; ++c) {
            const std::uint32_t a = place[surface.triangle[f][c]],
                                b = place[surface.triangle[f][(c + 1) % 3]];
            panels[a].insert(surface.panel[f]);
            ++sides[{std::min(a, b), std::max(a, b)}];
        }
    Edges edges;
    for (std::size_t v = 0; v < panels.size(); ++v)
        if (panels[v].size() > 1)
            edges.seams.push_back(surface.position[v]);
    for (const auto &[side, count] : sides)
        if (count == 1)
            for (const std::uint32_t v : {side.first, side.second})
                edges.openings.push_back(surface.position[v]);
    return edges;
}

TEST(Backlit, AGapIsFoundAndAClosedSheetHasNone) {
    const Surface whole = load(test::panel(10, 10, 0.02), {}, "sheet").surface;
    std::vector<glm::dvec3> middle;
    for (int i = 1; i < 200; ++i)
        middle.emplace_back(0.1, 0.001 * i, 0.0);
    EXPECT_EQ(DepthPicture(whole, 4e-4).cracks(middle, {}), 0u);
    EXPECT_GT(DepthPicture(whole, 4e-4).covered(), 240000u);
    const Surface apart =
        load(test::both(test::panel(5, 10, 0.02), test::panel(5, 10, 0.02, {0.1004, 0, 0})),
             {.seams = {.tolerance = -1.0}}, "gap")
            .surface;
    EXPECT_GT(DepthPicture(apart, 4e-4).cracks(middle, {}), 300u);
}

TEST(OutsideData, NoLightPassesTheSeamsOfDressPanels) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    const std::filesystem::path file = *data / "garments/dress_panels.obj";
    constexpr double kPixel = 3e-4;
    const Surface surface = load(file).surface;
    const Edges edges = edges_of(surface);
    const DepthPicture sewn(surface, kPixel);
    EXPECT_GT(edges.seams.size(), 1000u);
    EXPECT_GT(sewn.covered(), 1000000u);
    EXPECT_EQ(sewn.cracks(edges.seams, edges.openings), 0u);
    // The control: every panel divided by itself.
    const DepthPicture open(load(file, {.seams = {.tolerance = -1.0}}).surface, kPixel);
    EXPECT_GT(open.cracks(edges.seams, edges.openings), 100u);
}

} // namespace
} // namespace tsuya::garment
