#include "tsuya/color/image_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "channels.h"
#include "icc_profile.h"
#include "picture_errors.h"
#include "pictures.h"
#include "rows.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// Codes of 8 or 16 bits; NaN is looked for before.
template <class Sample> std::vector<Sample> quantize(const Image &image) {
    constexpr float kMost = sizeof(Sample) == 1 ? 255.0f : 65535.0f;
    std::vector<Sample> samples(image.data.size());
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    for_rows(image.height, row, [&](int first, int end) {
        for (std::size_t i = static_cast<std::size_t>(first) * row;
             i < static_cast<std::size_t>(end) * row; ++i)
            samples[i] = static_cast<Sample>(std::clamp(image.data[i], 0.0f, 1.0f) * kMost + 0.5f);
    });
    return samples;
}

enum class Format { png, tiff, jpeg };

/// Endings of file names.
constexpr std::array<std::pair<std::string_view, Format>, 5> kEndings{{{".png", Format::png},
                                                                       {".tif", Format::tiff},
                                                                       {".tiff", Format::tiff},
                                                                       {".jpg", Format::jpeg},
                                                                       {".jpeg", Format::jpeg}}};

/// Throws Error for an ending of none.
Format format_of(const std::filesystem::path &path) {
    for (const auto &[ending, format] : kEndings)
        if (path.extension() == ending)
            return format;
    throw Error({"no picture has this ending", path.string(), "expected .png, .tif or .jpg"});
}

/// What a file says of the display. Primaries 9, curve 16 or 18, RGB, all codes. [Png3]
CodedFile coded_file(const PictureFileOptions &options) {
    CodedFile file{.bits = options.bits, .srgb = options.display == "sRGB"};
    if (options.display.starts_with("Rec.2100"))
        file.cicp = {9, static_cast<std::uint8_t>(options.display == "Rec.2100-PQ" ? 16 : 18), 0,
                     1};
    else if (!file.srgb && !options.display.empty())
        file.icc = icc_profile(options.display);
    return file;
}

void check_display_image(const Image &image, const std::string &where) {
    check_image(image, where);
    const std::size_t channels = image.channels.size();
    if (channels != 1 && channels != 3 && channels != 4)
        throw Error({"the picture has " + detail::counted(channels, "channel"), where,
                     "expected 1 (grey), 3 (RGB) or 4 (RGBA)"});
    const auto nan =
        std::find_if(image.data.begin(), image.data.end(), [](float v) { return std::isnan(v); });
    if (nan == image.data.end())
        return;
    const auto pixel = static_cast<std::size_t>(nan - image.data.begin()) / channels;
    const auto width = static_cast<std::size_t>(image.width);
    throw Error({"the pixel at column " + std::to_string(pixel % width) + ", row " +
                     std::to_string(pixel / width) + " is not a number",
                 where, "expected finite values"});
}

} // namespace

void check_pictures() { picture_writer(); }

std::vector<std::string> picture_file_endings() {
    std::vector<std::string> endings;
    for (const auto &[ending, format] : kEndings)
        endings.emplace_back(ending);
    return endings;
}

void check_picture_file(const std::filesystem::path &path, const PictureFileOptions &options,
                        bool alpha) {
    const Format format = format_of(path);
    const std::string where = path.string();
    const std::string name = format == Format::png ? "a PNG" : "such a file";
    if (options.bits != 8 && !(options.bits == 16 && format != Format::jpeg))
        throw Error({name + " has no samples of " + std::to_string(options.bits) + " bits", where,
                     format == Format::jpeg ? "expected 8, or a PNG or TIFF" : "expected 8 or 16"});
    if (alpha && format == Format::jpeg)
        throw Error({"a JPEG has no alpha", where, "expected a PNG or TIFF"});
    if (options.display.starts_with("Rec.2100") && format != Format::png)
        throw Error(
            {"such a file cannot say that it is for " + options.display, where, "expected a PNG"});
}

void write_picture(const std::filesystem::path &path, const Image &image,
                   const PictureFileOptions &options) {
    check_display_image(image, path.string());
    check_picture_file(path, options, image.channels.size() == 4);
    const CodedFile file = coded_file(options);
    const auto write = [&](const void *samples) {
        if (format_of(path) == Format::png)
            picture_writer().write_png(path, image, file, samples);
        else
            picture_reader().write_tiff_or_jpeg(path, image, file, samples);
    };
    if (options.bits == 8)
        write(quantize<std::uint8_t>(image).data());
    else
        write(quantize<std::uint16_t>(image).data());
}

void write_png(const std::filesystem::path &path, const Image &image, int bits) {
    check_extension(path, ".png");
    write_picture(path, image, {.bits = bits});
}

Image read_image(const std::filesystem::path &path) { return picture_reader().read(path).image; }

void write_exr(const std::filesystem::path &path, const Image &image, const ExrOptions &options) {
    check_image(image, path.string());
    OutputPicture picture{.width = image.width,
                          .height = image.height,
                          .channels = image.channels,
                          .samples = options.samples,
                          .primaries = options.primaries};
    for (const auto &[key, value] : options.metadata)
        picture.attributes["tsuya:meta:" + key] = value;
    if (options.primaries)
        picture.neutral = options.primaries->white;
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    picture.fill_row = [&](int y, float *out) { std::copy_n(image.pixel(0, y), row, out); };
    picture_writer().write_exr(path, {&picture, 1});
}

} // namespace tsuya
