#include "tsuya/lab/weave_geometry.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"
#include "weave_layout.h"

namespace tsuya::lab {
namespace {

using detail::WeaveLayout;

/// 0 to 1 from a seed and what is to be told apart. [Wellons] gives the mixer.
double hashed(std::uint64_t seed, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint64_t x = seed + 0x9e3779b97f4a7c15u * (1 + a + 1021ull * b + 1048573ull * c);
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    x = (x ^ (x >> 32)) * 0xd6e8feb86659fd93u;
    x ^= x >> 32;
    return static_cast<double>(x >> 11) * 0x1p-53;
}

/// One yarn of one system, as its filaments need it.
struct YarnPlan {
    std::uint32_t system = 0, yarn = 0;
    double axis = 0;                  ///< place of the axis across the yarn, metres
    double step = 0;                  ///< of the points along the yarn, metres
    std::vector<double> height{};     ///< of the axis
    std::vector<glm::dvec2> normal{}; ///< of the axis: along the yarn, along z
    double turns = 0;                 ///< whole, over the repeat
};

YarnPlan plan_of(const WeaveLayout &layout, std::uint32_t system, int yarn) {
    const bool warp = system == 0;
    const detail::YarnPaths &paths = layout.paths;
    const int n = (warp ? paths.warp_points * layout.tiles_y : paths.weft_points * layout.tiles_x);
    const int in_draft = yarn % (warp ? layout.draft.ends : layout.draft.picks);
    YarnPlan plan;
    plan.system = system;
    plan.yarn = static_cast<std::uint32_t>(yarn);
    plan.axis = (yarn + 0.5) * (warp ? layout.warp_spacing : layout.weft_spacing);
    plan.step = (warp ? layout.weft_spacing : layout.warp_spacing) / layout.points;
    plan.turns = warp ? layout.warp_turns : layout.weft_turns;
    const auto height = [&](int k) {
        return warp ? paths.warp_height(in_draft, k) : paths.weft_height(in_draft, k);
    };
    for (int k = 0; k < n; ++k) {
        plan.height.push_back(height(k));
        // The tangent of the Catmull-Rom spline at its points.
        const double slope = (height(k + 1) - height(k - 1)) / (2 * plan.step);
        plan.normal.push_back(glm::normalize(glm::dvec2(-slope, 1.0)));
    }
    return plan;
}

/// A place in the section of a yarn (across, along its normal) as a point of the cloth. `across` is
/// counted so that (across, normal, along) is right-handed: +y for weft, -x for warp.
glm::vec3 point_of(const YarnPlan &plan, std::size_t k, glm::dvec2 place) {
    const double along = plan.step * static_cast<double>(k) + place.y * plan.normal[k].x;
    const double z = plan.height[k] + place.y * plan.normal[k].y;
    return plan.system == 0 ? glm::vec3(plan.axis - place.x, along, z)
                            : glm::vec3(along, plan.axis + place.x, z);
}

/// How far a section that is not round sways about its axis along the repeat, so that no flat side
/// of a filament is one long facet. Our choice.
constexpr double kSway = 0.6;

void append_filaments(const WeaveLayout &layout, const YarnPlan &plan, std::uint64_t seed,
                      std::vector<Filament> &filaments) {
    constexpr double kTurn = 2 * kPi;
    const bool warp = plan.system == 0;
    const detail::FilamentPacking &packing = warp ? layout.warp_packing : layout.weft_packing;
    const bool round = layout.section[plan.system] == FilamentSection::round;
    std::uint32_t number = 0;
    for (const detail::FilamentRing &ring : packing.rings) {
        const bool turns = ring.outline.radius > 0;
        const double first =
            turns ? hashed(seed, plan.system, plan.yarn, 7919u + number) : 0.5 / ring.count;
        for (int i = 0; i < ring.count; ++i, ++number) {
            const std::uint32_t id = number * 4;
            const double jitter =
                packing.slack * std::sqrt(hashed(seed, plan.system, plan.yarn, id));
            const double direction = kTurn * hashed(seed, plan.system, plan.yarn, id + 1);
            const glm::dvec2 shift = jitter * glm::dvec2(std::cos(direction), std::sin(direction));
            const double facing = kTurn * hashed(seed, plan.system, plan.yarn, id + 2);
            const double sway = kTurn * hashed(seed, plan.system, plan.yarn, id + 3);
            Filament filament{.radius = static_cast<float>(packing.filament_radius),
                              .system = plan.system,
                              .yarn = plan.yarn};
            const std::size_t n = plan.height.size();
            for (std::size_t k = 0; k < n; ++k) {
                const double along = static_cast<double>(k) / static_cast<double>(n);
                const double phase =
                    first + static_cast<double>(i) / ring.count + (turns ? plan.turns * along : 0);
                const glm::dvec2 place = ring_place(ring, phase) + shift;
                filament.point.push_back(point_of(plan, k, place));
                if (!round)
                    filament.turn.push_back(
                        static_cast<float>(facing + kTurn * plan.turns * along +
                                           kSway * std::sin(kTurn * along + sway)));
            }
            filaments.push_back(std::move(filament));
        }
    }
}

} // namespace

FilamentRepeat build_filaments(const Weave &weave, const GeometryOptions &options) {
    const WeaveLayout layout = detail::lay_out(weave, options);
    const int ends = layout.draft.ends * layout.tiles_x,
              picks = layout.draft.picks * layout.tiles_y;
    FilamentRepeat repeat;
    repeat.name = weave.name;
    repeat.size = {ends * layout.warp_spacing, picks * layout.weft_spacing};
    repeat.optics = {optics(weave.warp, options.wavelength_nm),
                     optics(weave.weft, options.wavelength_nm)};
    for (int e = 0; e < ends; ++e)
        append_filaments(layout, plan_of(layout, 0, e), options.seed, repeat.filaments);
    for (int p = 0; p < picks; ++p)
        append_filaments(layout, plan_of(layout, 1, p), options.seed, repeat.filaments);
    check_repeat(repeat, weave.name.empty() ? "weave" : weave.name);
    return repeat;
}

} // namespace tsuya::lab
