#include "tsuya/color/difference_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include "lab_picture.h"
#include "tsuya/color/difference.h"

namespace tsuya {
namespace {

/// Ours: lightness rises all the way, so that it reads without colour too.
glm::vec3 color_of(double difference) {
    static constexpr std::array<glm::vec3, 6> kColors{
        glm::vec3{0.06f, 0.05f, 0.22f}, {0.30f, 0.08f, 0.48f}, {0.65f, 0.15f, 0.43f},
        {0.91f, 0.36f, 0.22f},          {0.98f, 0.67f, 0.20f}, {0.99f, 0.97f, 0.72f}};
    const double place = std::clamp(difference / kBrightestDifference, 0.0, 1.0) *
                         static_cast<double>(kColors.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(place), kColors.size() - 2);
    return glm::mix(kColors[below], kColors[below + 1],
                    static_cast<float>(place - static_cast<double>(below)));
}

void set(float *pixel, const glm::vec3 &color) { std::copy_n(&color.x, 3, pixel); }

constexpr glm::vec3 kNothing{0.5f, 0.5f, 0.5f};

} // namespace

Image difference_map(const SpectralImage &transport, const Lighting &first, const Lighting &second,
                     const CompareOptions &options) {
    std::vector<char> counts = garment_pixels(transport);
    const std::vector<glm::vec3> a = lab_picture(transport, first, options, counts),
                                 b = lab_picture(transport, second, options, counts);
    Image map = Image::make(transport.width, transport.height, {"CIEDE2000"});
    for (std::size_t p = 0; p < counts.size(); ++p)
        map.data[p] = counts[p] ? static_cast<float>(ciede2000(glm::dvec3(a[p]), glm::dvec3(b[p])))
                                : std::numeric_limits<float>::quiet_NaN();
    return map;
}

Image picture_of_differences(const Image &map) {
    Image picture = Image::make(map.width, map.height, {"R", "G", "B"});
    for (std::size_t p = 0; p < map.data.size(); ++p)
        set(picture.data.data() + 3 * p,
            std::isfinite(map.data[p]) ? color_of(map.data[p]) : kNothing);
    return picture;
}

SheetPicture difference_legend(int width, int height) {
    constexpr double kTop = 0.08, kBottom = 0.92; // of the bar
    SheetPicture legend{.image = Image::make(width, height, {"R", "G", "B"})};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double share = ((y + 0.5) / height - kTop) / (kBottom - kTop),
                         across = (x + 0.5) / width;
            const bool bar = share >= 0 && share <= 1 && across > 0.12 && across < 0.35;
            set(legend.image.pixel(x, y),
                bar ? color_of((1 - share) * kBrightestDifference) : glm::vec3(0.97f));
        }
    for (const double difference : {0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0})
        legend.marks.push_back({0.42,
                                kBottom - (kBottom - kTop) * difference / kBrightestDifference,
                                std::to_string(static_cast<int>(difference)) +
                                    (difference == kBrightestDifference ? " or more" : "")});
    return legend;
}

} // namespace tsuya
