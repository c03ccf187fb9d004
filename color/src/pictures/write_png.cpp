// PNG files through libpng.

#include <csetjmp>
#include <cstdint>
#include <exception>
#include <string>

#include <png.h>

#include "picture_errors.h"
#include "pictures/writer_parts.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

int colour_type_of(std::size_t channels) {
    switch (channels) {
    case 1:
        return PNG_COLOR_TYPE_GRAY;
    case 3:
        return PNG_COLOR_TYPE_RGB;
    default:
        return PNG_COLOR_TYPE_RGB_ALPHA;
    }
}

/// What libpng's calls, which leave by a jump, may fill.
struct Result {
    std::string bytes{}, failure{};
};

void keep_bytes(png_structp png, png_bytep bytes, std::size_t count) {
    auto &result = *static_cast<Result *>(png_get_io_ptr(png));
    try {
        result.bytes.append(reinterpret_cast<const char *>(bytes), count);
    } catch (const std::exception &) { // it must not cross libpng, which is C
        png_error(png, "not enough memory");
    }
}

void keep_failure(png_structp png, png_const_charp message) {
    static_cast<Result *>(png_get_error_ptr(png))->failure = message;
    png_longjmp(png, 1);
}

/// The chunks that say what the numbers mean.
void write_head(const Image &shape, const CodedFile &file, png_structp png, png_infop info) {
    png_set_IHDR(png, info, static_cast<png_uint_32>(shape.width),
                 static_cast<png_uint_32>(shape.height), file.bits,
                 colour_type_of(shape.channels.size()), PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (file.srgb)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_ABSOLUTE);
    if (!file.icc.empty())
        png_set_iCCP(png, info, "display", PNG_COMPRESSION_TYPE_BASE,
                     reinterpret_cast<png_const_bytep>(file.icc.data()),
                     static_cast<png_uint_32>(file.icc.size()));
    png_write_info_before_PLTE(png, info);
    if (file.cicp[0] != 0) // [Png3] section 11.3.2.6, which libpng does not know
        png_write_chunk(png, reinterpret_cast<png_const_bytep>("cICP"), file.cicp.data(),
                        file.cicp.size());
    png_write_info(png, info);
}

/// Nothing here has a destructor: libpng jumps over it.
bool encode(const Image &shape, const CodedFile &file, const void *samples, png_structp png,
            png_infop info) {
    if (setjmp(png_jmpbuf(png)))
        return false;
    const int bits = file.bits;
    write_head(shape, file, png, info);
    if (bits == 16)
        png_set_swap(png); // the file's first byte is the high one
    const std::size_t row =
        static_cast<std::size_t>(shape.width) * shape.channels.size() * (bits == 16 ? 2u : 1u);
    for (int y = 0; y < shape.height; ++y)
        png_write_row(png,
                      static_cast<png_const_bytep>(samples) + static_cast<std::size_t>(y) * row);
    png_write_end(png, info);
    return true;
}

} // namespace

void write_png_samples(const std::filesystem::path &path, const Image &shape, const CodedFile &file,
                       const void *samples) {
    Result result;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &result, keep_failure, nullptr);
    png_infop info = png ? png_create_info_struct(png) : nullptr;
    if (png)
        png_set_write_fn(png, &result, keep_bytes, nullptr);
    const bool good = info && encode(shape, file, samples, png, info);
    png_destroy_write_struct(&png, &info);
    if (!good)
        fail_encoding(path, result.failure.empty() ? "not enough memory" : result.failure);
    write_file(path, result.bytes);
}

} // namespace tsuya
