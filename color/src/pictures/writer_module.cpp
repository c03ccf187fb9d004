// The one door of the module that writes.

#include "pictures/writer_parts.h"

namespace tsuya {
namespace {

class Writer final : public PictureWriter {
  public:
    void write_exr(const std::filesystem::path &path,
                   std::span<const OutputPicture> parts) const override {
        write_exr_file(path, parts);
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
} // namespace tsuya

extern "C" [[gnu::visibility("default")]] const tsuya::PictureWriter *tsuya_picture_writer() {
    static const tsuya::Writer writer;
    return &writer;
}
