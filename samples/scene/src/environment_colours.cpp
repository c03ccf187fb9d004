#include "tsuya/scene/environment_colours.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <glm/glm.hpp>

#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

/// Where the lamps meet, and how far they reach into each other, in nm.
constexpr double kBlueEnds = 490, kRedBegins = 583, kBlend = 12;

/// Shares of D65 in the three lamps.
std::array<Spectrum, kEnvironmentLamps> thirds() {
    std::array<Spectrum, kEnvironmentLamps> parts{Spectrum{{}, {}}, Spectrum{{}, {}},
                                                  Spectrum{{}, {}}};
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        const double red = 1 / (1 + std::exp((kRedBegins - nm) / kBlend));
        const double blue = 1 / (1 + std::exp((nm - kBlueEnds) / kBlend));
        const double share[] = {red, 1 - red - blue, blue};
        for (std::size_t k = 0; k < kEnvironmentLamps; ++k) {
            parts[k].wavelength_nm.push_back(nm);
            parts[k].value.push_back(share[k]);
        }
    }
    return parts;
}

/// The best mixture of some of the lamps; those of others are 0.
class Mixture {
  public:
    explicit Mixture(const std::array<glm::dvec3, kEnvironmentLamps> &xyz) : xyz_(xyz) {}

    /// The best of all mixtures without a lamp below 0.
    glm::dvec3 of(const glm::dvec3 &target) const {
        glm::dvec3 best(0);
        double least = std::numeric_limits<double>::infinity();
        for (unsigned lamps = 7; lamps > 0; --lamps) {
            const glm::dvec3 amounts = of_these(lamps, target);
            const double apart = glm::distance(mixed(amounts), target);
            if (std::min({amounts.x, amounts.y, amounts.z}) >= 0 && apart < least) {
                best = amounts;
                least = apart;
            }
            if (lamps == 7 && least < std::numeric_limits<double>::infinity())
                break;
        }
        return best;
    }
    glm::dvec3 mixed(const glm::dvec3 &amounts) const {
        return amounts.x * xyz_[0] + amounts.y * xyz_[1] + amounts.z * xyz_[2];
    }

  private:
    /// Normal equations, with ones in the place of lamps that are left out.
    glm::dvec3 of_these(unsigned lamps, const glm::dvec3 &target) const {
        glm::dmat3 products(1);
        glm::dvec3 right(0);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                if ((lamps >> i & 1u) && (lamps >> j & 1u)) {
                    products[j][i] = glm::dot(xyz_[std::size_t(i)], xyz_[std::size_t(j)]);
                    right[i] = glm::dot(xyz_[std::size_t(i)], target);
                }
        return glm::inverse(products) * right;
    }

    std::array<glm::dvec3, kEnvironmentLamps> xyz_;
};

std::array<std::size_t, 3> rgb_channels(const Image &picture) {
    std::array<std::size_t, 3> channels{};
    for (std::size_t c = 0; c < 3; ++c) {
        const std::string name(1, "RGB"[c]);
        const auto found = std::find(picture.channels.begin(), picture.channels.end(), name);
        if (found == picture.channels.end())
            throw Error({"the picture has no channel " + name, "picture",
                         "expected a picture with R, G and B"});
        channels[c] = static_cast<std::size_t>(found - picture.channels.begin());
    }
    return channels;
}

} // namespace

std::array<Spectrum, kEnvironmentLamps> environment_lamps() {
    const Spectrum daylight = lamp("D65");
    std::array<Spectrum, kEnvironmentLamps> lamps = thirds();
    for (Spectrum &part : lamps)
        for (std::size_t i = 0; i < part.value.size(); ++i)
            part.value[i] *= daylight.at(part.wavelength_nm[i]);
    return lamps;
}

EnvironmentColours environment_colours(const Image &rgb) {
    const std::array<std::size_t, 3> channels = rgb_channels(rgb);
    const Spectrum daylight = lamp("D65");
    const std::array<Spectrum, kEnvironmentLamps> parts = thirds();
    std::array<glm::dvec3, kEnvironmentLamps> xyz{};
    for (std::size_t k = 0; k < kEnvironmentLamps; ++k)
        xyz[k] = xyz_of(daylight, parts[k]);
    const Mixture mixture(xyz);
    // The picture's white is that of the lamps together: a grey pixel is one of D65 itself
    const glm::dmat3 to_xyz = xyz_from_srgb();
    const glm::dvec3 whiter = mixture.mixed(glm::dvec3(1)) / (to_xyz * glm::dvec3(1));

    EnvironmentColours result{.picture = Image::make(rgb.width, rgb.height, {"R", "G", "B"})};
    double apart = 0, all = 0;
    for (int y = 0; y < rgb.height; ++y) {
        const double angle = std::sin(kPi * (y + 0.5) / rgb.height);
        for (int x = 0; x < rgb.width; ++x) {
            const float *const pixel = rgb.pixel(x, y);
            const glm::dvec3 colour(pixel[channels[0]], pixel[channels[1]], pixel[channels[2]]);
            const glm::dvec3 target = whiter * (to_xyz * colour);
            const glm::dvec3 amounts = mixture.of(target);
            const glm::dvec3 rest = mixture.mixed(amounts) - target;
            apart += angle * glm::dot(rest, rest);
            all += angle * glm::dot(target, target);
            // Relighting gives each lamp Y = 1
            for (std::size_t k = 0; k < kEnvironmentLamps; ++k)
                result.picture.pixel(x, y)[k] =
                    static_cast<float>(amounts[static_cast<int>(k)] * xyz[k].y);
        }
    }
    result.error = all > 0 ? std::sqrt(apart / all) : 0;
    return result;
}

} // namespace tsuya::scene
