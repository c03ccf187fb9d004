#include "pictures/picture_files.h"

#include <algorithm>
#include <memory>
#include <set>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "pictures/oiio_input.h"
#include "rows.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

// Rows per call. A multiple of the 16 rows that EXR's zip packs as one; many blocks keep all cores
// busy, few keep the buffer small.
constexpr int kRowsAtOnce = 128;

/// Encodes one picture in memory, and then writes the file at once: OpenImageIO reports success
/// where the last bytes of a file do not fit on the disk.
class Encoder {
  public:
    /// `format` is the extension, without the dot, that the path must have.
    Encoder(std::filesystem::path path, const std::string &format)
        : path_(std::move(path)), output_(nullptr) {
        if (path_.extension() != '.' + format)
            throw Error(
                {"the file does not end in ." + format, path_.string(), "expected NAME." + format});
        use_threads_of_arena();
        output_ = OIIO::ImageOutput::create(format);
        if (!output_ || !output_->set_ioproxy(&bytes_))
            fail(OIIO::geterror());
    }

    void open(const OIIO::ImageSpec &spec) { check(output_->open(path_.string(), spec)); }
    void write(int first_row, int end_row, const OIIO::TypeDesc &type, const void *rows) {
        check(output_->write_scanlines(first_row, end_row, 0, type, rows));
    }
    void finish() {
        check(output_->close());
        const std::vector<unsigned char> &bytes = bytes_.buffer();
        write_file(path_, {reinterpret_cast<const char *>(bytes.data()), bytes.size()});
    }

  private:
    void check(bool good) const {
        if (!good)
            fail(output_->geterror());
    }
    [[noreturn]] void fail(const std::string &cause) const {
        throw Error({"cannot encode the picture: " + one_line(cause), path_.string(),
                     "expected a picture that the format can hold"});
    }

    std::filesystem::path path_;
    OIIO::Filesystem::IOVecOutput bytes_; // before its user
    std::unique_ptr<OIIO::ImageOutput> output_;
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

OIIO::ImageSpec spec_of(const OutputPicture &picture) {
    OIIO::ImageSpec spec(picture.width, picture.height, static_cast<int>(picture.channels.size()),
                         picture.samples == SampleType::half ? OIIO::TypeDesc::HALF
                                                             : OIIO::TypeDesc::FLOAT);
    spec.channelnames = picture.channels;
    if (picture.samples == SampleType::half && picture.exact_from < picture.channels.size()) {
        spec.channelformats.assign(picture.channels.size(), OIIO::TypeDesc::FLOAT);
        std::fill_n(spec.channelformats.begin(), picture.exact_from, OIIO::TypeDesc::HALF);
    }
    if (picture.place) {
        spec.x = picture.place->x;
        spec.y = picture.place->y;
        spec.full_width = picture.place->width;
        spec.full_height = picture.place->height;
    }
    spec.attribute("compression", "zip");
    for (const auto &[key, value] : picture.attributes)
        spec.attribute(key, value);
    return spec;
}

} // namespace

void write_exr_picture(const std::filesystem::path &path, const OutputPicture &picture) {
    check_names(picture.channels, path);
    Encoder encoder(path, "exr");
    encoder.open(spec_of(picture));
    const std::size_t row_size = static_cast<std::size_t>(picture.width) * picture.channels.size();
    std::vector<float> rows(row_size *
                            static_cast<std::size_t>(std::min(kRowsAtOnce, picture.height)));
    for (int first = 0; first < picture.height; first += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, picture.height - first);
        for_rows(count, row_size, [&](int begin, int end) {
            for (int y = begin; y < end; ++y)
                picture.fill_row(first + y, rows.data() + static_cast<std::size_t>(y) * row_size);
        });
        const int top = (picture.place ? picture.place->y : 0) + first;
        encoder.write(top, top + count, OIIO::TypeDesc::FLOAT, rows.data());
    }
    encoder.finish();
}

InputPicture read_picture(const std::filesystem::path &path) {
    const auto in = open_picture(path);
    const OIIO::ImageSpec &spec = in->spec();
    InputPicture picture;
    picture.format = in->format_name();
    need_memory_for(path, spec, spec.height, sizeof(float));
    picture.image = Image::make(spec.width, spec.height, spec.channelnames);
    picture.place = {spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height};
    for (const OIIO::ParamValue &value : spec.extra_attribs)
        if (value.type() == OIIO::TypeDesc::STRING)
            picture.attributes[value.name().string()] = value.get_string();
    if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, picture.image.data.data()))
        fail_reading(path, in->geterror());
    return picture;
}

void write_png_samples(const std::filesystem::path &path, const Image &shape, int bits,
                       const void *samples) {
    const OIIO::TypeDesc type = bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(shape.width, shape.height, static_cast<int>(shape.channels.size()), type);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    Encoder encoder(path, "png");
    encoder.open(spec);
    encoder.write(0, shape.height, type, samples);
    encoder.finish();
}

} // namespace tsuya
