#include "tsuya/color/sheet.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

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
    int width = 0, height = 0; ///< of a picture
    int margin = 0;
    int font = 0, title_font = 0, caption_font = 0; ///< sizes of letters
    int label_width = 0, caption_height = 0, title_height = 0;

    int left(int column) const { return margin + label_width + column * (width + margin); }
    int top(int row) const {
        return margin + title_height + row * (height + caption_height + margin);
    }
    int sheet_width() const { return left(columns); }
    int sheet_height() const { return top(rows); }
};

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
    const Image &first = sheet.pictures[0].image;
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const std::string where = "sheet.pictures." + std::to_string(i);
        const Image &image = sheet.pictures[i].image;
        channel_indices(image, {"R", "G", "B"}, where);
        if (image.width != first.width || image.height != first.height)
            throw Error({"the picture is " + std::to_string(image.width) + " x " +
                             std::to_string(image.height) + " pixels",
                         where,
                         "expected the size of the first, " + std::to_string(first.width) + " x " +
                             std::to_string(first.height)});
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
    layout.width = sheet.pictures[0].image.width;
    layout.height = sheet.pictures[0].image.height;
    layout.font = std::clamp(layout.width / 16, 11, 96);
    layout.title_font = layout.font * 5 / 4;
    layout.margin = std::max(8, layout.width / 24);
    const bool captions = std::any_of(sheet.pictures.begin(), sheet.pictures.end(),
                                      [](const auto &p) { return !p.caption.empty(); });
    layout.caption_height = captions ? layout.font * 2 : 0;
    layout.caption_font = layout.font;
    for (const SheetPicture &picture : sheet.pictures) // one size for all: the longest must fit
        layout.caption_font =
            fitting_size(picture.caption, layout.caption_font, layout.width, font);
    layout.title_height = sheet.title.empty() ? 0 : layout.title_font * 2;
    for (const std::string &label : sheet.row_labels)
        layout.label_width =
            std::max(layout.label_width, text_size(label, layout.font, font)[0] + layout.margin);
    return layout;
}

/// Draws into the sheet that it is given.
class Pen {
  public:
    Pen(Image &sheet, std::string font, float text)
        : sheet_(sheet), font_(std::move(font)), color_{text, text, text} {}

    enum class Align { left, centre };

    /// Writes a text into the box, in its middle from top to bottom, as large as `size` or as fits.
    void write(const std::string &text, int x, int y, int width, int height, int size,
               Align align) {
        if (text.empty())
            return;
        const bool centred = align == Align::centre;
        // The baseline: capitals are about 0.72 of the size high, so they stand in the middle.
        const int fitted = fitting_size(text, size, width, font_);
        const int baseline = y + (height + static_cast<int>(0.72 * fitted)) / 2;
        picture_writer().write_text(sheet_, text,
                                    {.x = centred ? x + width / 2 : x,
                                     .baseline = baseline,
                                     .centred = centred,
                                     .size = fitted,
                                     .colour = color_},
                                    font_);
    }

  private:
    Image &sheet_;
    std::string font_;
    std::array<float, 3> color_;
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

} // namespace

Image draw_sheet(const Sheet &sheet) {
    check(sheet);
    const bool words = !sheet.title.empty() || !sheet.row_labels.empty() ||
                       std::any_of(sheet.pictures.begin(), sheet.pictures.end(),
                                   [](const auto &p) { return !p.caption.empty(); });
    const std::string font =
        !words || !sheet.font.empty() ? sheet.font.string() : find_font().string();
    const Layout layout = make_layout(sheet, font);
    const Colors colors = colors_of(sheet.theme);
    Image out = Image::make(layout.sheet_width(), layout.sheet_height(), {"R", "G", "B"});
    std::fill(out.data.begin(), out.data.end(), colors.background);

    Pen pen(out, font, colors.text);
    pen.write(sheet.title, layout.margin, layout.margin / 2, out.width - 2 * layout.margin,
              layout.title_height, layout.title_font, Pen::Align::left);
    for (int row = 0; row < layout.rows; ++row)
        if (!sheet.row_labels.empty())
            pen.write(sheet.row_labels[static_cast<std::size_t>(row)], layout.margin,
                      layout.top(row), layout.label_width, layout.height, layout.font,
                      Pen::Align::left);
    for (std::size_t i = 0; i < sheet.pictures.size(); ++i) {
        const int column = static_cast<int>(i) % layout.columns;
        const int row = static_cast<int>(i) / layout.columns;
        const int left = layout.left(column), top = layout.top(row);
        paste(sheet.pictures[i].image, left, top, out);
        pen.write(sheet.pictures[i].caption, left, top + layout.height, layout.width,
                  layout.caption_height, layout.caption_font, Pen::Align::centre);
    }
    return out;
}

} // namespace tsuya
