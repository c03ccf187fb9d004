#include "page/packed_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rows.h"
#include "tsuya/color/difference.h"

namespace tsuya {
namespace {

// The steps that are tried, in CIELAB units at full brightness, and what directions that are left
// out may add up to, as a share of a step.
constexpr double kFinest = 0.03;
constexpr double kSteps[] = {0.5, 0.35, 0.25, 0.18, 0.125, 0.09, 0.06, kFinest};
constexpr double kSure = 1.3;
constexpr double kLeftOut = 0.25;
constexpr double kUnitsOfLevel = 116.0 / 3; // CIELAB L* for a relative change of 1, at white
constexpr std::size_t kPixelsOfBasis = 20000;
constexpr std::size_t kPixelsOfError = 4000;

std::size_t pixels_of(const SpectralImage &image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

std::uint16_t coded(double value, const CodePlane &plane) {
    constexpr double kMost = std::numeric_limits<std::uint16_t>::max();
    return static_cast<std::uint16_t>(
        std::clamp(std::round((value - plane.offset) / plane.step), 0.0, kMost));
}

double decoded(std::uint16_t code, const CodePlane &plane) {
    return plane.offset + plane.step * code;
}

/// How many directions are needed so that the others stay below `most` together.
std::size_t needed(const ShapeBasis &basis, double most) {
    double rest = 0;
    std::size_t count = basis.spread.size();
    while (count > 0) {
        rest += basis.spread[count - 1] * basis.spread[count - 1];
        if (std::sqrt(rest) > most)
            break;
        --count;
    }
    return count;
}

/// Shape values of a pixel and its level.
struct PixelValues {
    double level = 0;
    std::vector<double> shape{};
};

PixelValues values_of(const float *t, const ShapeBasis &basis, std::size_t directions) {
    const std::size_t channels = basis.mean.size();
    PixelValues values{.shape = std::vector<double>(directions, 0.0)};
    for (std::size_t k = 0; k < channels; ++k)
        values.level += static_cast<double>(t[k]) / static_cast<double>(channels);
    if (!(values.level > 0) || !std::isfinite(values.level))
        return {0, std::move(values.shape)};
    const double weight = shape_weight(values.level);
    for (std::size_t i = 0; i < directions; ++i)
        for (std::size_t k = 0; k < channels; ++k)
            values.shape[i] += weight * basis.reading[i][k] * (t[k] / values.level - basis.mean[k]);
    return values;
}

PackedGroup pack_group(const SpectralImage &image, std::size_t group, const ShapeBasis &basis,
                       double step) {
    const std::size_t pixels = pixels_of(image), count = needed(basis, kLeftOut * step);
    const auto channels = static_cast<std::size_t>(image.basis.count);
    PackedGroup packed{.mean = basis.mean};
    packed.direction.assign(basis.direction.begin(),
                            basis.direction.begin() + static_cast<std::ptrdiff_t>(count));
    packed.planes.assign(1 + count, {.step = step});
    packed.planes[0].step = step / (kUnitsOfLevel * (1 + kLevelScale));
    // The values before their offsets are known
    std::vector<std::vector<float>> shape(count, std::vector<float>(pixels));
    for (CodePlane &plane : packed.planes)
        plane.codes.resize(pixels);
    const float *const first = image.transport.data() + group * pixels * channels;
    const auto width = static_cast<std::size_t>(image.width);
    for_rows(image.height, width * channels, [&](int begin, int end) {
        for (std::size_t p = static_cast<std::size_t>(begin) * width;
             p < static_cast<std::size_t>(end) * width; ++p) {
            const PixelValues values = values_of(first + p * channels, basis, count);
            packed.planes[0].codes[p] =
                coded(std::log1p(values.level / kLevelScale), packed.planes[0]);
            for (std::size_t i = 0; i < count; ++i)
                shape[i][p] = static_cast<float>(values.shape[i]);
        }
    });
    for (std::size_t i = 0; i < count; ++i) {
        CodePlane &plane = packed.planes[1 + i];
        plane.offset =
            step * std::floor(*std::min_element(shape[i].begin(), shape[i].end()) / step);
        for (std::size_t p = 0; p < pixels; ++p)
            plane.codes[p] = coded(shape[i][p], plane);
    }
    return packed;
}

/// XYZ that the group adds under a look, from the picture less that from its codes.
class GroupColour {
  public:
    GroupColour(const SpectralImage &image, std::size_t group, const PackedGroup &packed)
        : image_(image), group_(group), packed_(packed) {}

    /// Channels of a pixel as the codes have them.
    std::vector<double> channels(std::size_t pixel) const {
        const double level =
            kLevelScale * std::expm1(decoded(packed_.planes[0].codes[pixel], packed_.planes[0]));
        const double weight = level > 0 ? level / shape_weight(level) : 0;
        std::vector<double> t;
        for (const double m : packed_.mean)
            t.push_back(level * m);
        for (std::size_t i = 0; i < packed_.direction.size(); ++i) {
            const CodePlane &plane = packed_.planes[1 + i];
            const double value = weight * decoded(plane.codes[pixel], plane);
            for (std::size_t k = 0; k < t.size(); ++k)
                t[k] += value * packed_.direction[i][k];
        }
        return t;
    }
    const float *transport(std::size_t pixel) const {
        return image_.transport.data() +
               (group_ * pixels_of(image_) + pixel) * static_cast<std::size_t>(image_.basis.count);
    }

  private:
    const SpectralImage &image_;
    std::size_t group_;
    const PackedGroup &packed_;
};

PackingError error_of(const SpectralImage &image, const std::vector<PackedGroup> &packed,
                      const std::vector<std::size_t> &pixels,
                      const std::vector<JudgedLook> &looks) {
    if (pixels.empty())
        return {};
    const auto channels = static_cast<std::size_t>(image.basis.count);
    std::vector<double> differences;
    for (const std::size_t pixel : pixels) {
        std::vector<double> exact(channels, 0.0), coarse(channels, 0.0);
        for (std::size_t g = 0; g < packed.size(); ++g) {
            const GroupColour group(image, g, packed[g]);
            const std::vector<double> t = group.channels(pixel);
            for (std::size_t k = 0; k < channels; ++k) {
                exact[k] += group.transport(pixel)[k];
                coarse[k] += t[k];
            }
        }
        for (const JudgedLook &look : looks) {
            glm::dvec3 a(0.0), b(0.0);
            for (std::size_t k = 0; k < channels; ++k) {
                a += exact[k] * look.channels[k];
                b += coarse[k] * look.channels[k];
            }
            differences.push_back(ciede2000(lab_of(a, look.white), lab_of(b, look.white)));
        }
    }
    PackingError error;
    for (const double d : differences)
        error.mean += d / static_cast<double>(differences.size());
    const auto rank = static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(differences.size()));
    std::nth_element(differences.begin(), differences.begin() + rank, differences.end());
    error.p99 = differences[static_cast<std::size_t>(rank)];
    return error;
}

} // namespace

PackedPicture pack_picture(const SpectralImage &image, const PackingError &most) {
    const std::vector<JudgedLook> looks = judged_looks(image);
    const std::vector<std::size_t> of_basis = judged_pixels(image, kPixelsOfBasis),
                                   of_error = judged_pixels(image, kPixelsOfError);
    std::vector<ShapeBasis> bases;
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        bases.push_back(make_shape_basis(image, g, of_basis, looks));
    PackedPicture packed;
    double tried = 0;
    for (const double step : kSteps) {
        // Errors grow as the step: what is sure to be too coarse is not tried.
        if (tried > 0 && step > kFinest && packed.error.mean * step / tried > kSure * most.mean)
            continue;
        tried = step;
        packed.groups.clear();
        for (std::size_t g = 0; g < image.groups.size(); ++g)
            packed.groups.push_back(pack_group(image, g, bases[g], step));
        packed.error = error_of(image, packed.groups, of_error, looks);
        if (packed.error.mean <= most.mean && packed.error.p99 <= most.p99)
            break;
    }
    return packed;
}

} // namespace tsuya
