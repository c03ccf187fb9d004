// Text through FreeType.

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include <ft2build.h>
#include FT_FREETYPE_H

#include "pictures/writer_parts.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// A font at one size. Throws Error at `sheet.font`.
class Font {
  public:
    Font(const std::string &file, int size) {
        const bool open = FT_Init_FreeType(&library_) == 0 &&
                          FT_New_Face(library_, file.c_str(), 0, &face_) == 0 &&
                          FT_Set_Pixel_Sizes(face_, 0, static_cast<FT_UInt>(size)) == 0;
        if (open)
            return;
        close();
        throw Error({"the font " + file + " cannot be used", "sheet.font",
                     "expected a readable TrueType file"});
    }
    ~Font() { close(); }
    Font(const Font &) = delete;
    Font &operator=(const Font &) = delete;

    /// The glyph of a character as grey pixels; null where the font has none that can be drawn.
    FT_GlyphSlot glyph(char32_t character) {
        return FT_Load_Char(face_, character, FT_LOAD_RENDER) == 0 ? face_->glyph : nullptr;
    }

  private:
    void close() {
        if (face_)
            FT_Done_Face(face_);
        if (library_)
            FT_Done_FreeType(library_);
    }
    FT_Library library_ = nullptr;
    FT_Face face_ = nullptr;
};

/// The characters of UTF-8; what is none is U+FFFD.
std::u32string characters_of(std::string_view text) {
    std::u32string all;
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t at) {
            return at < text.size() ? static_cast<unsigned char>(text[at]) : 0u;
        };
        const unsigned first = byte(i);
        const std::size_t length = first < 0x80 ? 1 : first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
        char32_t character = length == 1 ? first : first & (0xffu >> (length + 1));
        bool good = first < 0x80 || (first >= 0xc2 && first < 0xf5);
        std::size_t k = 1;
        for (; good && k < length; ++k) {
            good = (byte(i + k) & 0xc0) == 0x80;
            character = character << 6 | (byte(i + k) & 0x3f);
        }
        all.push_back(good ? character : U'\ufffd');
        i += good ? length : 1;
    }
    return all;
}

/// Calls `act` for each glyph with the column of its origin, from 0 on.
template <class Act> void for_each_glyph(Font &font, const std::string &text, Act &&act) {
    int pen = 0;
    for (const char32_t character : characters_of(text))
        if (const FT_GlyphSlot glyph = font.glyph(character)) {
            act(*glyph, pen);
            pen += static_cast<int>(glyph->advance.x >> 6); // in 64ths of a pixel
        }
}

/// The pixels that a text covers, about its origin; the last are excluded.
struct Bounds {
    int left = std::numeric_limits<int>::max(), right = std::numeric_limits<int>::min();
    int top = left, bottom = right;
};

Bounds bounds_of(Font &font, const std::string &text) {
    Bounds bounds;
    for_each_glyph(font, text, [&](const FT_GlyphSlotRec &glyph, int pen) {
        const int left = pen + glyph.bitmap_left, top = -glyph.bitmap_top;
        // A blank is as wide as it advances
        const int right = std::max(left + static_cast<int>(glyph.bitmap.width),
                                   pen + static_cast<int>(glyph.advance.x >> 6));
        bounds.left = std::min(bounds.left, left);
        bounds.right = std::max(bounds.right, right);
        bounds.top = std::min(bounds.top, top);
        bounds.bottom = std::max(bounds.bottom, top + static_cast<int>(glyph.bitmap.rows));
    });
    if (bounds.left > bounds.right)
        return {0, 0, 0, 0};
    return bounds;
}

void draw_glyph(Image &image, const FT_GlyphSlotRec &glyph, int x, int y,
                const std::array<float, 3> &colour) {
    const FT_Bitmap &bitmap = glyph.bitmap;
    for (int row = 0; row < static_cast<int>(bitmap.rows); ++row)
        for (int column = 0; column < static_cast<int>(bitmap.width); ++column) {
            const int to_x = x + column, to_y = y + row;
            if (to_x < 0 || to_x >= image.width || to_y < 0 || to_y >= image.height)
                continue;
            const float cover =
                static_cast<float>(bitmap.buffer[row * bitmap.pitch + column]) / 255;
            float *const pixel = image.pixel(to_x, to_y);
            for (std::size_t c = 0; c < 3; ++c)
                pixel[c] += cover * (colour[c] - pixel[c]);
        }
}

} // namespace

std::array<int, 2> size_of_text(const std::string &text, int size, const std::string &font) {
    Font face(font, size);
    const Bounds bounds = bounds_of(face, text);
    return {bounds.right - bounds.left, bounds.bottom - bounds.top};
}

void draw_text(Image &image, const std::string &text, const TextPlace &place,
               const std::string &font) {
    Font face(font, place.size);
    int left = place.x;
    if (place.centred) {
        const Bounds bounds = bounds_of(face, text);
        left -= (bounds.left + bounds.right) / 2;
    }
    for_each_glyph(face, text, [&](const FT_GlyphSlotRec &glyph, int pen) {
        draw_glyph(image, glyph, left + pen + glyph.bitmap_left, place.baseline - glyph.bitmap_top,
                   place.colour);
    });
}

} // namespace tsuya
