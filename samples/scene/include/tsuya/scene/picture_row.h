#pragma once
/// \file
/// Pictures side by side as a file.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/color/sheet.h"

namespace tsuya::scene {

/// Writes pictures of one size in a row, with a title above and captions below: as .png, as
/// draw_sheet makes it, or as .svg, where words are text. Throws Error as draw_sheet, and at the
/// path as prepare_output_file.
void write_picture_row(const std::string &title, const std::vector<SheetPicture> &pictures,
                       const std::filesystem::path &file);

} // namespace tsuya::scene
