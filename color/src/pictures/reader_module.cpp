// The one door of the module that reads.

#include "pictures/reader_parts.h"

namespace tsuya {
namespace {

class OiioReader final : public PictureReader {
  public:
    InputPicture read(const std::filesystem::path &path) const override {
        return read_picture(path);
    }
    std::vector<InputPicture> read_parts(const std::filesystem::path &path) const override {
        return read_picture_parts(path);
    }
    EncodedPicture read_encoded(const std::filesystem::path &path,
                                FloatCode floats) const override {
        return read_encoded_picture(path, floats);
    }
    EncodedPicture decode_png(std::string_view bytes, const std::string &name) const override {
        return decode_png_bytes(bytes, name);
    }
    std::unique_ptr<FrameFile> open_frame(const std::filesystem::path &path) const override {
        return open_frame_file(path);
    }
    void write_tiff_or_jpeg(const std::filesystem::path &path, const Image &shape,
                            const CodedFile &file, const void *samples) const override {
        write_tiff_or_jpeg_samples(path, shape, file, samples);
    }
};

} // namespace
} // namespace tsuya

extern "C" [[gnu::visibility("default")]] const tsuya::PictureReader *tsuya_picture_reader() {
    static const tsuya::OiioReader reader;
    return &reader;
}
