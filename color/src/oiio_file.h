#pragma once
/// \file
/// Whole pictures through OpenImageIO, with its errors translated; shared by the readers and
/// writers of picture files.

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tsuya/color/image_file.h"

namespace tsuya {

/// A picture to write, row by row.
struct OutputPicture {
    int width = 0;
    int height = 0;
    std::vector<std::string> channels{};
    SampleType samples = SampleType::float32;
    std::map<std::string, std::string> attributes{};
    /// Fills one row: width x channels floats, interleaved.
    std::function<void(int y, float *row)> fill_row{};
};

/// Throws Error at `path`.
void write_exr_picture(const std::filesystem::path &path, const OutputPicture &picture);

/// A picture as it was read, with its string attributes.
struct InputPicture {
    std::string format{}; ///< OpenImageIO's name of the file format, e.g. openexr
    Image image{};
    std::map<std::string, std::string> attributes{};
};

/// Throws Error at `path`.
InputPicture read_picture(const std::filesystem::path &path);

/// Throws Error at `path`. Values are rows of width x channels samples of `bits` bits.
void write_png_samples(const std::filesystem::path &path, const Image &shape, int bits,
                       const void *samples);

} // namespace tsuya
