#pragma once
/// \file
/// The parts of the module that reads, see PictureReader for each.

#include "pictures.h"

namespace tsuya {

InputPicture read_picture(const std::filesystem::path &path);
std::vector<InputPicture> read_picture_parts(const std::filesystem::path &path);
EncodedPicture read_encoded_picture(const std::filesystem::path &path, FloatCode floats);
EncodedPicture decode_png_bytes(std::string_view bytes, const std::string &name);
std::unique_ptr<FrameFile> open_frame_file(const std::filesystem::path &path);
void write_tiff_or_jpeg_samples(const std::filesystem::path &path, const Image &shape,
                                const CodedFile &file, const void *samples);

} // namespace tsuya
