#pragma once
/// \file
/// The parts of the module that writes, see PictureWriter for each.

#include "pictures.h"

namespace tsuya {

void write_exr_file(const std::filesystem::path &path, std::span<const OutputPicture> parts);
void write_png_samples(const std::filesystem::path &path, const Image &shape, const CodedFile &file,
                       const void *samples);
std::string deflate_bytes(std::string_view bytes);
std::array<int, 2> size_of_text(const std::string &text, int size, const std::string &font);
void draw_text(Image &image, const std::string &text, const TextPlace &place,
               const std::string &font);

} // namespace tsuya
