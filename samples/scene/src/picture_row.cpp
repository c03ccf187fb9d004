#include "tsuya/scene/picture_row.h"

#include <algorithm>
#include <locale>
#include <sstream>
#include <string_view>

#include "tsuya/color/image_file.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/file.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;

constexpr double kLetterWidth = 0.6; // of a sans-serif letter on average, in its size
constexpr double kLetters = 28;      // sizes of a letter in the width of a picture, at least

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        unsigned triple = 0;
        for (std::size_t k = 0; k < 3; ++k)
            triple = triple << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[triple >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return result;
}

// The bytes of a PNG of the picture.
std::string png_of(const Image &image, const fs::path &file) {
    const fs::path part = temporary_name(fs::path(file).replace_extension(".png"));
    write_png(part, image);
    std::string bytes = read_file(part);
    fs::remove(part);
    return bytes;
}

std::string svg_of(const std::string &title, const std::vector<SheetPicture> &pictures,
                   const fs::path &file) {
    const int width = pictures[0].image.width, height = pictures[0].image.height;
    std::size_t longest = 1;
    for (const SheetPicture &picture : pictures)
        longest = std::max(longest, picture.caption.size());
    const double letter =
        std::min(width / kLetters, width / (kLetterWidth * static_cast<double>(longest)));
    const double margin = width / kLetters, top = margin + (title.empty() ? 0 : 2 * letter);
    const double all_width = margin + static_cast<double>(pictures.size()) * (width + margin);
    const double all_height = top + height + 2 * letter + margin;
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "<svg xmlns=\"http://www.w3.org/2000/svg\" "
           "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\""
        << all_width << "\" height=\"" << all_height << "\" viewBox=\"0 0 " << all_width << " "
        << all_height << "\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"" << letter
        << "\" text-anchor=\"middle\">\n<rect width=\"100%\" height=\"100%\" fill=\"#dedede\"/>\n";
    const auto write = [&](double x, double y, const std::string &text) {
        out << "<text x=\"" << x << "\" y=\"" << y << "\">" << escaped(text) << "</text>\n";
    };
    if (!title.empty())
        write(all_width / 2, margin + letter, title);
    double x = margin;
    for (const SheetPicture &picture : pictures) {
        out << "<image x=\"" << x << "\" y=\"" << top << "\" width=\"" << width << "\" height=\""
            << height << "\" xlink:href=\"data:image/png;base64,"
            << base64(png_of(picture.image, file)) << "\"/>\n";
        write(x + width / 2.0, top + height + 1.5 * letter, picture.caption);
        x += width + margin;
    }
    out << "</svg>\n";
    return out.str();
}

} // namespace

void write_picture_row(const std::string &title, const std::vector<SheetPicture> &pictures,
                       const fs::path &file) {
    prepare_output_file(file, {".png", ".svg"});
    // Drawn in any case: what is wrong with a sheet is wrong with both
    const Image sheet = draw_sheet({.title = title, .pictures = pictures});
    if (file.extension() == ".svg")
        write_file(file, svg_of(title, pictures, file));
    else
        write_png(file, sheet);
}

} // namespace tsuya::scene
