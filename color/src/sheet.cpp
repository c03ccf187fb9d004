#include "tsuya/color/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include "channels.h"
#include "pictures.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

namespace fs = std::filesystem;

struct Colors {
    float background;
    float text;
};

Colors colors_of(SheetTheme theme) {
    return theme == SheetTheme::light ? Colors{0.87f, 0.13f} : Colors{0.16f, 0.85f};
}

/// Where everything stands, in pixels.
struct Layout {
    int columns = 1, rows = 1;
    int width = 0; ///< of a picture
    int margin = 0;
    int font = 0, title_font = 0, caption_font = 0; ///< sizes of letters
    int label_width = 0, title_height = 0;
    std::vector<int> heights{}, caption_lines{}; ///< of each row

    int left(int column) const { return margin + label_width + column * (width + margin); }
    int top(int row) const {
        int y = margin + title_height;
        for (int above = 0; above < row; ++above)
            y += height(above) + caption_height(above) + margin;
        return y;
    }
    int height(int row) const { return heights[static_cast<std::size_t>(row)]; }
    int line_height() const { return caption_font * 3 / 2; }
    int caption_height(int row) const {
        const int lines = caption_lines[static_cast<std::size_t>(row)];
        return lines == 0 ? 0 : font / 2 + lines * line_height();
    }
    int sheet_width() const { return left(columns); }
    int sheet_height() const { return top(rows); }
};

bool is_empty(const SheetPicture &picture) { return picture.image.data.empty(); }

std::vector<std::string> lines_of(const std::string &caption) {
    std::vector<std::string> lines;
    std::istringstream text(caption);
    for (std::string line; std::getline(text, line);)
        lines.push_back(line);
    return lines;
}

fs::path find_font() {
    std::vector<fs::path> folders{"/usr/share/fonts", "/usr/local/share/fonts", "/Library/Fonts",
                                  "/System/Library/Fonts", "C:/Windows/Fonts"};
    if (const char *home = std::getenv("HOME")) {
        folders.push_back(fs::path(home) / ".local/share/fonts");
        folders.push_back(fs::path(home) / ".fonts");
    }
    constexpr std::array kNames{"DejaVuSans.ttf", "NotoSans-Regular.ttf",
                                "LiberationSans-Regular.ttf", "Arial.ttf", "arial.ttf"};
    std::array<fs::path, kNames.size()> found;
    for (const fs::path &folder : folders) {
        std::error_code code;
        fs::recursive_directory_iterator files(folder,
                                               fs::directory_options::skip_permission_denied, code);
        for (; !code && files != fs::recursive_directory_iterator(); files.increment(code))
            for (std::size_t i = 0; i < kNames.size(); ++i)
                if (found[i].empty() && files->path().filename() == kNames[i])
                    found[i] = files->path();
    }
    const auto best = std::find_if(found.begin(), found.end(), [](auto &p) { return !p.empty(); });
    if (best == found.end())
        throw Error(
            {"no font was found to write captions with", "sheet.font",
             "expected DejaVuSans.ttf in /usr/share/fonts, as the package fonts-dejavu-core "
             "brings it, or the path of a TrueType file"});
    return *best;
}

/// Width and height of a text in pixels.
std::array<int, 2> text_size(const std::string &text, int size, const std::string &font) {
    if (text.empty())
        return {0, 0};
    return picture_writer().text_size(text, size, font);
}

/// The largest size up to `size` at which the text fits into `width` pixels.
int fitting_size(const std::string &text, int size, int width, const std::string &font) {
    constexpr int kLeast = 6;
    while (size > kLeast && text_size(text, size, font)[0] > width)
        --size;
    return size;
}

void check(const Sheet &sheet) {
    if (sheet.pictures.empty())
        throw Error({"the sheet has no picture", "sheet.pictures", "expected at least one"});
    if (sheet.columns < 0)
        throw Error({"the sheet has " + std::to_string(sheet.columns) + " columns", "sheet.columns",
                     "expected 1 or more, or 0 for one row"});
    const auto first = std::find_if_not(sheet.pictures.begin(), sheet.pictures.end(), is_empty);
    if (first == sheet.pictures.end())
        throw Error({"the sheet has no picture", "sheet.pictures", "expected at least one"});
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const std::string where = "sheet.pictures." + std::to_string(i);
        const Image &image = sheet.pictures[i].image;
        if (is_empty(sheet.pictures[i]))
            continue;
        channel_indices(image, {"R", "G", "B"}, where);
        if (image.width != first->image.width)
            throw Error({"the picture is " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels",
                         where,
                         "expected the width of the first, " + std::to_string(first->image.width)});
    }
}

