#include "tsuya/lab/virtual_camera.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/patch_window.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/hasher.h"
#include "tsuya/sdk/error.h"
#include "utc_text.h"

namespace tsuya::lab {
namespace {

constexpr double kGlint = 1e6; // times the light of the cloth

using Random = std::mt19937_64;

/// Random numbers of one purpose, the same whatever was drawn before.
Random random_of(std::uint32_t seed, std::string_view purpose, std::uint64_t number) {
    detail::Hasher hasher;
    hasher.text(purpose);
    hasher.value(seed);
    hasher.value(number);
    return Random(hasher.result());
}

/// A frame beside the plan is known by its time.
std::uint64_t number_of(const Shot &shot) {
    return shot.number ? *shot.number : static_cast<std::uint64_t>(std::llround(shot.time_s * 1e3));
}

/// As cameras write it, in UTC. Without it two pictures of a clipped white would be copies.
std::string time_text(double time_s) { return utc_text(time_s, "%Y:%m:%d %H:%M:%S"); }

/// The texture of a cloth: light of each pixel over the mean.
class Texture {
  public:
    Texture(const VirtualScene &scene, const RigCamera &camera, const PlannedFrame &frame,
            std::uint32_t seed)
        : contrast_(frame.kind == FrameKind::cloth ? scene.contrast : 0),
          random_(random_of(seed, "texture", frame.view)) {
        if (scene.repeat_mm[0] > 0 && camera.pixel_mm > 0)
            lattice_ = lattice_in_picture(scene.repeat_mm, camera.pixel_mm, frame.directions);
    }

    double at(int x, int y) {
        if (contrast_ <= 0)
            return 1;
        return lattice_ ? periodic(*lattice_, x, y) : independent();
    }

  private:
    /// Two waves along the yarns, each of contrast 1 / sqrt(2).
    double periodic(const PictureLattice &lattice, int x, int y) const {
        const glm::dvec2 p(x, y);
        const auto cross = [](const glm::dvec2 &a, const glm::dvec2 &b) {
            return a.x * b.y - a.y * b.x;
        };
        const double area = cross(lattice.weft, lattice.warp);
        return 1 + contrast_ * (std::cos(2 * kPi * cross(p, lattice.warp) / area) +
                                std::cos(2 * kPi * cross(lattice.weft, p) / area));
    }
    double independent() {
        const double sigma = std::sqrt(std::log1p(contrast_ * contrast_));
        return std::lognormal_distribution<double>(-sigma * sigma / 2, sigma)(random_);
    }

