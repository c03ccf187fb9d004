#include "repair/ears.h"

#include <algorithm>

namespace tsuya::garment {
namespace {

double cross(const glm::dvec2 &a, const glm::dvec2 &b) { return a.x * b.y - a.y * b.x; }

/// What is left of a polygon while its ears are cut off.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<glm::dvec2> &polygon) : at_(polygon) {
        for (std::uint32_t i = 0; i < polygon.size(); ++i)
            left_.push_back(i);
        quality_all();
    }

    std::size_t size() const { return left_.size(); }
    std::array<std::uint32_t, 3> ear(std::size_t i) const {
        return {left_[before(i)], left_[i], left_[after(i)]};
    }

    /// The place of the fattest ear; nullopt where there is none.
    std::optional<std::size_t> fattest() {
        std::size_t best = find_fattest();
        if (!(quality_[best] > 0.0)) { // ears that other corners stood in
            quality_all();
            best = find_fattest();
        }
        return quality_[best] > 0.0 ? std::optional(best) : std::nullopt;
    }

    void cut(std::size_t i) {
        left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
        quality_.erase(quality_.begin() + static_cast<std::ptrdiff_t>(i));
        const std::size_t next = i % left_.size();
        quality_[next] = quality(next);
        quality_[before(next)] = quality(before(next));
    }

  private:
    std::size_t before(std::size_t i) const { return (i + left_.size() - 1) % left_.size(); }
    std::size_t after(std::size_t i) const { return (i + 1) % left_.size(); }
    glm::dvec2 point(std::size_t i) const { return at_[left_[i]]; }

    std::size_t find_fattest() const {
        return static_cast<std::size_t>(std::max_element(quality_.begin(), quality_.end()) -
                                        quality_.begin());
    }
    void quality_all() {
        quality_.resize(left_.size());
        for (std::size_t i = 0; i < left_.size(); ++i)
            quality_[i] = quality(i);
    }

    /// Height over the longest side of the ear at `i`; 0 where it has no area or holds a corner.
    double quality(std::size_t i) const {
        constexpr double kFlat = 1e-9;
        const glm::dvec2 a = point(before(i)), b = point(i), c = point(after(i));
        const double longest =
            std::max({glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)});
        const double area = cross(b - a, c - b);
        if (!(area > kFlat * longest))
            return 0.0;
        const double edge = -kFlat * longest; // points on a side are inside
        for (std::size_t k = 0; k < left_.size(); ++k) {
            if (k == i || k == before(i) || k == after(i))
                continue;
            const glm::dvec2 p = point(k);
            if (cross(b - a, p - a) >= edge && cross(c - b, p - b) >= edge &&
                cross(a - c, p - c) >= edge)
                return 0.0;
        }
        return area / longest;
    }

    const std::vector<glm::dvec2> &at_;
    std::vector<std::uint32_t> left_;
    std::vector<double> quality_; ///< per corner that is left
};

} // namespace

bool is_concave(const std::vector<glm::dvec2> &polygon) {
    // Sines of the turn. Draped quads are bent a little without harm.
    constexpr double kQuad = 0.25, kLarger = 0.035;
    const std::size_t n = polygon.size();
    const double most = n == 4 ? kQuad : kLarger;
    for (std::size_t i = 0; i < n; ++i) {
        const glm::dvec2 in = polygon[i] - polygon[(i + n - 1) % n];
        const glm::dvec2 out = polygon[(i + 1) % n] - polygon[i];
        if (cross(in, out) < -most * glm::length(in) * glm::length(out))
            return true;
    }
    return false;
}

std::optional<std::vector<std::array<std::uint32_t, 3>>>
clip_ears(const std::vector<glm::dvec2> &polygon) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    EarClipper clipper(polygon);
    while (clipper.size() >= 3) {
        const std::optional<std::size_t> ear = clipper.fattest();
        if (!ear)
            return std::nullopt;
        triangles.push_back(clipper.ear(*ear));
        if (clipper.size() == 3)
            break;
        clipper.cut(*ear);
    }
    return triangles;
}

} // namespace tsuya::garment
