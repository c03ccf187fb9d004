#include "tsuya/scene/studio_preset.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tsuya/scene/sky.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

/// The diagonal of the bounds of the dress form that the studios were arranged around, metres.
constexpr double kArrangedSize = 1.73;

/// Where a light stands: degrees from the camera to its right, degrees above the horizon, and
/// metres from the middle of the dress form.
struct Stand {
    double right_deg, up_deg, distance;
};

/// A studio while it is put together.
class Builder {
  public:
    explicit Builder(const Subject &subject)
        : subject_(subject), middle_(0.5 * (subject.lower + subject.upper)),
          size_(std::max(glm::length(subject.upper - subject.lower), 1e-3)),
          metre_(size_ / kArrangedSize) {
        studio_.backdrop = {.centre = {middle_.x, subject.lower.y, middle_.z},
                            .azimuth = subject.azimuth,
                            .width = 8 * size_,
                            .front = 3 * size_,
                            .back = 1.6 * size_,
                            .height = 4 * size_,
                            .radius = 0.8 * size_};
    }

    LightGroupIndex group(const char *name, const char *lamp) {
        studio_.groups.push_back({name, lamp});
        return {static_cast<std::uint32_t>(studio_.groups.size() - 1)};
    }
    /// A rectangle that faces the subject. \param strength see Softbox
    void softbox(const char *name, Stand stand, double width, double height, double strength,
                 LightGroupIndex group) {
        RectangleLight light =
            make_light({.centre = at(stand),
                        .target = middle_,
                        .up = stand.up_deg > 80 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0),
                        .width = width * metre_,
                        .height = height * metre_,
                        .strength = strength,
                        .group = group});
        light.name = name;
        studio_.lights.emplace_back(std::move(light));
    }
    /// \param aim height over the middle that it shines at, metres
    void spot(const char *name, Stand stand, double aim, double cone_deg, double strength,
              LightGroupIndex group) {
        const glm::dvec3 target = middle_ + glm::dvec3(0, aim * metre_, 0);
        const double half = 0.5 * cone_deg * kDegree;
        add(PointLight{.name = name,
                       .position = at(stand),
                       .direction = target - at(stand),
                       .full_angle = 0.4 * half,
                       .cone_angle = half,
                       .group = group},
            strength, target);
    }
    void globe(const char *name, Stand stand, double radius, double strength,
               LightGroupIndex group) {
        add(
            SphereLight{
                .name = name, .centre = at(stand), .radius = radius * metre_, .group = group},
            strength, middle_);
    }
    void disk(const char *name, Stand stand, double radius, double strength,
              LightGroupIndex group) {
        add(DiskLight{.name = name,
                      .centre = at(stand),
                      .direction = middle_ - at(stand),
                      .radius = radius * metre_,
                      .group = group},
            strength, middle_);
    }
    void sun(double right_deg, double up_deg, double strength, LightGroupIndex group) {
        studio_.lights.emplace_back(SunLight{.name = "sun",
                                             .to_light = towards(right_deg, up_deg),
                                             .irradiance = strength * kPi,
                                             .group = group});
    }
    void environment(Environment environment) { studio_.environment = std::move(environment); }
    void backdrop(double reflectance) { studio_.backdrop_reflectance = reflectance; }
    double azimuth() const { return subject_.azimuth; }
    /// Lengths of the studio that a try-on always had are in sizes of the subject.
    double metres_of_sizes(double sizes) const { return sizes * kArrangedSize; }
    Studio finish() { return std::move(studio_); }

  private:
    glm::dvec3 towards(double right_deg, double up_deg) const {
        return direction_at(subject_.azimuth + right_deg * kDegree, up_deg * kDegree);
    }
    glm::dvec3 at(const Stand &s) const {
        return middle_ + s.distance * metre_ * towards(s.right_deg, s.up_deg);
    }
    /// \param strength at the target, see Softbox
    void add(Light light, double strength, const glm::dvec3 &target) {
        emission_of(light) = 1;
        const glm::dvec3 normal = glm::normalize(place_of(light)->centre - target);
        emission_of(light) = strength * kPi / irradiance(light, target, normal);
        studio_.lights.push_back(std::move(light));
    }

    Subject subject_;
    glm::dvec3 middle_;
    double size_, metre_;
    Studio studio_{};
};

// Found by looking at the sample dresses, in white and in black.

void portrait(Builder &b) {
    const LightGroupIndex key = b.group("key", "D65"), fill = b.group("fill", "D65");
    const auto sizes = [&](double s) { return b.metres_of_sizes(s); };
    b.softbox("key", {-56, 30, sizes(1.5)}, sizes(0.2), sizes(0.5), 0.95, key);
    b.softbox("strip", {75, 12, sizes(1.4)}, sizes(0.3), sizes(0.8), 0.3, key);
    b.environment({.radiance = 0.14, .group = fill});
}

