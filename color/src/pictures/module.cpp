// The module's one door.

#include "pictures/picture_files.h"

namespace tsuya {
namespace {

class OiioPictures final : public Pictures {
  public:
    void write_exr(const std::filesystem::path &path, const OutputPicture &picture) const override {
        write_exr_picture(path, picture);
    }
    void write_png(const std::filesystem::path &path, const Image &shape, int bits,
                   const void *samples) const override {
        write_png_samples(path, shape, bits, samples);
    }
    InputPicture read(const std::filesystem::path &path) const override {
        return read_picture(path);
    }
    EncodedPicture read_encoded(const std::filesystem::path &path,
                                FloatCode floats) const override {
        return read_encoded_picture(path, floats);
    }
    EncodedPicture decode_png(std::string_view bytes, const std::string &name) const override {
        return decode_png_bytes(bytes, name);
    }
    std::string deflate(std::string_view bytes) const override { return deflate_bytes(bytes); }
    std::unique_ptr<FrameFile> open_frame(const std::filesystem::path &path) const override {
        return open_frame_file(path);
    }
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

extern "C" [[gnu::visibility("default")]] const tsuya::Pictures *tsuya_pictures() {
    static const tsuya::OiioPictures pictures;
    return &pictures;
}
