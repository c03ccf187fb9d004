#include "tsuya/lab/session_pictures.h"

#include <algorithm>
#include <map>

#include "frame_patches.h"
#include "tsuya/color/sheet.h"
#include "tsuya/color/srgb.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr int kColumns = 6;
constexpr std::size_t kPictures = 24, kLeftOut = 6; // at most, in all and of those left out
constexpr int kPatches = 5;                         // along the side of what is shown
constexpr int kSide = 170;                          // pixels of a picture, or little more
constexpr std::array<float, 3> kOutline{1.0f, 0.85f, 0.1f}, kClipped{1.0f, 0.1f, 0.1f};

using Frames = std::vector<const CountedFrame *>;

/// Frames by view.
std::map<std::size_t, Frames> views_of(const Session &session) {
    std::map<std::size_t, Frames> views;
    for (const CountedFrame &frame : session.frames)
        views[frame.planned.view].push_back(&frame);
    return views;
}

/// Which views are shown, in their order.
class Choice {
  public:
    explicit Choice(const std::map<std::size_t, Frames> &views) : views_(views) {}

    void add(std::size_t view) {
        if (chosen_.size() < kPictures && views_.contains(view))
            chosen_.emplace(view, "");
    }
    void add_left_out(const SessionMeasurement &measured) {
        for (const LeftOutView &view : measured.left_out)
            if (chosen_.size() < kLeftOut && views_.contains(view.view))
                chosen_[view.view] = name_of(view.reason);
    }
    void add_first(FrameKind kind) {
        for (const auto &[view, frames] : views_)
            if (frames[0]->planned.kind == kind)
                return add(view);
    }
    /// Views of the cloth at equal distances.
    void fill() {
        std::vector<std::size_t> cloth;
        for (const auto &[view, frames] : views_)
            if (frames[0]->planned.kind == FrameKind::cloth && !chosen_.contains(view))
                cloth.push_back(view);
        const std::size_t free = std::min(kPictures - chosen_.size(), cloth.size());
        for (std::size_t i = 0; i < free; ++i)
            add(cloth[free > 1 ? i * (cloth.size() - 1) / (free - 1) : 0]);
    }
    /// With the reason of those that are left out.
    const std::map<std::size_t, std::string> &chosen() const { return chosen_; }

  private:
    const std::map<std::size_t, Frames> &views_;
    std::map<std::size_t, std::string> chosen_{};
};

/// A frame's middle, and the patch in it.
struct Middle {
    CameraFrame frame{};
    PixelArea patch{}; ///< in the part that was read
};

Middle read_middle(const CountedFrame &counted, const RigCamera &camera) {
    const CameraFrame header = read_frame_header(counted.file);
    const PatchGrid grid = grid_of(counted.file, header.width, header.height, camera,
                                   counted.planned.directions.theta_r);
    const int side = std::min({header.width, header.height, kPatches * grid.side});
    const int margin = (grid.across / 2) * grid.side;
    const auto begin = [&](int grid_begin, int whole) {
        return std::clamp(grid_begin + (grid.width() - side) / 2, 0, whole - side);
    };
    FrameSettings settings{.area = PixelArea{begin(grid.area.x, header.width),
                                             begin(grid.area.y, header.height), side, side}};
    if (!camera.response.empty())
        settings.response = read_response_csv(camera.response);
    return {.frame = read_frame(counted.file, settings),
            .patch = {grid.area.x + margin - settings.area->x,
                      grid.area.y + margin - settings.area->y, grid.side, grid.side}};
}

bool is_clipped(const Middle &middle, const RigCamera &camera) {
    for (int y = 0; y < middle.patch.height; ++y)
        for (int x = 0; x < middle.patch.width; ++x)
            for (std::size_t c = 0; c < middle.frame.image.channels.size(); ++c)
                if (middle.frame.image.pixel(middle.patch.x + x, middle.patch.y + y)[c] >=
                    static_cast<float>(camera.saturation))
                    return true;
    return false;
}