/// The height of each row, and how many lines its longest caption has.
void measure_rows(const Sheet &sheet, Layout &layout) {
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const SheetPicture &picture = sheet.pictures[i];
        if (i % static_cast<std::size_t>(layout.columns) == 0) {
            layout.heights.push_back(0);
            layout.caption_lines.push_back(0);
        }
        int &height = layout.heights.back(), &lines = layout.caption_lines.back();
        if (!is_empty(picture) && height > 0 && height != picture.image.height)
            throw Error({"the picture is " + std::to_string(picture.image.width) + " x " +
                             std::to_string(picture.image.height) + " pixels",
                         "sheet.pictures." + std::to_string(i),
                         "expected the height of its row, " + std::to_string(height)});
        height = std::max(height, picture.image.height);
        lines = std::max(lines, static_cast<int>(lines_of(picture.caption).size()));
    }
}

Layout make_layout(const Sheet &sheet, const std::string &font) {
    Layout layout;
    const auto count = static_cast<int>(sheet.pictures.size());
    layout.columns = sheet.columns == 0 ? count : std::min(sheet.columns, count);
    layout.rows = (count + layout.columns - 1) / layout.columns;
    if (!sheet.row_labels.empty() &&
        sheet.row_labels.size() != static_cast<std::size_t>(layout.rows))
        throw Error({detail::counted(sheet.row_labels.size(), "row label") + " for " +
                         detail::counted(static_cast<std::size_t>(layout.rows), "row"),
                     "sheet.row_labels", "expected none, or one for each row"});
    layout.width =
        std::find_if_not(sheet.pictures.begin(), sheet.pictures.end(), is_empty)->image.width;
    measure_rows(sheet, layout);
    layout.font = std::clamp(layout.width / 16, 11, 96);
    layout.title_font = layout.font * 5 / 4;
    layout.margin = std::max(8, layout.width / 24);
    layout.caption_font = layout.font;
    for (const SheetPicture &picture : sheet.pictures) // one size for all: the longest must fit
        for (const std::string &line : lines_of(picture.caption))
            layout.caption_font = fitting_size(line, layout.caption_font, layout.width, font);
    layout.title_height = sheet.title.empty() ? 0 : layout.title_font * 2;
    for (const std::string &label : sheet.row_labels)
        for (const std::string &line : lines_of(label))
            layout.label_width =
                std::max(layout.label_width, text_size(line, layout.font, font)[0] + layout.margin);
    return layout;
}

/// Draws into the sheet that it is given.
class Pen {
  public:
    Pen(Image &sheet, std::string font, float text)
        : sheet_(sheet), font_(std::move(font)), text_(text) {}

    enum class Align { left, centre };

    /// Writes a text into the box, in its middle from top to bottom, as large as `size` or as fits.
    void write(const std::string &text, int x, int y, int width, int height, int size, Align align,
               std::optional<float> colour = {}) {
        if (text.empty())
            return;
        const bool centred = align == Align::centre;
        const float shade = colour.value_or(text_);
        // The baseline: capitals are about 0.72 of the size high, so they stand in the middle.
        const int fitted = fitting_size(text, size, width, font_);
        const int baseline = y + (height + static_cast<int>(0.72 * fitted)) / 2;
        picture_writer().write_text(sheet_, text,
                                    {.x = centred ? x + width / 2 : x,
                                     .baseline = baseline,
                                     .centred = centred,
                                     .size = fitted,
                                     .colour = {shade, shade, shade}},
                                    font_);
    }

  private:
    Image &sheet_;
    std::string font_;
    float text_;
};

void paste(const Image &picture, int left, int top, Image &sheet) {
    const auto from = channel_indices(picture, {"R", "G", "B"}, "sheet.pictures");
    const auto alpha = std::find(picture.channels.begin(), picture.channels.end(), "A");
    const auto alpha_index = static_cast<std::size_t>(alpha - picture.channels.begin());
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) {
            const float *const pixel = picture.pixel(x, y);
            const float share = alpha == picture.channels.end() ? 1.0f : pixel[alpha_index];
            for (std::size_t c = 0; c < 3; ++c) {
                float &to = sheet.pixel(left + x, top + y)[c];
                to = share < 1 ? to + share * (pixel[from[c]] - to) : pixel[from[c]];
            }
        }
}

