#include "tsuya/color/camera_frame.h"

#include <algorithm>
#include <cmath>

#include "channels.h"
#include "pictures.h"
#include "tiff_bytes.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

constexpr float kMaxDn = 65535;

std::string text_of(const PixelArea &area) {
    return std::to_string(area.width) + " x " + std::to_string(area.height) + " pixels at column " +
           std::to_string(area.x) + ", row " + std::to_string(area.y);
}

/// The colours of the filters as seen from another pixel.
std::string moved(const std::string &cfa, int x, int y) {
    if (cfa.size() != 4)
        return cfa;
    std::string colours(4, ' ');
    for (int i = 0; i < 4; ++i)
        colours[static_cast<std::size_t>(i)] =
            cfa[static_cast<std::size_t>(2 * ((y + i / 2) % 2) + (x + i % 2) % 2)];
    return colours;
}

void linearise(Image &image, const ResponseCurve &response) {
    std::transform(image.data.begin(), image.data.end(), image.data.begin(),
                   [&](float dn) { return static_cast<float>(response.linear_dn(double{dn})); });
}

} // namespace

double ResponseCurve::linear_dn(double encoded_dn) const {
    const auto above = std::upper_bound(dn.begin(), dn.end(), encoded_dn);
    const double scale = dn.back() / exposure_s.back();
    if (above == dn.begin())
        return scale * exposure_s.front();
    if (above == dn.end())
        return dn.back();
    const auto i = static_cast<std::size_t>(above - dn.begin());
    const double t = (encoded_dn - dn[i - 1]) / (dn[i] - dn[i - 1]);
    return scale * std::lerp(exposure_s[i - 1], exposure_s[i], t);
}

CameraFrame read_frame_header(const std::filesystem::path &path) {
    return picture_reader().open_frame(path)->description();
}

CameraFrame read_frame(const std::filesystem::path &path, const FrameSettings &settings) {
    const std::unique_ptr<FrameFile> input = picture_reader().open_frame(path);
    if (!settings.response && !input->not_linear().empty())
        throw Error({"the picture is no measurement: " + input->not_linear(), path.string(),
                     "expected RAW, or a linear picture of 16 bits, or a camera with a measured "
                     "response curve"});
    CameraFrame frame = input->description();
    frame.area = settings.area.value_or(PixelArea{0, 0, frame.width, frame.height});
    const PixelArea &area = frame.area;
    if (area.width < 1 || area.height < 1 || area.x < 0 || area.y < 0 ||
        area.x > frame.width - area.width || area.y > frame.height - area.height)
        throw Error({"the picture has no " + text_of(area), path.string(),
                     "expected an area within its " + std::to_string(frame.width) + " x " +
                         std::to_string(frame.height) + " pixels"});
    frame.image = input->read(area);
    frame.cfa = moved(frame.cfa, area.x, area.y);
    if (settings.response)
        linearise(frame.image, *settings.response);
    return frame;
}

void write_frame(const std::filesystem::path &path, const CameraFrame &frame) {
    check_image(frame.image, path.string());
    const auto wrong = std::find_if_not(frame.image.data.begin(), frame.image.data.end(),
                                        [](float dn) { return dn >= 0 && dn <= kMaxDn; });
    if (wrong != frame.image.data.end())
        throw Error({"a pixel has the number " + std::to_string(*wrong), path.string(),
                     "expected 0 to 65535"});
    const bool filters = !frame.cfa.empty();
    const bool four =
        frame.cfa.size() == 4 && frame.cfa.find_first_not_of("RGB") == std::string::npos;
    if (filters && (!four || frame.image.channels.size() != 1))
        throw Error({"the filters of the sensor are '" + frame.cfa + "'", path.string(),
                     "expected four of R, G, B, over one channel"});
    const std::string extension = filters ? ".dng" : ".tif";
    if (path.extension() != extension)
        throw Error(
            {"the file does not end in " + extension, path.string(), "expected NAME" + extension});
    write_file(path, tiff_bytes(frame));
}

} // namespace tsuya
