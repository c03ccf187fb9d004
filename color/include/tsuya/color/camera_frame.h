#pragma once
/// \file
/// Pictures of a camera as measurements: numbers that are proportional to light.
///
///     const CameraFrame frame = read_frame("0012.tif", {.area = PixelArea{1120, 836, 32, 32}});
///     const double dn = frame.image.pixel(0, 0)[0]; // the camera's number, black included

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/image.h"

namespace tsuya {

/// A rectangle of pixels; row 0 is the top row.
struct PixelArea {
    int x = 0, y = 0;
    int width = 0, height = 0;

    bool operator==(const PixelArea &) const = default;
};

/// How the numbers of an encoded picture grow with light: a surface that does not change, seen
/// under exposures of different length. Both ascend.
struct ResponseCurve {
    std::vector<double> dn{};         ///< what the camera gave
    std::vector<double> exposure_s{}; ///< for this exposure time

    /// The number that a linear camera would give: in proportion to the exposure time, the same at
    /// the last point of the curve. Linear between the points, constant beyond them.
    double linear_dn(double encoded_dn) const;
};

/// Reads lines `dn,exposure_s`, with a header and comment lines that begin with `#`. Throws Error
/// at file:line:column, also for less than two lines and for values that do not ascend.
ResponseCurve read_response_csv(const std::filesystem::path &path);

/// What a camera took. Numbers are the camera's own (DN); black is not removed.
struct CameraFrame {
    Image image{};             ///< the area, as the sensor has it where the file is RAW
    PixelArea area{};          ///< of the whole picture
    int width = 0, height = 0; ///< of the whole picture
    std::string cfa{}; ///< colours of the 2 x 2 filters at the area's corner, such as RGGB; empty
                       ///< if there are none, or OpenImageIO does not report it
    std::optional<double> exposure_s{};
    std::optional<double> f_number{};
    std::optional<double> iso{}; ///< OpenImageIO finds it in RAW files alone
    std::string time{};          ///< of the exposure, as the camera wrote it; may be empty
};

/// What of a frame is read, and how its values become proportional to light.
struct FrameSettings {
    std::optional<PixelArea> area{};         ///< empty: the whole picture
    std::optional<ResponseCurve> response{}; ///< of a camera whose pictures are encoded
};

/// What the picture says about itself, without `image` and `area`. Throws Error at the path.
CameraFrame read_frame_header(const std::filesystem::path &path);

/// Reads a RAW file without any of the usual processing, a TIFF, PNM or FITS of 16 bits or more, a
/// float TIFF or an EXR. Of files in strips, only those of the area are read. Throws Error at the
/// path: no such file, cut short, an area outside of the picture, and a picture whose numbers are
/// not proportional to light (8 bits, JPEG, tagged sRGB), unless `response` is given.
CameraFrame read_frame(const std::filesystem::path &path, const FrameSettings &settings = {});

/// Writes the numbers, rounded to 16 bits and uncompressed, with exposure, f-number, ISO and time:
/// as NAME.tif, or with `cfa` as NAME.dng. `area`, `width` and `height` are not looked at. Throws
/// Error at the path, also for a number outside 0 to 65535 and filters that are not four of R, G,
/// B.
void write_frame(const std::filesystem::path &path, const CameraFrame &frame);

} // namespace tsuya
