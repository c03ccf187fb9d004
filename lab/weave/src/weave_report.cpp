/// report_weave(): what the layout of a weave measures.
#include <algorithm>
#include <cmath>

#include "path_spline.h"
#include "tsuya/lab/filament_outline.h"
#include "tsuya/sdk/angle.h"
#include "weave_layout.h"

namespace tsuya::lab {
namespace {

using detail::spline;
using detail::WeaveLayout;
using detail::YarnSection;

constexpr int kBetween = 3; ///< heights per place of a path

/// Heights of one yarn about a crossing, from -1 to 1 of its spacing.
template <class Height> std::vector<double> heights_about(Height height, int crossing, int points) {
    std::vector<double> result;
    const int first = crossing * points + points / 2 - points;
    for (int i = 0; i <= 2 * points * kBetween; ++i)
        result.push_back(spline(height, first + i / kBetween, (i % kBetween) / double(kBetween)));
    return result;
}

/// Yarns are all that lies within their radius of a ribbon, so that the distance of the surfaces is
/// that of the ribbons less both radii.
double gap_at(const WeaveLayout &layout, int end, int pick) {
    const auto warp =
        heights_about([&](int k) { return layout.paths.warp_height(end, k); }, pick, layout.points);
    const auto weft =
        heights_about([&](int k) { return layout.paths.weft_height(pick, k); }, end, layout.points);
    const auto beyond = [&](std::size_t i, double spacing, const YarnSection &section) {
        const double along = static_cast<double>(i) / (layout.points * kBetween) - 1;
        return std::max(0.0, std::abs(along) * spacing - section.half_flat);
    };
    double least = 1e300;
    for (std::size_t i = 0; i < warp.size(); ++i) {
        const double dy = beyond(i, layout.weft_spacing, layout.weft);
        for (std::size_t j = 0; j < weft.size(); ++j) {
            const double dx = beyond(j, layout.warp_spacing, layout.warp);
            const double dz = warp[i] - weft[j];
            // Where the paths cross the wrong way round, they have passed through each other.
            if (dx == 0 && dy == 0 && (dz > 0) != layout.draft.up(end, pick))
                return -layout.warp.radius - layout.weft.radius - std::abs(dz);
            least = std::min(least, dx * dx + dy * dy + dz * dz);
        }
    }
    return std::sqrt(least) - layout.warp.radius - layout.weft.radius;
}

/// Looks down on the repeat at a grid of places.
void look_from_above(const WeaveLayout &layout, WeaveReport &report) {
    constexpr int kFiner = 4; // places looked at for each of a path, along and across
    const int points = layout.points * kFiner;
    const int nx = layout.paths.weft_points * kFiner, ny = layout.paths.warp_points * kFiner;
    double warp_seen = 0, weft_seen = 0;
    for (int k = 0; k < ny; ++k)
        for (int l = 0; l < nx; ++l) {
            const auto across = [&](int place, double spacing) {
                return (((place % points) + 0.5) / points - 0.5) * spacing;
            };
            const double warp = layout.warp.half_thickness(across(l, layout.warp_spacing));
            const double weft = layout.weft.half_thickness(across(k, layout.weft_spacing));
            const double warp_top = layout.paths.warp_height(l / points, k / kFiner) + warp;
            const double weft_top = layout.paths.weft_height(k / points, l / kFiner) + weft;
            if (warp >= 0 && (weft < 0 || warp_top > weft_top))
                warp_seen += 1;
            else if (weft >= 0)
                weft_seen += 1;
        }
    const double places = static_cast<double>(nx) * ny;
    report.warp_on_face = warp_seen / places;
    report.weft_on_face = weft_seen / places;
    report.cover = report.warp_on_face + report.weft_on_face;
}

/// Mean over all yarns of a system of length over straight length, less 1.
double crimp(const std::vector<double> &heights, int points, double step) {
    double length = 0;
    for (std::size_t k = 0; k < heights.size(); ++k) {
        const std::size_t n = static_cast<std::size_t>(points), row = k / n * n;
        length += std::hypot(step, heights[row + (k - row + 1) % n] - heights[k]);
    }
    return length / (step * static_cast<double>(heights.size())) - 1;
}

/// Kilograms per cubic metre: [Adanur] Table 2.2 of polyester and viscose, silk as fibroin.
double density(FiberMaterial material) {
    switch (material) {
    case FiberMaterial::polyester:
        return 1380;
    case FiberMaterial::silk:
        return 1340;
    default:
        return 1520;
    }
}

/// What filaments weigh, kilograms per metre of their yarn.
struct Mass {
    double alone = 0;   ///< of straight ones
    double twisted = 0; ///< with the length that twist takes up

    Mass(const Yarn &yarn, const detail::FilamentPacking &packing, double twist_per_m) {
        const double each = outline_of(yarn.section, yarn.corner_rounding).area() *
                            packing.filament_radius * packing.filament_radius *
                            density(yarn.material);
        for (const detail::FilamentRing &ring : packing.rings) {
            const double round = ring.outline.radius > 0 ? ring.outline.perimeter() : 0;
            alone += ring.count * each;
            twisted += ring.count * each * std::hypot(1, twist_per_m * round);
        }
    }
};

double fill(const YarnSection &section, const detail::FilamentPacking &packing) {
    double count = 0;
    for (const detail::FilamentRing &ring : packing.rings)
        count += ring.count;
    return count * kPi * packing.filament_radius * packing.filament_radius / section.area();
}

} // namespace

WeaveReport report_weave(const Weave &weave, const GeometryOptions &options) {
    const WeaveLayout layout = detail::lay_out(weave, options);
    WeaveReport report;
    look_from_above(layout, report);
    report.thickness = layout.paths.thickness;
    report.warp_thickness = 2 * layout.warp.radius;
    report.weft_thickness = 2 * layout.weft.radius;
    report.warp_weft_gap = 1e300;
    for (int e = 0; e < layout.draft.ends; ++e)
        for (int p = 0; p < layout.draft.picks; ++p)
            report.warp_weft_gap = std::min(report.warp_weft_gap, gap_at(layout, e, p));
    report.neighbour_gap = std::min(layout.warp_spacing - 2 * layout.warp.half_width(),
                                    layout.weft_spacing - 2 * layout.weft.half_width());
    report.squeeze = layout.squeeze;
    report.warp_crimp =
        crimp(layout.paths.warp, layout.paths.warp_points, layout.weft_spacing / layout.points);
    report.weft_crimp =
        crimp(layout.paths.weft, layout.paths.weft_points, layout.warp_spacing / layout.points);
    report.warp_fill = fill(layout.warp, layout.warp_packing);
    report.weft_fill = fill(layout.weft, layout.weft_packing);
    report.warp_twist_per_m =
        layout.warp_turns / (layout.draft.picks * layout.weft_spacing * layout.tiles_y);
    report.weft_twist_per_m =
        layout.weft_turns / (layout.draft.ends * layout.warp_spacing * layout.tiles_x);
    const Mass warp(weave.warp, layout.warp_packing, report.warp_twist_per_m);
    const Mass weft(weave.weft, layout.weft_packing, report.weft_twist_per_m);
    report.warp_decitex = 1e7 * warp.alone;
    report.weft_decitex = 1e7 * weft.alone;
    report.mass_per_m2 = warp.twisted * (1 + report.warp_crimp) / layout.warp_spacing +
                         weft.twisted * (1 + report.weft_crimp) / layout.weft_spacing;
    return report;
}

} // namespace tsuya::lab
