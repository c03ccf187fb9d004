#include "weave_layout.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya::lab::detail {
namespace {

constexpr double kClearance = 0.02; ///< between warp and weft, radii of filaments

void check_options(const GeometryOptions &options) {
    const auto fail = [](const char *name, std::string accepted) {
        throw Error({std::string(name) + " is out of range", std::string("geometry.") + name,
                     "expected " + std::move(accepted)});
    };
    if (options.points_per_crossing < 4 || options.points_per_crossing > 64 ||
        options.points_per_crossing % 2 != 0)
        fail("points_per_crossing", "an even number from 4 to 64");
    if (!(options.stiffness_length >= 0 && options.stiffness_length <= 1))
        fail("stiffness_length", "0 to 1");
    if (options.tiles_x < 0 || options.tiles_x > 16)
        fail("tiles_x", "0 to 16");
    if (options.tiles_y < 0 || options.tiles_y > 16)
        fail("tiles_y", "0 to 16");
}

/// Repeats of the draft along a yarn that let `twist_per_m` be a whole number of turns.
int tiles_for(double twist_per_m, double length) {
    constexpr int kMost = 4;
    constexpr double kEnough = 0.1;
    int best = 1;
    double least = 1e300;
    for (int tiles = 1; tiles <= kMost; ++tiles) {
        const double turns = twist_per_m * length * tiles;
        const double error = std::abs(std::round(turns) - turns) / tiles;
        if (std::round(turns) != 0 && error < least) {
            least = error;
            best = tiles;
            if (error <= kEnough * std::abs(twist_per_m) * length)
                break;
        }
    }
    return best;
}

void check_size(const Weave &weave, const WeaveLayout &layout) {
    constexpr double kMostPoints = 20e6;
    const double crossings = static_cast<double>(layout.draft.ends) * layout.draft.picks *
                             layout.tiles_x * layout.tiles_y;
    const double points = crossings * layout.points * (weave.warp.filaments + weave.weft.filaments);
    if (points > kMostPoints)
        throw Error({"the repeat needs " + std::to_string(points * 1e-6) + " million points",
                     weave.name.empty() ? "weave" : weave.name,
                     "expected at most 20 million: fewer filaments, tiles or points per crossing"});
}

/// A filament of a twisted yarn needs points enough for its helix.
void check_twist(const std::string &where, double turns, double points) {
    constexpr double kMostTurn = 0.1;
    if (std::abs(turns) > kMostTurn * points)
        throw Error({"twist_per_m leaves less than 10 points for each turn", where,
                     "expected fewer turns or more points_per_crossing"});
}

/// \param share of the width that the spacing leaves
YarnSection section_of(const Yarn &yarn, double twist_per_m, double share) {
    return press(YarnSection::of(yarn.width, yarn.thickness()),
                 share * std::min(yarn.width, yarn.spacing()), yarn.filaments, twist_per_m);
}

YarnSection grown(YarnSection section, double by) {
    section.radius += by;
    return section;
}

bool has_room(const WeaveLayout &layout) {
    constexpr double kMostOverlap = 0.005; // of the distance of the axes
    return layout.paths.overlap <= kMostOverlap * (layout.warp.radius + layout.weft.radius);
}

/// Sections, filaments and paths of yarns that have `share` of their width.
void place_yarns(const Weave &weave, double share, double stiffness_length, WeaveLayout &layout,
                 const Progress &progress) {
    const double warp_twist =
        layout.warp_turns / (layout.draft.picks * layout.weft_spacing * layout.tiles_y);
    const double weft_twist =
        layout.weft_turns / (layout.draft.ends * layout.warp_spacing * layout.tiles_x);
    layout.warp = section_of(weave.warp, warp_twist, share);
    layout.weft = section_of(weave.weft, weft_twist, share);
    layout.warp_packing = pack_filaments(layout.warp, weave.warp.filaments, warp_twist);
    layout.weft_packing = pack_filaments(layout.weft, weave.weft.filaments, weft_twist);
    // Filaments come as near to the surface of their yarn as to each other: no nearer between the
    // points of the paths either
    const double clearance = kClearance * std::max(layout.warp_packing.filament_radius,
                                                   layout.weft_packing.filament_radius);
    layout.paths = solve_paths({.draft = layout.draft,
                                .warp_spacing = layout.warp_spacing,
                                .weft_spacing = layout.weft_spacing,
                                .warp = grown(layout.warp, clearance / 2),
                                .weft = grown(layout.weft, clearance / 2),
                                .points = layout.points,
                                .stiffness_length = stiffness_length,
                                .warp_tension = weave.warp.tension,
                                .weft_tension = weave.weft.tension},
                               progress);
}

/// Yarns that jam, which is when they find no paths clear of each other, squeeze each other
/// narrower and so thicker until they do.
void place_jammed(const Weave &weave, const std::string &where, double stiffness_length,
                  WeaveLayout &layout, const Progress &progress) {
    constexpr int kMostPercent = 10; // of their width, our choice
    const double overlap = layout.paths.overlap;
    for (int percent = 1; percent <= kMostPercent && !has_room(layout); ++percent) {
        layout.squeeze = 0.01 * percent;
        place_yarns(weave, 1 - layout.squeeze, stiffness_length, layout, progress);
    }
    if (!has_room(layout))
        throw Error({"the yarns pass through each other by " + std::to_string(overlap * 1e6) +
                         " micrometres, and by " + std::to_string(layout.paths.overlap * 1e6) +
                         " where they squeeze each other narrower by a tenth",
                     where, "expected thinner yarns, fewer of them, or tensions less apart"});
}

} // namespace

WeaveLayout lay_out(const Weave &weave, const GeometryOptions &options, const Progress &progress) {
    check_options(options);
    check_weave(weave, weave.name.empty() ? "weave" : weave.name);
    WeaveLayout layout{.draft = weave.draft,
                       .warp_spacing = weave.warp.spacing(),
                       .weft_spacing = weave.weft.spacing()};
    layout.section = {weave.warp.section, weave.weft.section};
    layout.points = options.points_per_crossing;
    const double size_x = layout.draft.ends * layout.warp_spacing;
    const double size_y = layout.draft.picks * layout.weft_spacing;
    layout.tiles_x =
        options.tiles_x > 0 ? options.tiles_x : tiles_for(weave.weft.twist_per_m, size_x);
    layout.tiles_y =
        options.tiles_y > 0 ? options.tiles_y : tiles_for(weave.warp.twist_per_m, size_y);
    layout.warp_turns = std::round(weave.warp.twist_per_m * size_y * layout.tiles_y);
    layout.weft_turns = std::round(weave.weft.twist_per_m * size_x * layout.tiles_x);
    const std::string name = weave.name.empty() ? "weave" : weave.name;
    check_twist(name + ".warp", layout.warp_turns,
                static_cast<double>(layout.draft.picks) * layout.tiles_y * layout.points);
    check_twist(name + ".weft", layout.weft_turns,
                static_cast<double>(layout.draft.ends) * layout.tiles_x * layout.points);
    check_size(weave, layout);
    place_yarns(weave, 1, options.stiffness_length, layout, progress);
    if (!has_room(layout))
        place_jammed(weave, name, options.stiffness_length, layout, progress);
    return layout;
}

} // namespace tsuya::lab::detail
