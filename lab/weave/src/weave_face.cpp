#include "tsuya/lab/weave_face.h"

#include <algorithm>
#include <cmath>

#include "path_spline.h"
#include "tsuya/sdk/error.h"
#include "weave_layout.h"

namespace tsuya::lab {
namespace {

using detail::WeaveLayout;
using detail::YarnSection;

/// The place of `crossing + within` along the float that lies there, 0 to 1; beyond the ends of a
/// float, where a yarn is seen beside the one that crosses it, that end.
template <class OnFace> double along_float(const OnFace &on_face, int crossing, double within) {
    if (!on_face(crossing)) {
        const bool of_last = within < 0.5;
        if (on_face(crossing + (of_last ? -1 : 1)))
            return of_last ? 1 : 0;
        return 0.5;
    }
    int first = crossing, last = crossing;
    while (on_face(first - 1))
        --first;
    while (on_face(last + 1))
        ++last;
    return (crossing - first + within) / (last + 1 - first);
}

/// A yarn at a place of the cloth.
struct Candidate {
    double top = -1e300; ///< of its surface, metres
    WeavePlace place{};
};

/// Looks down at one place. `x` and `y` are counted in crossings, x along the weft.
class FaceView {
  public:
    explicit FaceView(const WeaveLayout &layout) : layout_(layout) {}

    WeavePlace at(double x, double y) const {
        const Candidate warp = of_warp(x, y), weft = of_weft(x, y);
        return warp.top >= weft.top ? warp.place : weft.place;
    }

  private:
    Candidate of_warp(double x, double y) const {
        const int end = static_cast<int>(std::floor(x)), pick = static_cast<int>(std::floor(y));
        const auto height = [&](int k) { return layout_.paths.warp_height(end, k); };
        const auto on_face = [&](int p) { return layout_.draft.up(end, p); };
        return seen(WeavePlace::kWarp, end, x - end, layout_.warp_spacing, layout_.warp, height, y,
                    layout_.weft_spacing, along_float(on_face, pick, y - pick));
    }
    Candidate of_weft(double x, double y) const {
        const int end = static_cast<int>(std::floor(x)), pick = static_cast<int>(std::floor(y));
        const auto height = [&](int k) { return layout_.paths.weft_height(pick, k); };
        const auto on_face = [&](int e) { return !layout_.draft.up(e, pick); };
        return seen(WeavePlace::kWeft, pick, y - pick, layout_.weft_spacing, layout_.weft, height,
                    x, layout_.warp_spacing, along_float(on_face, end, x - end));
    }

    /// \param thread, within of the yarn and where in its own space, 0 to 1, the place lies
    /// \param way along the yarn, in crossings
    template <class Height>
    Candidate seen(std::uint8_t system, int thread, double within, double spacing,
                   const YarnSection &section, const Height &height, double way, double step,
                   double along) const {
        const double across = (within - 0.5) * spacing, half = section.half_thickness(across);
        if (half < 0)
            return {};
        const double point = way * layout_.points;
        const int k = static_cast<int>(std::floor(point));
        const double rise = detail::spline_rise(height, k, point - k) * layout_.points / step;
        const double top = detail::spline(height, k, point - k) + half;
        return {top,
                {.system = system,
                 .thread = static_cast<std::uint16_t>(thread),
                 .slope = static_cast<float>(std::atan(rise)),
                 .along = static_cast<float>(along),
                 .across = static_cast<float>(std::clamp(across / section.half_width(), -1.0, 1.0)),
                 .height = static_cast<float>(top)}};
    }

    const WeaveLayout &layout_;
};

/// Filaments of the outermost ring that lie on one of its two sides, the most that are seen.
int side_by_side(const detail::FilamentPacking &packing, const YarnSection &section) {
    return std::max(1,
                    static_cast<int>(std::lround(section.half_width() / packing.filament_radius)));
}

} // namespace

WeaveMap face_of(const Weave &weave, int places, const GeometryOptions &options,
                 const Progress &progress) {
    if (places < 2 || places > 64)
        throw Error({"a map of " + std::to_string(places) + " places a crossing", "places",
                     "expected 2 to 64"});
    const WeaveLayout layout = detail::lay_out(weave, options, progress);
    const int crossings = layout.draft.ends * layout.draft.picks;
    while (places > 2 && crossings * places * places > kMostFacePlaces)
        --places;
    const int nx = layout.draft.ends * places, ny = layout.draft.picks * places;
    WeaveMap map{.repeat = {layout.draft.ends * layout.warp_spacing,
                            layout.draft.picks * layout.weft_spacing},
                 .size = {nx, ny},
                 .threads = {layout.draft.ends, layout.draft.picks},
                 .filaments = {side_by_side(layout.weft_packing, layout.weft),
                               side_by_side(layout.warp_packing, layout.warp)}};
    const FaceView view(layout);
    map.place.reserve(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i)
            map.place.push_back(view.at((i + 0.5) / places, (j + 0.5) / places));
    return map;
}

} // namespace tsuya::lab
