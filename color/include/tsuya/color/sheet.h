#pragma once
/// \file
/// Pictures side by side, with words under them.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/sdk/image.h"

namespace tsuya {

/// A few words on a picture.
struct SheetMark {
    double x = 0, y = 0; ///< where they begin and their middle, as shares of width and height
    std::string text{};  ///< UTF-8; black or white, whichever is read better there
};

/// A picture of a sheet, and the words under it.
struct SheetPicture {
    /// Display-encoded R, G, B, as `display` makes it; with a channel A it lies on the sheet's
    /// ground. Without pixels the place stays empty
    Image image{};
    /// Under the picture; UTF-8, in lines; all shrink until the longest fits
    std::string caption{};
    std::vector<SheetMark> marks{};
};

/// Black text on a light ground, or the reverse.
enum class SheetTheme { light, dark };

/// A grid of pictures of one width, and of one height in a row, filled row by row; the last row may
/// be short.
struct Sheet {
    std::string title{};                   ///< above all; may be empty
    std::vector<SheetPicture> pictures{};  ///< at least one
    int columns = 0;                       ///< 0: all in one row
    std::vector<std::string> row_labels{}; ///< left of each row, in lines; empty, or one a row
    SheetTheme theme = SheetTheme::light;
    /// A TrueType file; empty: DejaVu Sans or another common font in the usual folders.
    std::filesystem::path font{};
};

/// The most columns of a sheet that is looked at on a screen.
inline constexpr int kSheetColumns = 4;

/// The columns for so many pictures: as few rows as kSheetColumns asks for, filled alike.
int sheet_columns(std::size_t pictures);

/// Appends pictures to a sheet as rows of their own: as many as its columns in each, the last row
/// filled up with empty places. The label stands beside the first of them.
void add_rows(Sheet &sheet, const std::string &label, std::vector<SheetPicture> pictures);

/// Draws the sheet: R, G, B in [0, 1]. Letters grow with the pictures' width. Throws Error at
/// `sheet.<part>` for no picture, sizes that differ, a wrong number of labels, or no font (naming
/// the package that has one).
Image draw_sheet(const Sheet &sheet);

} // namespace tsuya
