#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "depth_attributes.h"
#include "pictures.h"
#include "spectral_check.h"
#include "spectral_layout.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/shown_picture.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using namespace layout;

constexpr float kMostHalf = 65504;

/// What a half holds: all that is finite and not above its greatest number; and the greatest value
/// of each light group so far above its smallest step that dark pixels are still told apart.
bool half_can_hold(const SpectralImage &image) {
    constexpr float kLeastPeak = 1.0f / 1024; // 16 times the least number of all digits
    const std::size_t values = image.transport.size() / image.groups.size();
    for (std::size_t g = 0; g < image.groups.size(); ++g) {
        float peak = 0;
        for (std::size_t i = g * values; i < (g + 1) * values; ++i)
            peak = std::max(peak, std::abs(image.transport[i]));
        if (!(peak <= kMostHalf) || (peak > 0 && peak < kLeastPeak))
            return false;
    }
    return true;
}

/// To the nearest half, ties to the even one. \param value of which half_can_hold
float nearest_half(float value) {
    constexpr float kLeastNormal = 6.103515625e-5f, kSteps = 16777216; // 2^-14, 2^24
    if (std::abs(value) < kLeastNormal)
        return std::nearbyint(value * kSteps) / kSteps;
    constexpr std::uint32_t kDropped = (1u << 13) - 1; // bits of a float that a half has not
    auto bits = std::bit_cast<std::uint32_t>(value);
    bits += kDropped / 2 + ((bits >> 13) & 1u);
    return std::bit_cast<float>(bits & ~kDropped);
}

/// What lights the picture that every viewer shows: `lamps`, or where there are none, D65 or E.
/// Called as `tsuya:rgb.lamp` says it.
Lighting viewer_lighting(const SpectralImage &image, std::vector<NamedLamp> lamps) {
    if (lamps.empty()) {
        const std::string name = image.emissive ? "E" : "D65";
        lamps = {{.name = name, .spectrum = lamp(name)}};
    }
    Lighting lighting;
    for (std::size_t g = 0; g < lamps.size(); ++g)
        lighting.name +=
            (g > 0 ? ", " : "") +
            (lamps.size() > 1 && g < image.groups.size() ? image.groups[g] + "=" : "") +
            lamps[g].name;
    lighting.lamps = std::move(lamps);
    return lighting;
}

/// Where the pixels of a picture that are written lie.
struct Window {
    int x0, y0, x1, y1;

    explicit Window(const SpectralImage &image) {
        const auto window =
            image.data_window.value_or(std::array<int, 4>{0, 0, image.width, image.height});
        x0 = window[0], y0 = window[1], x1 = window[2], y1 = window[3];
    }
};

OutputPicture part_of(const SpectralImage &image, std::string name, SampleType samples) {
    const Window window(image);
    OutputPicture part{.part = std::move(name),
                       .width = window.x1 - window.x0,
                       .height = window.y1 - window.y0,
                       .samples = samples};
    if (image.data_window)
        part.place = {window.x0, window.y0, image.width, image.height};
    return part;
}

std::map<std::string, std::string> description(const SpectralImage &image,
                                               const std::string &lamp_name) {
    std::map<std::string, std::string> attributes{{kSchemaKey, kSchema},
                                                  {"software", "tsuya " TSUYA_VERSION},
                                                  {"tsuya:rgb.lamp", lamp_name},
                                                  {"tsuya:rgb.observer", "CIE 1931 2 degree"},
                                                  {"tsuya:rgb.colorspace", "linear Rec. 709"}};
    if (image.depths)
        write_depths(*image.depths, attributes);
    else
        attributes[kBasisKey] = basis_text(image.basis);
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        attributes[group_key(g)] = image.groups[g];
    if (image.alpha)
        attributes[kAlphaKey] = kAlphaChannel;
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        attributes[aov_key(i)] = image.aov_names[i];
        for (std::size_t c = 0; c < image.aovs[i].channels.size(); ++c)
            attributes[aov_channel_key(i, c)] = image.aovs[i].channels[c];
    }
    for (const auto &[key, value] : image.metadata)
        attributes[is_cryptomatte_key(key) ? key : kMetaPrefix + key] = value;
    return attributes;
}

/// \param picture the image under the lighting, as linear_picture makes it
OutputPicture rgb_part(const SpectralImage &image, const Image &picture, const Lighting &lighting,
                       SampleType samples) {
    OutputPicture part = part_of(image, kPicturePart, SampleType::half);
    part.channels = picture.channels;
    if (samples == SampleType::float32)
        part.exact_from = 3; // a colour is to be looked at, alpha to be reckoned with
    part.primaries = kRec709;
    part.neutral = chromaticity(white_of(lighting.lamps[0].spectrum));
    part.attributes = description(image, lighting.name);
    part.fill_row = [&](int row, float *out) {
        const Window window(image);
        for (int x = window.x0; x < window.x1; ++x) {
            const float *const pixel = picture.pixel(x, window.y0 + row);
            for (int c = 0; c < 3; ++c)
                *out++ = std::clamp(pixel[c], -kMostHalf, kMostHalf);
            if (image.alpha)
                *out++ = pixel[3];
        }
    };
    return part;
}

OutputPicture group_part(const SpectralImage &image, std::size_t group, SampleType samples) {
    OutputPicture part = part_of(image, part_of_group(image.groups[group]), samples);
    part.channels = channel_names(image.basis, image.depths.has_value(), image.emissive);
    if (!image.depths)
        part.attributes[kVersionKey] = kVersion;
    if (const auto units = image.metadata.find(kUnitsKey);
        image.emissive && units != image.metadata.end())
        part.attributes[kUnitsKey] = units->second;
    part.fill_row = [&image, group](int row, float *out) {
        const Window window(image);
        std::copy(image.pixel(group, window.x0, window.y0 + row),
                  image.pixel(group, window.x1, window.y0 + row), out);
    };
    return part;
}

OutputPicture aov_part(const SpectralImage &image, std::size_t i) {
    OutputPicture part = part_of(image, part_of_aov(image.aov_names[i]), SampleType::float32);
    const Image &aov = image.aovs[i];
    part.channels = aov.channels;
    part.fill_row = [&image, &aov](int row, float *out) {
        const Window window(image);
        std::copy(aov.pixel(window.x0, window.y0 + row), aov.pixel(window.x1, window.y0 + row),
                  out);
    };
    return part;
}

} // namespace

void round_as_written(SpectralImage &image, SampleType samples) {
    if (samples != SampleType::half || image.groups.empty() || !half_can_hold(image))
        return;
    std::transform(image.transport.begin(), image.transport.end(), image.transport.begin(),
                   nearest_half);
    if (image.alpha)
        std::transform(image.alpha->data.begin(), image.alpha->data.end(),
                       image.alpha->data.begin(), nearest_half);
}

void write_spectral_exr(const std::filesystem::path &path, const SpectralImage &image,
                        const SpectralExrOptions &options) {
    check_spectral_image(image, path.string());
    const SampleType samples = half_can_hold(image) ? options.samples : SampleType::float32;
    const Lighting lighting = viewer_lighting(image, options.lamps);
    const Image picture = linear_picture(image, lighting);
    std::vector<OutputPicture> parts{rgb_part(image, picture, lighting, samples)};
    for (std::size_t g = 0; g < image.groups.size(); ++g)
        parts.push_back(group_part(image, g, samples));
    for (std::size_t i = 0; i < image.aovs.size(); ++i)
        parts.push_back(aov_part(image, i));
    picture_writer().write_exr(path, parts);
}

} // namespace tsuya