/// Writes the words on a picture that stands at `left`, `top`.
void write_marks(const SheetPicture &picture, int left, int top, int size, Pen &pen,
                 const Image &sheet) {
    const auto place = [](int begin, double share, int length) {
        return begin + static_cast<int>(std::clamp(share, 0.0, 1.0) * length);
    };
    for (const SheetMark &mark : picture.marks) {
        const int x = place(left, mark.x, picture.image.width),
                  y = place(top, mark.y, picture.image.height);
        const float *const ground =
            sheet.pixel(std::min(x, sheet.width - 1), std::min(y, sheet.height - 1));
        const bool bright = 0.2126f * ground[0] + 0.7152f * ground[1] + 0.0722f * ground[2] > 0.5f;
        pen.write(mark.text, x, y - size, left + picture.image.width - x, 2 * size, size,
                  Pen::Align::left, bright ? 0.0f : 1.0f);
    }
}

/// Writes the lines of a label beside the middle of its row.
void write_label(const std::string &label, int row, const Layout &layout, Pen &pen) {
    const std::vector<std::string> lines = lines_of(label);
    const int height = layout.font * 3 / 2;
    int top = layout.top(row) + (layout.height(row) - height * static_cast<int>(lines.size())) / 2;
    for (const std::string &line : lines) {
        pen.write(line, layout.margin, top, layout.label_width, height, layout.font,
                  Pen::Align::left);
        top += height;
    }
}

bool has_words(const Sheet &sheet) {
    return !sheet.title.empty() ||
           std::any_of(sheet.row_labels.begin(), sheet.row_labels.end(),
                       [](const std::string &label) { return !label.empty(); }) ||
           std::any_of(sheet.pictures.begin(), sheet.pictures.end(),
                       [](const auto &p) { return !p.caption.empty() || !p.marks.empty(); });
}

} // namespace

int sheet_columns(std::size_t pictures) {
    const auto count = std::max(1, static_cast<int>(pictures));
    const int rows = (count + kSheetColumns - 1) / kSheetColumns;
    return (count + rows - 1) / rows;
}

void add_rows(Sheet &sheet, const std::string &label, std::vector<SheetPicture> pictures) {
    const auto columns = static_cast<std::size_t>(std::max(1, sheet.columns));
    const std::size_t rows = (pictures.size() + columns - 1) / columns;
    pictures.resize(rows * columns);
    for (std::size_t row = 0; row < rows; ++row)
        sheet.row_labels.push_back(row == 0 ? label : "");
    std::move(pictures.begin(), pictures.end(), std::back_inserter(sheet.pictures));
}

Image draw_sheet(const Sheet &sheet) {
    check(sheet);
    const std::string font =
        !has_words(sheet) || !sheet.font.empty() ? sheet.font.string() : find_font().string();
    const Layout layout = make_layout(sheet, font);
    const Colors colors = colors_of(sheet.theme);
    Image out = Image::make(layout.sheet_width(), layout.sheet_height(), {"R", "G", "B"});
    std::fill(out.data.begin(), out.data.end(), colors.background);

    Pen pen(out, font, colors.text);
    pen.write(sheet.title, layout.margin, layout.margin / 2, out.width - 2 * layout.margin,
              layout.title_height, layout.title_font, Pen::Align::left);
    for (std::size_t row = 0; row < sheet.row_labels.size(); ++row)
        write_label(sheet.row_labels[row], static_cast<int>(row), layout, pen);
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const SheetPicture &picture = sheet.pictures[i];
        const int column = static_cast<int>(i) % layout.columns;
        const int row = static_cast<int>(i) / layout.columns;
        const int left = layout.left(column), top = layout.top(row);
        if (!is_empty(picture))
            paste(picture.image, left, top, out);
        write_marks(picture, left, top, layout.font, pen, out);
        int below = top + layout.height(row) + layout.font / 4;
        for (const std::string &line : lines_of(picture.caption)) {
            pen.write(line, left, below, layout.width, layout.line_height(), layout.caption_font,
                      Pen::Align::centre);
            below += layout.line_height();
        }
    }
    return out;
}

} // namespace tsuya
