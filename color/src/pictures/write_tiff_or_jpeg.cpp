// TIFF and JPEG files through OpenImageIO.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <sys/mman.h>
#include <unistd.h>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "picture_errors.h"
#include "pictures/oiio_input.h"
#include "pictures/reader_parts.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

/// A file in memory, with a path: OpenImageIO's TIFF writer loses the directory of what it writes
/// into a buffer.
class MemoryFile {
  public:
    MemoryFile() : descriptor_(memfd_create("picture", MFD_CLOEXEC)) {}
    ~MemoryFile() {
        if (descriptor_ >= 0)
            close(descriptor_);
    }
    MemoryFile(const MemoryFile &) = delete;
    MemoryFile &operator=(const MemoryFile &) = delete;

    std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

  private:
    int descriptor_;
};

/// Encodes one picture in memory, and then writes the file at once: OpenImageIO reports success
/// where the last bytes of a file do not fit on the disk.
class Encoder {
  public:
    explicit Encoder(std::filesystem::path path) : path_(std::move(path)), output_(nullptr) {
        use_threads_of_arena();
        output_ = OIIO::ImageOutput::create(path_.extension().string().substr(1));
        if (!output_)
            fail_encoding(path_, one_line(OIIO::geterror()));
        if (is_tiff())
            file_.emplace();
        else
            check(output_->set_ioproxy(&bytes_));
    }

    void write(OIIO::ImageSpec spec, const void *rows) {
        if (!is_tiff())
            spec.attribute("CompressionQuality", 95);
        check(output_->open(file_ ? file_->path() : path_.string(), spec));
        check(output_->write_scanlines(0, spec.height, 0, spec.format, rows));
        check(output_->close());
        if (file_)
            return write_file(path_, read_file(file_->path()));
        const std::vector<unsigned char> &bytes = bytes_.buffer();
        write_file(path_,
                   std::string_view(reinterpret_cast<const char *>(bytes.data()), bytes.size()));
    }

  private:
    bool is_tiff() const { return std::string_view(output_->format_name()) == "tiff"; }
    void check(bool good) const {
        if (!good)
            fail_encoding(path_, one_line(output_->geterror()));
    }

    std::filesystem::path path_;
    OIIO::Filesystem::IOVecOutput bytes_; // before its user
    std::optional<MemoryFile> file_{};    // in its place
    std::unique_ptr<OIIO::ImageOutput> output_;
};

} // namespace

void write_tiff_or_jpeg_samples(const std::filesystem::path &path, const Image &shape,
                                const CodedFile &file, const void *samples) {
    const OIIO::TypeDesc type = file.bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(shape.width, shape.height, static_cast<int>(shape.channels.size()), type);
    if (file.srgb)
        spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    if (!file.icc.empty())
        spec.attribute("ICCProfile",
                       OIIO::TypeDesc(OIIO::TypeDesc::UINT8, static_cast<int>(file.icc.size())),
                       file.icc.data());
    Encoder(path).write(std::move(spec), samples);
}

} // namespace tsuya
