#include "tsuya/lab/weave_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "filament_scene.h"
#include "random.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/threads.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kFewestCrossings = 4, kMostCrossings = 12; // across a picture
constexpr double kTurnPerSegment = 0.05;                    // radians; finer than a pixel
constexpr int kSectionPoints = 36;
constexpr int kBand = 16;         // rows between two reports
constexpr float kLampSize = 0.1f; // of the lamp's disk, radians
// Shares of the light that a face turned to the lamp has from it and from the sky.
constexpr float kLamp = 0.75f, kSky = 0.45f;
constexpr float kGloss = 0.25f, kGlossPower = 40;
// [Roberts] R2, for the lamp and for the sky; the latter as fast the other way round.
const glm::vec4 kStep{0.7548777f, 0.5698403f, 0.5698403f, 0.7548777f};
constexpr float kBlack = 0.22f;              // what black yarns are drawn with
const glm::vec3 kGround{0.75f, 0.8f, 0.85f}; // behind the cloth
const glm::vec3 kInk{0.03f}, kPaper{0.9f}, kFrame{0.75f, 0.1f, 0.05f};

void check(const WeavePictureSettings &s) {
    Problems problems;
    const auto expect = [&](bool good, const std::string &name, const char *accepted) {
        problems.need(good, name + " is out of range", "settings." + name, accepted);
    };
    expect(s.width >= 16 && s.width <= 8192, "width", "expected 16 to 8192 pixels");
    expect(s.height >= 16 && s.height <= 8192, "height", "expected 16 to 8192 pixels");
    expect(s.across == 0 || (s.across >= 1e-6 && s.across <= 1), "across",
           "expected 0 (chosen) or 1e-6 to 1 metres");
    expect(s.tilt >= 0 && s.tilt <= 1.3, "tilt", "expected 0 to 1.3 radians");
    const int side = static_cast<int>(std::lround(std::sqrt(std::max(0, s.samples_per_pixel))));
    expect(side >= 1 && side <= 32 && side * side == s.samples_per_pixel, "samples_per_pixel",
           "expected a square number from 1 to 1024");
    expect(s.threads >= 0, "threads", "expected 0 (all) or more");
    problems.throw_if_any();
}

// What a yarn is drawn with: its transmission, lifted off black.
glm::vec3 color_of(const Yarn &yarn) {
    const glm::vec3 t(yarn.transmission[0], yarn.transmission[1], yarn.transmission[2]);
    return t + kBlack * (1 - std::max({t.r, t.g, t.b}));
}

void put(Image &image, int x, int y, const glm::vec3 &color) {
    float *const pixel = image.pixel(x, y);
    for (int c = 0; c < 3; ++c)
        pixel[c] = color[c];
}

class Painter {
  public:
    Painter(const Weave &weave, const WeavePictureSettings &settings, const Progress &progress)
        : Painter(weave, settings, build_filaments(weave, settings.geometry), progress) {}

    glm::vec3 pixel(int x, int y) const;

  private:
    Painter(const Weave &weave, const WeavePictureSettings &settings, const FilamentRepeat &repeat,
            const Progress &progress)
        : settings_(settings),
          scene_(FilamentCell(repeat, kTurnPerSegment, kSectionPoints, progress), progress,
                 FilamentScene::Normals::smooth),
          color_{color_of(weave.warp), color_of(weave.weft)} {
        double radius = 0;
        for (const Filament &f : repeat.filaments)
            radius += f.radius;
        const double unit = radius / static_cast<double>(repeat.filaments.size());
        pixel_ = static_cast<float>(width_of_picture(weave, settings) / unit / settings.width);
        const auto c = static_cast<float>(std::cos(settings.tilt));
        const auto s = static_cast<float>(std::sin(settings.tilt));
        to_viewer_ = {0, -s, c};
        up_ = {0, c, s};
        to_lamp_ = glm::normalize(glm::vec3(-0.5f, 0.6f, 1.1f));
        // The middle of the picture is the middle of the part that draft_picture shows
        centre_ =
            0.5f * pixel_ * glm::vec3(settings.width, static_cast<float>(settings.height) / c, 0);
        centre_.z = 0.5f * (scene_.cell().top + scene_.cell().bottom);
    }
    // \param u four numbers in [0, 1): the place on the lamp and that in the sky
    glm::vec3 sample(const glm::vec2 &place, const glm::vec4 &u) const;
    glm::vec3 shade(const Hit &hit, const glm::vec4 &u) const;

    const WeavePictureSettings &settings_;
    FilamentScene scene_;
    std::array<glm::vec3, 2> color_;
    float pixel_ = 0; // in units of the cell
    glm::vec3 to_viewer_{}, up_{}, to_lamp_{}, centre_{};
};

glm::vec3 Painter::shade(const Hit &hit, const glm::vec4 &u) const {
    const glm::vec3 origin = hit.point + kRayOffset * hit.normal;
    // The lamp, through one point of its disk
    const float radius = kLampSize * std::sqrt(u.x);
    const float angle = 2 * kPiF * u.y;
    const glm::vec3 side = glm::normalize(glm::cross(to_lamp_, glm::vec3(0, 0, 1)));
    const glm::vec3 lamp =
        glm::normalize(to_lamp_ + radius * (std::cos(angle) * side +
                                            std::sin(angle) * glm::cross(side, to_lamp_)));
    float diffuse = 0, gloss = 0;
    const float facing = glm::dot(lamp, hit.normal);
    if (facing > 0 && scene_.escapes(origin, lamp)) {
        const float half = glm::dot(glm::normalize(lamp + to_viewer_), hit.normal);
        diffuse = kLamp * facing;
        gloss = kGloss * std::pow(std::max(0.0f, half), kGlossPower);
    }
    // The sky, through a direction of the cosine law: a point of the unit sphere about the normal
    const float z = 1 - 2 * u.z, r = std::sqrt(std::max(0.0f, 1 - z * z));
    const float turn = 2 * kPiF * u.w;
    const glm::vec3 away =
        hit.normal + 0.999f * glm::vec3(r * std::cos(turn), r * std::sin(turn), z);
    if (scene_.escapes(origin, glm::normalize(away)))
        diffuse += kSky;
    return color_[hit.system] * diffuse + gloss;
}

