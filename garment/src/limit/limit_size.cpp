#include "limit/limit_size.h"

#include <limits>
#include <string>

#include "tsuya/sdk/detail/memory.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Bytes at the peak, a tenth more than the sample garments took at levels 3 to 5: 180 a point with
/// its two triangles.
constexpr double kBytesPerPoint = 140, kBytesPerTriangle = 30;

/// Points are numbered with 32 bits, one number of which stands for none.
constexpr double kMostPoints = std::numeric_limits<std::uint32_t>::max() - 1.0;

/// The points inside of a face and its triangles.
LimitSize face_size(std::uint32_t corners, const glm::dvec2 &pieces) {
    const double a = pieces.x, b = pieces.y;
    if (corners == 3)
        return {0.5 * (a - 1) * std::max(a - 2, 0.0), a * a};
    if (corners == 4)
        return {(a - 1) * (b - 1), 2 * a * b};
    // Sub-faces, one a corner, of half the pieces
    const double each = 0.25 * a * a;
    return {corners * each, 2 * corners * std::max(each, 0.5)};
}

bool fits(const LimitSize &size, double available) {
    return size.points <= kMostPoints && size.bytes() <= available;
}

std::string fitting_level(const LimitSurface &surface, int level, double available) {
    while (--level >= 0)
        if (fits(limit_size(surface, uniform_rates(surface, 1 << level)), available))
            return "expected at most level " + std::to_string(level);
    return "expected a mesh of fewer faces";
}

} // namespace

double LimitSize::bytes() const { return kBytesPerPoint * points + kBytesPerTriangle * triangles; }

LimitSize limit_size(const LimitSurface &surface, const TessellationRates &rates) {
    const PolygonMesh &mesh = surface.mesh();
    LimitSize size{.points = static_cast<double>(mesh.position.size())};
    for (const int rate : rates.edge)
        size.points += rate - 1;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const LimitSize face = face_size(mesh.face_size(f), rates.inner[f]);
        size.points += face.points;
        size.triangles += face.triangles;
    }
    return size;
}

void need_room(const LimitSurface &surface, const TessellationRates &rates,
               const SubdivideOptions &options) {
    const LimitSize size = limit_size(surface, rates);
    const auto available = static_cast<double>(detail::available_memory());
    if (fits(size, available))
        return;
    const bool adaptive = options.tolerance || options.view;
    const std::string where = adaptive ? "subdivide.tolerance" : "subdivide.level";
    const std::string accepted =
        adaptive ? "expected a larger tolerance" : fitting_level(surface, options.level, available);
    const auto count = [](double n) { return std::to_string(static_cast<std::uint64_t>(n)); };
    if (size.points > kMostPoints && size.bytes() <= available)
        throw Error(
            {count(size.points) + " points are more than can be numbered", where, accepted});
    detail::need_memory(static_cast<std::uint64_t>(size.bytes()),
                        count(size.points) + " points and " + count(size.triangles) + " triangles" +
                            (adaptive ? "" : " of level " + std::to_string(options.level)),
                        where, accepted);
}

} // namespace tsuya::garment