    double contrast_;
    Random random_;
    std::optional<PictureLattice> lattice_{};
};

} // namespace

VirtualCamera::VirtualCamera(VirtualScene scene, RigCamera camera, VirtualCameraSettings settings,
                             Clock *clock)
    : scene_(std::move(scene)), camera_(std::move(camera)), settings_(std::move(settings)),
      clock_(clock) {}

double VirtualCamera::lamp_share(double time_s) const {
    const double age_s = time_s - first_time_s_.value_or(time_s);
    return 1 + scene_.drift * -std::expm1(-age_s / scene_.drift_s);
}

double VirtualCamera::light_of_white(const PlannedFrame &frame, double time_s) const {
    return scene_.white_dn_per_s * lamp_share(time_s) * std::cos(frame.directions.theta_i);
}

bool VirtualCamera::is_monitor(int x, int y) const {
    const PictureArea &area = camera_.monitor;
    return settings_.monitor_dn_per_s > 0 && x >= area.x && y >= area.y &&
           x < area.x + area.width && y < area.y + area.height;
}

double VirtualCamera::lens_at(int x, int y) const {
    const glm::dvec2 half(settings_.width / 2.0, settings_.height / 2.0);
    const glm::dvec2 off = glm::dvec2(x + 0.5, y + 0.5) - half;
    return 1 - settings_.vignetting * glm::dot(off, off) / glm::dot(half, half);
}

double VirtualCamera::dn_per_s(const PlannedFrame &frame, double time_s) const {
    const double white = light_of_white(frame, time_s);
    switch (frame.kind) {
    case FrameKind::white:
        return white;
    case FrameKind::cloth:
        return white * scene_.cloth(frame.directions) * kPi / scene_.white_reflectance *
               (frame.view == scene_.glint_view ? kGlint : 1);
    case FrameKind::dark:
    case FrameKind::trap:
        break;
    }
    return 0;
}

Image VirtualCamera::sample_dn_per_s(const PlannedFrame &frame, double time_s) const {
    const bool open = frame.kind == FrameKind::cloth || frame.kind == FrameKind::white;
    if (scene_.picture && open) {
        Image seen = scene_.picture(frame, settings_.width, settings_.height);
        const double perfect_white =
            scene_.white_dn_per_s * lamp_share(time_s) / scene_.white_reflectance;
        for (float &value : seen.data)
            value = static_cast<float>(perfect_white * double{value});
        return seen;
    }
    Image seen = Image::make(settings_.width, settings_.height, {"Y"});
    const double even = dn_per_s(frame, time_s);
    Texture texture(scene_, camera_, frame, settings_.seed);
    for (int y = 0; y < settings_.height; ++y)
        for (int x = 0; x < settings_.width; ++x)
            seen.pixel(x, y)[0] = static_cast<float>(even * texture.at(x, y));
    return seen;
}

CameraFrame VirtualCamera::picture_of(const Shot &shot, double exposure_s) const {
    const double middle_s = shot.time_s + exposure_s / 2;
    Random random = random_of(settings_.seed, "noise", number_of(shot));
    std::normal_distribution<double> normal;
    const double flicker = 1 + scene_.flicker * normal(random);
    const Image sample = sample_dn_per_s(shot.planned, middle_s);
    const double stray = shot.planned.kind == FrameKind::dark
                             ? 0
                             : scene_.stray * light_of_white(shot.planned, middle_s);
    CameraFrame frame{.image = Image::make(settings_.width, settings_.height, {"Y"}),
                      .exposure_s = exposure_s,
                      .time = time_text(shot.time_s)};
    const bool open = shot.planned.kind != FrameKind::dark;
    const double monitor = open ? settings_.monitor_dn_per_s * lamp_share(middle_s) : 0;
    for (int y = 0; y < settings_.height; ++y)
        for (int x = 0; x < settings_.width; ++x) {
            const double seen = is_monitor(x, y)
                                    ? monitor
                                    : (double{sample.pixel(x, y)[0]} + stray) * lens_at(x, y);
            const double light = seen * flicker;
            const double rate = light * camera_.e_per_dn + settings_.dark_e_per_s;
            std::poisson_distribution<long> photons(std::min(rate * exposure_s, 1e9));
            const double electrons =
                static_cast<double>(photons(random)) + camera_.read_noise_e * normal(random);
            frame.image.pixel(x, y)[0] = static_cast<float>(std::clamp(
                std::round(camera_.black + settings_.black_shift + electrons / camera_.e_per_dn),
                0.0, camera_.saturation));
        }
    return frame;
}

void VirtualCamera::expose(const Shot &shot) {
    fault_ = settings_.fault ? settings_.fault(exposures_) : std::nullopt;
    ++exposures_;
    if (fault_ == CameraFault::busy)
        throw Error(
            {"the virtual camera is busy", shot.file.string(), "expected a camera at rest"});
    if (!first_time_s_)
        first_time_s_ = shot.time_s;
    if (clock_)
        (void)clock_->sleep_until(clock_->now() +
                                      std::chrono::round<std::chrono::nanoseconds>(
                                          std::chrono::duration<double>(shot.planned.exposure_s)),
                                  nullptr);
}

void VirtualCamera::collect(const Shot &shot) {
    if (fault_ == CameraFault::hang)
        throw Error({"the virtual camera gives no picture in time", shot.file.string(),
                     "expected a picture within its timeout_s"});
    if (fault_ == CameraFault::no_file)
        return;
    if (fault_ == CameraFault::old_file && !last_.empty()) {
        std::filesystem::copy_file(last_, shot.file);
        return;
    }
    write_frame(shot.file, picture_of(shot, shot.planned.exposure_s *
                                                (fault_ == CameraFault::wrong_exposure ? 0.5 : 1)));
    if (fault_ == CameraFault::empty_file)
        std::filesystem::resize_file(shot.file, 0);
    if (fault_ == CameraFault::cut_file)
        std::filesystem::resize_file(shot.file, std::filesystem::file_size(shot.file) / 2);
    if (!fault_)
        last_ = shot.file;
}

} // namespace tsuya::lab
