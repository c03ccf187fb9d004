#pragma once
/// \file
/// Pictures side by side, with words under them.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/sdk/image.h"

namespace tsuya {

/// A picture of a sheet, and the words under it.
struct SheetPicture {
    /// Display-encoded R, G, B, as `display` makes it; with a channel A it lies on the sheet's
    /// ground
    Image image{};
    std::string caption{}; ///< under the picture; UTF-8; all shrink until the longest fits
};

/// Black text on a light ground, or the reverse.
enum class SheetTheme { light, dark };

/// A grid of pictures of one size, filled row by row; the last row may be short.
struct Sheet {
    std::string title{};                   ///< above all; may be empty
    std::vector<SheetPicture> pictures{};  ///< at least one
    int columns = 0;                       ///< 0: all in one row
    std::vector<std::string> row_labels{}; ///< left of each row; empty, or one a row
    SheetTheme theme = SheetTheme::light;
    /// A TrueType file; empty: DejaVu Sans or another common font in the usual folders.
    std::filesystem::path font{};
};

/// Draws the sheet: R, G, B in [0, 1]. Letters grow with the pictures' width. Throws Error at
/// `sheet.<part>` for no picture, sizes that differ, a wrong number of labels, or no font (naming
/// the package that has one).
Image draw_sheet(const Sheet &sheet);

} // namespace tsuya
