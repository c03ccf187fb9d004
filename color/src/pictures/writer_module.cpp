// The one door of the module that writes.

#include "pictures/writer_parts.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

class Writer final : public PictureWriter {
  public:
    void write_exr(const std::filesystem::path &path, const OutputPicture &picture) const override {
        write_exr_picture(path, picture);
    }
    void write_exr_parts(const std::filesystem::path &path,
                         std::span<const OutputPicture> parts) const override {
        tsuya::write_exr_parts(path, parts);
    }
    void write_png(const std::filesystem::path &path, const Image &shape, const CodedFile &file,
                   const void *samples) const override {
        write_png_samples(path, shape, file, samples);
    }
    std::string deflate(std::string_view bytes) const override { return deflate_bytes(bytes); }
    std::array<int, 2> text_size(const std::string &text, int size,
                                 const std::string &font) const override {
        return size_of_text(text, size, font);
    }
    void write_text(Image &image, const std::string &text, const TextPlace &place,
                    const std::string &font) const override {
        draw_text(image, text, place, font);
    }
};

} // namespace

void check_extension(const std::filesystem::path &path, const char *extension) {
    if (path.extension() != extension)
        throw Error({std::string("the file does not end in ") + extension, path.string(),
                     std::string("expected NAME") + extension});
}

void fail_encoding(const std::filesystem::path &path, const std::string &cause) {
    throw Error({"cannot encode the picture: " + cause, path.string(),
                 "expected a picture that the format can hold"});
}

} // namespace tsuya

extern "C" [[gnu::visibility("default")]] const tsuya::PictureWriter *tsuya_picture_writer() {
    static const tsuya::Writer writer;
    return &writer;
}
