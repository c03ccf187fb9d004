#include <algorithm>
#include <cmath>
#include <vector>

#include "pictures/oiio_input.h"
#include "pictures/reader_parts.h"

namespace tsuya {
namespace {

/// The sensor's own numbers: no colour space, no demosaicing, no white balance, nothing stretched.
OIIO::ImageSpec raw_numbers() {
    OIIO::ImageSpec config;
    config.attribute("raw:ColorSpace", "raw");
    config.attribute("raw:Demosaic", "none");
    config.attribute("raw:use_camera_wb", 0);
    config.attribute("raw:adjust_maximum_thr", 0.0f);
    return config;
}

std::optional<double> number(const OIIO::ImageSpec &spec, const char *name) {
    const float value = spec.get_float_attribute(name, -1);
    return value > 0 ? std::optional(static_cast<double>(value)) : std::nullopt;
}

/// The colours of 2 x 2 filters; empty where they are not told. libraw counts the second green of
/// RGGB apart, and OpenImageIO 2.4 takes that for the GMCY of one camera of 2000; of the three
/// other orders it says "unknown".
std::string filters_of(const OIIO::ImageSpec &spec) {
    const std::string pattern = spec.get_string_attribute("raw:FilterPattern");
    if (pattern == "GMCY")
        return "RGGB";
    const bool bayer = pattern.size() == 4 && pattern.find_first_not_of("RGB") == std::string::npos;
    return bayer ? pattern : "";
}

/// What OpenImageIO makes 1; 0 for floats, which stay.
float largest_number(const OIIO::TypeDesc &type) {
    if (type.is_floating_point())
        return 0;
    return type.basetype == OIIO::TypeDesc::UINT8 ? 255.0f : 65535.0f;
}

/// A colour profile is kept as bytes; its name stands there in 8 or 16 bits a letter.
bool profile_names_srgb(const OIIO::ImageSpec &spec) {
    const OIIO::ParamValue *const profile = spec.find_attribute("ICCProfile");
    if (!profile)
        return false;
    std::string letters(static_cast<const char *>(profile->data()),
                        static_cast<std::size_t>(profile->datasize()));
    std::erase(letters, '\0');
    return letters.find("sRGB") != std::string::npos;
}

class OiioFrame final : public FrameFile {
  public:
    explicit OiioFrame(const std::filesystem::path &path) : path_(path) {
        const OIIO::ImageSpec config = raw_numbers();
        file_ = open_picture(path_, &config);
    }
    std::string not_linear() const override;
    CameraFrame description() const override;
    Image read(const PixelArea &area) override;

  private:
    std::filesystem::path path_;
    std::unique_ptr<OIIO::ImageInput> file_{};
};

std::string OiioFrame::not_linear() const {
    const OIIO::ImageSpec &spec = file_->spec();
    const std::string format = file_->format_name();
    if (spec.format.basetype == OIIO::TypeDesc::UINT8)
        return "it has 8 bits, which are encoded";
    if (format == "png")
        return spec.get_string_attribute("oiio:ColorSpace") == "linear" ? "" : "a PNG is encoded";
    // OpenImageIO calls every TIFF sRGB: what counts is what the file says itself.
    if (format == "tiff" &&
        (spec.get_int_attribute("Exif:ColorSpace", 0) == 1 || profile_names_srgb(spec)))
        return "it is tagged sRGB";
    const std::vector<std::string> linear{"raw", "tiff", "openexr", "pnm", "fits"};
    if (std::find(linear.begin(), linear.end(), format) == linear.end())
        return "the format " + format + " is for encoded pictures";
    return "";
}

CameraFrame OiioFrame::description() const {
    const OIIO::ImageSpec &spec = file_->spec();
    CameraFrame frame{.width = spec.width, .height = spec.height};
    frame.cfa = filters_of(spec);
    frame.exposure_s = number(spec, "ExposureTime");
    frame.f_number = number(spec, "FNumber");
    frame.iso = number(spec, "Exif:PhotographicSensitivity");
    if (!frame.iso)
        frame.iso = number(spec, "Exif:ISOSpeedRatings");
    frame.time = spec.get_string_attribute("Exif:DateTimeOriginal");
    if (frame.time.empty())
        frame.time = spec.get_string_attribute("DateTime");
    return frame;
}

Image OiioFrame::read(const PixelArea &area) {
    const OIIO::ImageSpec &spec = file_->spec();
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    const std::size_t row = static_cast<std::size_t>(spec.width) * channels;
    need_memory_for(path_, spec, area.height, 2 * sizeof(float)); // the rows and the area
    std::vector<float> rows(row * static_cast<std::size_t>(area.height));
    if (!file_->read_scanlines(0, 0, area.y, area.y + area.height, 0, 0, spec.nchannels,
                               OIIO::TypeDesc::FLOAT, rows.data()))
        fail_reading(path_, file_->geterror());
    const float largest = largest_number(spec.format);
    Image image = Image::make(area.width, area.height, spec.channelnames);
    for (std::size_t y = 0; y < static_cast<std::size_t>(area.height); ++y) {
        const float *const first = &rows[y * row + static_cast<std::size_t>(area.x) * channels];
        std::transform(first, first + static_cast<std::size_t>(area.width) * channels,
                       image.pixel(0, static_cast<int>(y)), [&](float value) {
                           return largest > 0 ? std::round(value * largest) : value;
                       });
    }
    return image;
}

} // namespace

std::unique_ptr<FrameFile> open_frame_file(const std::filesystem::path &path) {
    return std::make_unique<OiioFrame>(path);
}

} // namespace tsuya
