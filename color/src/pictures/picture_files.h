#pragma once
/// \file
/// The parts of the module, see Pictures for each.

#include "pictures.h"

namespace tsuya {

void write_exr_picture(const std::filesystem::path &path, const OutputPicture &picture);
void write_png_samples(const std::filesystem::path &path, const Image &shape, int bits,
                       const void *samples);
InputPicture read_picture(const std::filesystem::path &path);
EncodedPicture read_encoded_picture(const std::filesystem::path &path, FloatCode floats);
EncodedPicture decode_png_bytes(std::string_view bytes, const std::string &name);
std::string deflate_bytes(std::string_view bytes);
std::unique_ptr<FrameFile> open_frame_file(const std::filesystem::path &path);
std::array<int, 2> size_of_text(const std::string &text, int size, const std::string &font);
void draw_text(Image &image, const std::string &text, const TextPlace &place,
               const std::string &font);

} // namespace tsuya
