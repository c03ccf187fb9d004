#include "frame_patches.h"

#include <limits>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

std::vector<double> pixels_of(const Image &image, std::size_t channel) {
    std::vector<double> values;
    const std::size_t channels = image.channels.size();
    for (std::size_t i = channel; i < image.data.size(); i += channels)
        values.push_back(double{image.data[i]});
    return values;
}

/// The pixels behind filters of one colour, NaN elsewhere.
std::vector<double> filtered(const Image &image, const std::string &cfa, char colour) {
    std::vector<double> values = pixels_of(image, 0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t x = i % static_cast<std::size_t>(image.width),
                          y = i / static_cast<std::size_t>(image.width);
        if (cfa[2 * (y % 2) + x % 2] != colour)
            values[i] = std::numeric_limits<double>::quiet_NaN();
    }
    return values;
}

} // namespace

PatchGrid grid_of(const std::filesystem::path &file, int width, int height, int side) {
    const int smaller = std::min(width, height);
    if (smaller < side)
        throw Error({"the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels",
                     file.string(),
                     "expected at least the patch's side of " + std::to_string(side)});
    PatchGrid grid{.side = side, .across = smaller >= 3 * side ? 3 : 1};
    grid.area = {(width - grid.width()) / 2, (height - grid.width()) / 2, grid.width(),
                 grid.width()};
    return grid;
}

PatchReader::PatchReader(const RigCamera &camera) : camera_(camera) {
    if (!camera.response.empty())
        response_ = read_response_csv(camera.response);
}

FramePatches PatchReader::read(const std::filesystem::path &file, double exposure_s) {
    if (!grid_) {
        const CameraFrame header = read_frame_header(file);
        grid_ = grid_of(file, header.width, header.height, camera_.patch);
    }
    const CameraFrame frame = read_frame(file, {.area = grid_->area, .response = response_});
    FramePatches patches{.exposure_s = frame.exposure_s};
    const auto add = [&](std::string name, std::vector<double> dn) {
        patches.colours.push_back(
            {.name = std::move(name), .pixels = {.exposure_s = exposure_s, .dn = std::move(dn)}});
    };
    if (frame.cfa.empty())
        for (std::size_t c = 0; c < frame.image.channels.size(); ++c)
            add(frame.image.channels[c], pixels_of(frame.image, c));
    else
        for (const char colour : std::string("RGB"))
            add({colour}, filtered(frame.image, frame.cfa, colour));
    return patches;
}

} // namespace tsuya::lab