/// Of the frames that can be read the longest exposure that is not clipped, else the shortest.
std::optional<std::pair<const CountedFrame *, Middle>> best_of(Frames frames,
                                                               const RigCamera &camera) {
    std::sort(frames.begin(), frames.end(), [](const CountedFrame *a, const CountedFrame *b) {
        return a->planned.exposure_s > b->planned.exposure_s;
    });
    std::optional<std::pair<const CountedFrame *, Middle>> best;
    for (const CountedFrame *frame : frames) {
        try {
            best = {frame, read_middle(*frame, camera)};
        } catch (const Error &) { // why it cannot be read is in the measurement
            continue;
        }
        if (!is_clipped(best->second, camera))
            break;
    }
    return best;
}

std::array<float, 3> shown_pixel(const Image &image, int x, int y, const RigCamera &camera) {
    const std::size_t channels = image.channels.size();
    std::array<float, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double dn = double{image.pixel(x, y)[channels >= 3 ? c : 0]};
        if (dn >= camera.saturation)
            return kClipped;
        colour[c] = static_cast<float>(srgb_encode(static_cast<float>(
            std::clamp((dn - camera.black) / (camera.saturation - camera.black), 0.0, 1.0))));
    }
    return colour;
}

/// Whether a pixel of the enlarged picture lies on the patch's outline.
bool on_outline(int x, int y, const PixelArea &patch, int times) {
    const int left = patch.x * times, top = patch.y * times, right = left + patch.width * times,
              bottom = top + patch.height * times;
    const bool inside = x >= left - 2 && x < right + 2 && y >= top - 2 && y < bottom + 2;
    return inside && (x < left || x >= right || y < top || y >= bottom);
}

/// Enlarged by a whole number where it is small, else every so many pixels.
Image shown(const Middle &middle, const RigCamera &camera) {
    const int side = middle.frame.image.width;
    const int times = std::max((kSide + side / 2) / side, 1), step = std::max(side / kSide, 1);
    const int size = side / step * times;
    PixelArea patch = middle.patch;
    for (int *part : {&patch.x, &patch.y, &patch.width, &patch.height})
        *part /= step;
    Image image = Image::make(size, size, {"R", "G", "B"});
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const std::array<float, 3> colour =
                on_outline(x, y, patch, times)
                    ? kOutline
                    : shown_pixel(middle.frame.image, x / times * step, y / times * step, camera);
            std::copy(colour.begin(), colour.end(), image.pixel(x, y));
        }
    return image;
}

std::string caption_of(const CountedFrame &frame, const std::string &reason) {
    const PlannedFrame &planned = frame.planned;
    std::string text = std::to_string(planned.view) + ": ";
    if (!reason.empty())
        text += reason;
    else if (planned.kind == FrameKind::cloth)
        text += number_text(planned.directions.theta_r / kDegree, 3) + ", " +
                number_text(planned.directions.phi_r / kDegree, 3);
    else
        text += name_of(planned.kind);
    return text + ", " + number_text(planned.exposure_s, 3) + " s";
}

} // namespace

Image contact_sheet(const Session &session, const SessionMeasurement &measured) {
    const RigCamera &camera = session.rig.camera;
    const std::map<std::size_t, Frames> views = views_of(session);
    Choice choice(views);
    choice.add_left_out(measured);
    for (const FrameKind kind : {FrameKind::dark, FrameKind::white, FrameKind::trap})
        choice.add_first(kind);
    choice.fill();
    Sheet sheet{.title = "Frames with the measured patch; view: theta_r, phi_r, exposure",
                .columns = kColumns};
    for (const auto &[view, reason] : choice.chosen())
        if (const auto best = best_of(views.at(view), camera))
            sheet.pictures.push_back(
                {shown(best->second, camera), caption_of(*best->first, reason)});
    if (sheet.pictures.empty())
        throw Error({"no frame can be read", session.folder.string(),
                     "expected a session that has been run"});
    sheet.columns = std::min(sheet.columns, static_cast<int>(sheet.pictures.size()));
    return draw_sheet(sheet);
}

} // namespace tsuya::lab