void softbox(Builder &b) {
    const LightGroupIndex key = b.group("key", "D65"), strips = b.group("strips", "D65"),
                          fill = b.group("fill", "D65");
    b.softbox("key", {-45, 28, 2.2}, 1.2, 1.8, 0.8, key);
    b.softbox("left strip", {-140, 12, 2.1}, 0.3, 1.7, 0.55, strips);
    b.softbox("right strip", {140, 12, 2.1}, 0.3, 1.7, 0.75, strips);
    b.environment({.picture = gradient_picture(0.05, 0.14, 0.3), .group = fill});
    b.backdrop(0.3);
}

void shop(Builder &b) {
    const LightGroupIndex spots = b.group("spots", "HP4"), room = b.group("room", "FL11");
    b.spot("left", {-40, 42, 2.6}, 0.2, 34, 0.8, spots);
    b.spot("right", {35, 46, 2.5}, 0.1, 34, 0.55, spots);
    b.spot("front", {-4, 52, 2.4}, 0, 40, 0.36, spots);
    b.spot("behind", {160, 50, 2.2}, 0.3, 36, 0.6, spots);
    b.environment({.picture = gradient_picture(0.08, 0.14, 0.28), .group = room});
    b.backdrop(0.5);
}

void home(Builder &b) {
    const LightGroupIndex lamps = b.group("lamps", "A"), room = b.group("room", "A"),
                          window = b.group("window", "D65");
    b.globe("floor lamp", {-62, 14, 1.7}, 0.16, 0.66, lamps);
    b.globe("ceiling lamp", {20, 62, 1.9}, 0.2, 0.42, lamps);
    b.softbox("window", {112, 10, 2.4}, 1.0, 1.4, 0.07, window);
    b.environment({.picture = gradient_picture(0.08, 0.14, 0.2), .group = room});
    b.backdrop(0.35);
}

void daylight(Builder &b) {
    const LightGroupIndex sun = b.group("sun", "D50"), sky = b.group("sky", "D65");
    constexpr double kRight = -48, kUp = 38; // of the sun, degrees
    b.sun(kRight, kUp, 0.85, sun);
    b.environment({.radiance = 0.24,
                   .picture = sky_picture({.type = 12,
                                           .azimuth = b.azimuth() + kRight * kDegree,
                                           .elevation = kUp * kDegree,
                                           .ground = 0.5}),
                   .group = sky});
    b.backdrop(0.4);
}

void gallery(Builder &b) {
    const LightGroupIndex ceiling = b.group("ceiling", "LED-B3"),
                          accent = b.group("accent", "LED-B3");
    b.softbox("ceiling", {-20, 74, 2.4}, 3.2, 2.2, 0.62, ceiling);
    b.spot("accent", {-32, 36, 3.0}, 0.15, 30, 0.5, accent);
    b.environment({.picture = gradient_picture(0.14, 0.3, 0.34), .group = ceiling});
    b.backdrop(0.75);
}

// [Takeda] Fig. 31: one lamp from the left
void lab(Builder &b) {
    const LightGroupIndex lamp = b.group("lamp", "MH-NIST");
    b.disk("lamp", {-60, 20, 3.0}, 0.1, 0.95, lamp);
    b.backdrop(0.05);
}

struct Preset {
    const char *name, *description;
    void (*build)(Builder &);
};
constexpr std::array<Preset, 7> kPresets{{
    {"portrait", "a softbox from the left, a strip from the right, an even fill", portrait},
    {"softbox", "a large softbox at 45 degrees, two strips behind, a fill that fades downwards",
     softbox},
    {"shop", "metal-halide spots from the ceiling, fluorescent tubes around", shop},
    {"home", "tungsten lamps on the floor and the ceiling, a window at dusk", home},
    {"daylight", "sun and clear sky", daylight},
    {"gallery", "an even ceiling of LEDs, a spot from the left, white walls", gallery},
    {"lab", "a single small lamp from the left, a dark room", lab},
}};

const Preset &find(std::string_view name) {
    const auto found = std::find_if(kPresets.begin(), kPresets.end(),
                                    [&](const Preset &p) { return p.name == name; });
    if (found == kPresets.end())
        throw Error({"there is no studio '" + std::string(name) + "'", "studio",
                     accepted_names(std::string(name), studio_names())});
    return *found;
}

} // namespace

std::vector<std::string> studio_names() {
    std::vector<std::string> names;
    for (const Preset &preset : kPresets)
        names.emplace_back(preset.name);
    return names;
}

std::string studio_description(std::string_view name) {
    std::string text = find(name).description;
    std::string before = ": ";
    for (const StudioGroup &group : make_studio(name, {}).groups) {
        text += before + group.name + " " + group.lamp;
        before = ", ";
    }
    return text;
}

Studio make_studio(std::string_view name, const Subject &subject) {
    const Preset &preset = find(name);
    Builder builder(subject);
    preset.build(builder);
    return builder.finish();
}

} // namespace tsuya::scene
