#include "frame_patches.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr int kGrid = 3; // patches along a side, where they lie in the picture

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

/// One colour after the other; the filters of a sensor are taken apart.
std::vector<ColourPixels> colours_of(const CameraFrame &frame, double exposure_s) {
    std::vector<ColourPixels> colours;
    const auto add = [&](std::string name, std::vector<double> dn) {
        colours.push_back(
            {.name = std::move(name), .pixels = {.exposure_s = exposure_s, .dn = std::move(dn)}});
    };
    if (frame.cfa.empty())
        for (std::size_t c = 0; c < frame.image.channels.size(); ++c)
            add(frame.image.channels[c], pixels_of(frame.image, c));
    else
        for (const char colour : std::string("RGB"))
            add({colour}, filtered(frame.image, frame.cfa, colour));
    return colours;
}

/// The middle of the patch, pixels.
glm::dvec2 middle_of_patch(int width, int height, const RigCamera &camera, double theta_r) {
    const std::vector<PatchPlace> &places = camera.patch_at;
    if (places.empty())
        return {width / 2.0, height / 2.0};
    const auto after = std::find_if(places.begin(), places.end(), [&](const PatchPlace &place) {
        return place.theta_r_deg * kDegree >= theta_r;
    });
    const PatchPlace &b = after == places.end() ? places.back() : *after,
                     &a = after == places.begin() ? b : *(after - 1);
    const double way = b.theta_r_deg - a.theta_r_deg;
    const double t = way > 0 ? std::min((theta_r / kDegree - a.theta_r_deg) / way, 1.0) : 0;
    return {std::lerp(a.x, b.x, t), std::lerp(a.y, b.y, t)};
}

PixelArea square_about(const glm::dvec2 &middle, int side) {
    return {static_cast<int>(std::floor(middle.x - side / 2.0)),
            static_cast<int>(std::floor(middle.y - side / 2.0)), side, side};
}

/// The part of an area that lies in the picture.
PixelArea clipped(const PixelArea &area, int width, int height) {
    const int x = std::clamp(area.x, 0, width), y = std::clamp(area.y, 0, height);
    return {x, y, std::clamp(area.x + area.width, 0, width) - x,
            std::clamp(area.y + area.height, 0, height) - y};
}

/// The smallest area that holds both.
PixelArea hull_of(const PixelArea &a, const PixelArea &b) {
    const int x = std::min(a.x, b.x), y = std::min(a.y, b.y);
    return {x, y, std::max(a.x + a.width, b.x + b.width) - x,
            std::max(a.y + a.height, b.y + b.height) - y};
}

} // namespace

PatchGrid grid_of(const std::filesystem::path &file, int width, int height, const RigCamera &camera,
                  double theta_r) {
    const glm::dvec2 middle = middle_of_patch(width, height, camera, theta_r);
    for (const int across : {kGrid, 1}) {
        const PixelArea area = square_about(middle, across * camera.patch);
        if (clipped(area, width, height) == area)
            return {.area = area, .side = camera.patch, .across = across};
    }
    throw Error({"the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels, and no patch of " + std::to_string(camera.patch) + " about column " +
                     std::to_string(std::lround(middle.x)) + ", row " +
                     std::to_string(std::lround(middle.y)),
                 file.string(), "expected a picture that holds the patch"});
}

std::vector<double> part_of(const std::vector<double> &pixels, const PixelArea &from,
                            const PixelArea &part) {
    std::vector<double> inside;
    for (int y = 0; y < part.height; ++y) {
        const auto row = pixels.begin() +
                         static_cast<std::ptrdiff_t>(part.y - from.y + y) * from.width +
                         (part.x - from.x);
        inside.insert(inside.end(), row, row + part.width);
    }
    return inside;
}

PatchReader::PatchReader(const RigCamera &camera) : camera_(camera) {
    if (!camera.response.empty())
        response_ = read_response_csv(camera.response);
}

void PatchReader::take_size(const std::filesystem::path &file) {
    if (width_ > 0)
        return;
    const CameraFrame header = read_frame_header(file);
    width_ = header.width;
    height_ = header.height;
}

CameraFrame PatchReader::read_area(const std::filesystem::path &file, const PixelArea &area) const {
    CameraFrame frame = read_frame(file, {.area = area, .response = response_});
    if (frame.width != width_ || frame.height != height_)
        throw Error({"the picture has " + std::to_string(frame.width) + " x " +
                         std::to_string(frame.height) + " pixels",
                     file.string(),
                     "expected " + std::to_string(width_) + " x " + std::to_string(height_) +
                         " as the first one has"});
    return frame;
}

FramePatches PatchReader::read_parts(const std::filesystem::path &file, double planned_s,
                                     const PatchGrid &grid) const {
    const CameraFrame frame = read_area(file, grid.area);
    FramePatches patches{.grid = grid,
                         .colours = colours_of(frame, planned_s),
                         .planned_s = planned_s,
                         .exposure_s = frame.exposure_s};
    const PictureArea &monitor = camera_.monitor;
    if (monitor.width > 0)
        patches.monitor = colours_of(
            read_area(file, {monitor.x, monitor.y, monitor.width, monitor.height}), planned_s);
    return patches;
}

FramePatches PatchReader::read(const std::filesystem::path &file, double planned_s,
                               double theta_r) {
    take_size(file);
    return read_parts(file, planned_s, grid_of(file, width_, height_, camera_, theta_r));
}

FramePatches PatchReader::read_reach(const std::filesystem::path &file, double planned_s) {
    take_size(file);
    const auto place = [&](double theta_r) {
        (void)grid_of(file, width_, height_, camera_, theta_r); // there is one
        return clipped(
            square_about(middle_of_patch(width_, height_, camera_, theta_r), kGrid * camera_.patch),
            width_, height_);
    };
    PixelArea reach = place(0);
    for (const PatchPlace &at : camera_.patch_at)
        reach = hull_of(reach, place(at.theta_r_deg * kDegree));
    return read_parts(file, planned_s, {.area = reach});
}

} // namespace tsuya::lab
