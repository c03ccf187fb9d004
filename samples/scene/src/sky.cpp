#include "tsuya/scene/sky.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tsuya/scene/studio.h"

namespace tsuya::scene {
namespace {

constexpr int kGradientRows = 512;
constexpr int kSkyWidth = 256, kSkyHeight = 128;

/// [ISO15469] table 1: gradation a, b and indicatrix c, d, e of each type.
struct SkyType {
    double a, b, c, d, e;
};
constexpr std::array<SkyType, 15> kTypes{{{4.0, -0.70, 0, -1.0, 0},
                                          {4.0, -0.70, 2, -1.5, 0.15},
                                          {1.1, -0.80, 0, -1.0, 0},
                                          {1.1, -0.80, 2, -1.5, 0.15},
                                          {0, -1.00, 0, -1.0, 0},
                                          {0, -1.00, 2, -1.5, 0.15},
                                          {0, -1.00, 5, -2.5, 0.30},
                                          {0, -1.00, 10, -3.0, 0.45},
                                          {-1.0, -0.55, 2, -1.5, 0.15},
                                          {-1.0, -0.55, 5, -2.5, 0.30},
                                          {-1.0, -0.55, 10, -3.0, 0.45},
                                          {-1.0, -0.32, 10, -3.0, 0.45},
                                          {-1.0, -0.32, 16, -3.0, 0.30},
                                          {-1.0, -0.15, 16, -3.0, 0.30},
                                          {-1.0, -0.15, 24, -2.8, 0.15}}};

/// The direction of a pixel's middle, as Environment has it.
glm::dvec3 direction_of_pixel(const Image &picture, int x, int y) {
    const double azimuth = 2 * kPi * ((x + 0.5) / picture.width - 0.5);
    return direction_at(azimuth, kHalfPi - kPi * (y + 0.5) / picture.height);
}

/// Of the first `channels` channels, with radiance 1.
double level_irradiance_of(const Image &picture, std::size_t channels) {
    double sum = 0;
    for (int y = 0; y < picture.height; ++y) {
        const double top = kPi * y / picture.height;
        const double bottom = std::min(kPi * (y + 1) / picture.height, kHalfPi);
        if (top >= kHalfPi)
            break;
        // The integral of cosine x sine over the row
        const double share = 0.5 * (std::pow(std::sin(bottom), 2) - std::pow(std::sin(top), 2));
        for (int x = 0; x < picture.width; ++x)
            for (std::size_t c = 0; c < channels; ++c)
                sum += share * static_cast<double>(picture.pixel(x, y)[c]);
    }
    return sum * 2 * kPi / picture.width;
}

} // namespace

Image gradient_picture(double below, double horizon, double above) {
    Image picture = Image::make(1, kGradientRows, {"Y"});
    for (int y = 0; y < kGradientRows; ++y) {
        const double up = 1 - 2 * (y + 0.5) / kGradientRows; // -1 to 1
        picture.data[static_cast<std::size_t>(y)] =
            static_cast<float>(horizon + std::abs(up) * ((up > 0 ? above : below) - horizon));
    }
    return picture;
}

Image sky_picture(const Sky &sky) {
    const auto [a, b, c, d, e] = kTypes.at(static_cast<std::size_t>(sky.type - 1));
    const glm::dvec3 sun = direction_at(sky.azimuth, std::max(sky.elevation, 0.0));
    Image picture = Image::make(kSkyWidth, kSkyHeight, {"Y"});
    for (int y = 0; y < kSkyHeight; ++y)
        for (int x = 0; x < kSkyWidth; ++x) {
            const glm::dvec3 up = direction_of_pixel(picture, x, y);
            if (up.y <= 0)
                continue;
            // [ISO15469] Eqs. 1 to 4, but for the values at the zenith
            const double chi = std::acos(std::clamp(glm::dot(up, sun), -1.0, 1.0));
            const double gradation = 1 + a * std::exp(b / up.y);
            const double indicatrix = 1 + c * (std::exp(d * chi) - std::exp(d * kHalfPi)) +
                                      e * std::cos(chi) * std::cos(chi);
            *picture.pixel(x, y) = static_cast<float>(gradation * indicatrix);
        }
    const double scale = kPi / level_irradiance_of(picture, 1);
    for (int y = 0; y < kSkyHeight; ++y)
        for (int x = 0; x < kSkyWidth; ++x) {
            float &value = *picture.pixel(x, y);
            value = static_cast<float>(2 * y < kSkyHeight ? scale * static_cast<double>(value)
                                                          : sky.ground);
        }
    return picture;
}

double level_irradiance(const Environment &environment) {
    return environment.radiance *
           (environment.picture
                ? level_irradiance_of(*environment.picture, 1 + environment.further_groups.size())
                : kPi);
}

} // namespace tsuya::scene