glm::vec3 Painter::sample(const glm::vec2 &place, const glm::vec4 &u) const {
    const glm::vec2 from_middle =
        pixel_ * (place - 0.5f * glm::vec2(settings_.width, settings_.height));
    glm::vec3 origin = centre_ + glm::vec3(from_middle.x, 0, 0) - from_middle.y * up_;
    origin += (scene_.cell().top + 1 - origin.z) / to_viewer_.z * to_viewer_;
    Hit hit;
    return scene_.trace(origin, -to_viewer_, hit) == Fate::hit ? shade(hit, u) : kGround;
}

glm::vec3 Painter::pixel(int x, int y) const {
    Random random(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 1);
    const int side = static_cast<int>(std::lround(std::sqrt(settings_.samples_per_pixel)));
    glm::vec3 sum{0};
    // Samples of a pixel are steps of an even sequence from a random start
    glm::vec4 u{random.unit(), random.unit(), random.unit(), random.unit()};
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const glm::vec2 jitter{random.unit(), random.unit()};
            const glm::vec2 within = (glm::vec2(i, j) + jitter) / static_cast<float>(side);
            sum += sample(glm::vec2(x, y) + within, u);
            u = glm::fract(u + kStep);
        }
    return glm::min(sum / static_cast<float>(side * side), glm::vec3(1));
}

void draw_bar(Image &image, double length, double across) {
    const int margin = std::max(2, image.width / 40), thick = std::max(2, image.width / 120);
    const int right = margin + static_cast<int>(std::lround(length / across * image.width));
    const int bottom = image.height - margin;
    for (int y = bottom - thick - 2; y < bottom + 2; ++y)
        for (int x = margin - 2; x < right + 2; ++x) {
            const bool inside = y >= bottom - thick && y < bottom && x >= margin && x < right;
            if (x >= 0 && x < image.width && y >= 0 && y < image.height)
                put(image, x, y, inside ? kInk : kPaper);
        }
}

// Distance in pixels to the nearest of the lines `step` apart.
double to_line(double position, double step) {
    return std::abs(position - step * std::round(position / step));
}

} // namespace

double width_of_picture(const Weave &weave, const WeavePictureSettings &settings) {
    if (settings.across > 0)
        return settings.across;
    const double aspect = static_cast<double>(settings.width) / settings.height;
    const auto wanted = [](int repeat, double spacing) {
        return spacing * std::clamp(static_cast<double>(repeat), kFewestCrossings, kMostCrossings);
    };
    return std::max(wanted(weave.draft.ends, weave.warp.spacing()),
                    wanted(weave.draft.picks, weave.weft.spacing()) * std::cos(settings.tilt) *
                        aspect);
}

double scale_bar(const Weave &weave, const WeavePictureSettings &settings) {
    const double about = width_of_picture(weave, settings) / 5;
    const double decade = std::pow(10, std::floor(std::log10(about)));
    return decade * (about >= 5 * decade ? 5 : about >= 2 * decade ? 2 : 1);
}

Image weave_picture(const Weave &weave, const WeavePictureSettings &settings,
                    const Progress &progress) {
    check(settings);
    const Painter painter(weave, settings, progress);
    Image image = Image::make(settings.width, settings.height, {"R", "G", "B"});
    tsuya::detail::run_with_threads(settings.threads, [&] {
        for (int first = 0; first < image.height; first += kBand) {
            if (progress.stopped())
                throw Interrupted("the picture of the weave was stopped");
            progress("picture", static_cast<double>(first) / image.height);
            tbb::parallel_for(first, std::min(first + kBand, image.height), [&](int y) {
                for (int x = 0; x < image.width; ++x)
                    put(image, x, y, painter.pixel(x, y));
            });
        }
    });
    progress("picture", 1);
    draw_bar(image, scale_bar(weave, settings), width_of_picture(weave, settings));
    return image;
}

Image draft_picture(const Weave &weave, const WeavePictureSettings &settings) {
    check(settings);
    check_weave(weave, weave.name.empty() ? "weave" : weave.name);
    Image image = Image::make(settings.width, settings.height, {"R", "G", "B"});
    const double metre = settings.width / width_of_picture(weave, settings); // in pixels
    const double x_step = weave.warp.spacing() * metre;
    const double y_step = weave.weft.spacing() * metre * std::cos(settings.tilt);
    const double right = x_step * weave.draft.ends, top = y_step * weave.draft.picks;
    const double line = std::max(1.0, settings.width / 900.0), frame = 2.5 * line;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const double x = column + 0.5, y = image.height - row - 0.5;
            const bool in = x <= right + frame && y <= top + frame;
            const bool on_frame = in && (x < frame || y < frame || std::abs(x - right) < frame ||
                                         std::abs(y - top) < frame);
            const bool on_line = to_line(x, x_step) < line || to_line(y, y_step) < line;
            const bool up = weave.draft.up(static_cast<int>(std::floor(x / x_step)),
                                           static_cast<int>(std::floor(y / y_step)));
            put(image, column, row,
                on_frame  ? kFrame
                : on_line ? 0.4f * kPaper
                : up      ? kInk
                          : kPaper);
        }
    return image;
}

} // namespace tsuya::lab
