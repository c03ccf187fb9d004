// EXR files through OpenEXR.

#include <algorithm>
#include <exception>
#include <set>
#include <string>
#include <vector>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfThreading.h>
#include <tbb/task_arena.h>

#include "picture_errors.h"
#include "pictures/writer_parts.h"
#include "rows.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

// Rows per call. A multiple of the 16 rows that zip packs as one; many blocks keep all cores busy,
// few keep the buffers small.
constexpr int kRowsAtOnce = 128;

/// Keeps a file in memory, which is then written at once: a full disk is told by one place.
class Bytes final : public Imf::OStream {
  public:
    explicit Bytes(const char *name) : OStream(name) {}
    void write(const char bytes[], int count) override {
        const auto n = static_cast<std::size_t>(count);
        if (at_ + n > data_.size())
            data_.resize(at_ + n);
        std::copy_n(bytes, n, data_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += n;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }
    const std::string &data() const { return data_; }

  private:
    std::string data_{};
    std::size_t at_ = 0;
};

void check_names(const std::vector<std::string> &names, const std::filesystem::path &path) {
    std::set<std::string> seen;
    for (const std::string &name : names) {
        if (name.empty())
            throw Error(
                {"a channel has no name", path.string(), "expected a name for each channel"});
        if (!seen.insert(name).second)
            throw Error({"two channels have the name '" + name + "'", path.string(),
                         "expected different names"});
    }
}

/// How many channels are half; they come first.
std::size_t half_count(const OutputPicture &picture) {
    return picture.samples == SampleType::half
               ? std::min(picture.exact_from, picture.channels.size())
               : 0;
}

Imath::Box2i data_window(const OutputPicture &picture) {
    const Imath::V2i corner =
        picture.place ? Imath::V2i(picture.place->x, picture.place->y) : Imath::V2i(0, 0);
    return {corner, corner + Imath::V2i(picture.width - 1, picture.height - 1)};
}

Imath::V2f as_floats(const glm::dvec2 &xy) {
    return {static_cast<float>(xy.x), static_cast<float>(xy.y)};
}

Imf::Header header_of(const OutputPicture &picture) {
    const Imath::Box2i data = data_window(picture);
    const Imath::Box2i whole =
        picture.place ? Imath::Box2i({0, 0}, {picture.place->width - 1, picture.place->height - 1})
                      : data;
    Imf::Header header(whole, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (std::size_t c = 0; c < picture.channels.size(); ++c)
        header.channels().insert(picture.channels[c],
                                 Imf::Channel(c < half_count(picture) ? Imf::HALF : Imf::FLOAT));
    if (!picture.part.empty()) {
        header.setName(picture.part);
        header.setType(Imf::SCANLINEIMAGE);
    }
    if (const auto &p = picture.primaries)
        Imf::addChromaticities(header, {as_floats(p->red), as_floats(p->green), as_floats(p->blue),
                                        as_floats(p->white)});
    if (picture.neutral)
        Imf::addAdoptedNeutral(header, as_floats(*picture.neutral));
    for (const auto &[key, value] : picture.attributes)
        header.insert(key, Imf::StringAttribute(value));
    return header;
}

/// Some rows of the picture as the file has them: halves and floats apart.
class RowBlock {
  public:
    explicit RowBlock(const OutputPicture &picture)
        : picture_(picture), halves_(half_count(picture)),
          floats_(picture.channels.size() - halves_) {
        const auto pixels = static_cast<std::size_t>(picture.width) *
                            static_cast<std::size_t>(std::min(kRowsAtOnce, picture.height));
        half_.resize(pixels * halves_);
        float_.resize(pixels * floats_);
    }

    void fill(int first, int count) {
        const auto width = static_cast<std::size_t>(picture_.width);
        const std::size_t channels = halves_ + floats_;
        for_rows(count, width * channels, [&](int begin, int end) {
            std::vector<float> row(width * channels);
            for (int y = begin; y < end; ++y) {
                picture_.fill_row(first + y, row.data());
                const std::size_t pixels = static_cast<std::size_t>(y) * width;
                const float *in = row.data();
                for (std::size_t x = 0; x < width; ++x, in += channels) {
                    std::copy_n(in, halves_, half_.data() + (pixels + x) * halves_);
                    std::copy_n(in + halves_, floats_, float_.data() + (pixels + x) * floats_);
                }
            }
        });
    }

    /// For OpenEXR. \param rows where they lie
    Imf::FrameBuffer frame_buffer(const Imath::Box2i &rows) const {
        Imf::FrameBuffer buffer;
        const auto width = static_cast<std::size_t>(picture_.width);
        for (std::size_t c = 0; c < halves_ + floats_; ++c) {
            const bool is_half = c < halves_;
            const void *const first =
                is_half ? static_cast<const void *>(half_.data() + c)
                        : static_cast<const void *>(float_.data() + (c - halves_));
            const std::size_t pixel =
                is_half ? halves_ * sizeof(Imath::half) : floats_ * sizeof(float);
            buffer.insert(picture_.channels[c],
                          Imf::Slice::Make(is_half ? Imf::HALF : Imf::FLOAT, first, rows, pixel,
                                           pixel * width));
        }
        return buffer;
    }

  private:
    const OutputPicture &picture_;
    std::size_t halves_, floats_;
    std::vector<Imath::half> half_{};
    std::vector<float> float_{};
};

/// Writes all rows. \param file a file of one part, or one of its parts
template <class File> void write_rows(File &file, const OutputPicture &picture) {
    RowBlock block(picture);
    const Imath::Box2i data = data_window(picture);
    for (int first = 0; first < picture.height; first += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, picture.height - first);
        block.fill(first, count);
        Imath::Box2i rows = data;
        rows.min.y += first;
        rows.max.y = rows.min.y + count - 1;
        file.setFrameBuffer(block.frame_buffer(rows));
        file.writePixels(count);
    }
}

void encode(std::span<const OutputPicture> parts, Bytes &bytes) {
    // The number of the library's threads is global: of two callers at once, the later one's holds
    const int arena = tbb::this_task_arena::max_concurrency();
    const int threads = arena > 1 ? arena : 0;
    Imf::setGlobalThreadCount(threads);
    if (parts.size() == 1) {
        Imf::OutputFile file(bytes, header_of(parts[0]), threads);
        write_rows(file, parts[0]);
        return;
    }
    std::vector<Imf::Header> headers;
    for (const OutputPicture &part : parts)
        headers.push_back(header_of(part));
    Imf::MultiPartOutputFile file(bytes, headers.data(), static_cast<int>(headers.size()), false,
                                  threads);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart part(file, static_cast<int>(i));
        write_rows(part, parts[i]);
    }
}

} // namespace

void write_exr_file(const std::filesystem::path &path, std::span<const OutputPicture> parts) {
    check_extension(path, ".exr");
    for (const OutputPicture &part : parts)
        check_names(part.channels, path);
    Bytes bytes(path.c_str());
    try {
        encode(parts, bytes);
    } catch (const Error &) {
        throw;
    } catch (const std::bad_alloc &) {
        throw;
    } catch (const std::exception &error) {
        fail_encoding(path, error.what());
    }
    write_file(path, bytes.data());
}

} // namespace tsuya
