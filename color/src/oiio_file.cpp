#include "oiio_file.h"

#include <algorithm>
#include <set>

#include <OpenImageIO/imageio.h>

#include "new_file.h"
#include "rows.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr const char *kWritable = "expected a folder that may be written to, with room";

// Rows per call. A multiple of the 16 rows that EXR's zip packs as one; many blocks keep all cores
// busy, few keep the buffer small.
constexpr int kRowsAtOnce = 128;

// Messages of OpenImageIO may run over many lines and may name the temporary file.
std::string clean(std::string text, const std::filesystem::path &temporary,
                  const std::filesystem::path &path) {
    if (!temporary.empty())
        for (std::size_t at; (at = text.find(temporary.string())) != std::string::npos;)
            text.replace(at, temporary.string().size(), path.filename().string());
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "unknown cause" : text;
}

[[noreturn]] void throw_write(const std::string &cause, const NewFile &file,
                              const std::filesystem::path &path) {
    throw Error({"cannot write the picture: " + clean(cause, file.temporary(), path), path.string(),
                 kWritable});
}

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
    spec.attribute("compression", "zip");
    for (const auto &[key, value] : picture.attributes)
        spec.attribute(key, value);
    return spec;
}

} // namespace

void write_exr_picture(const std::filesystem::path &path, const OutputPicture &picture) {
    if (path.extension() != ".exr")
        throw Error({"the file does not end in .exr", path.string(), "expected NAME.exr"});
    check_names(picture.channels, path);
    NewFile file(path);
    const auto out = OIIO::ImageOutput::create(file.temporary().string());
    if (!out)
        throw_write(OIIO::geterror(), file, path);
    if (!out->open(file.temporary().string(), spec_of(picture)))
        throw_write(out->geterror(), file, path);
    const std::size_t row_size = static_cast<std::size_t>(picture.width) * picture.channels.size();
    std::vector<float> rows(row_size *
                            static_cast<std::size_t>(std::min(kRowsAtOnce, picture.height)));
    for (int first = 0; first < picture.height; first += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, picture.height - first);
        for_rows(count, row_size, [&](int begin, int end) {
            for (int y = begin; y < end; ++y)
                picture.fill_row(first + y, rows.data() + static_cast<std::size_t>(y) * row_size);
        });
        if (!out->write_scanlines(first, first + count, 0, OIIO::TypeDesc::FLOAT, rows.data()))
            throw_write(out->geterror(), file, path);
    }
    if (!out->close())
        throw_write(out->geterror(), file, path);
    file.commit();
}

InputPicture read_picture(const std::filesystem::path &path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        throw Error({"there is no such file", path.string(), "expected a readable picture"});
    const auto in = OIIO::ImageInput::open(path.string());
    if (!in)
        throw Error({"cannot read the picture: " + clean(OIIO::geterror(), {}, path), path.string(),
                     "expected a picture such as PNG, JPEG, TIFF or EXR"});
    const OIIO::ImageSpec &spec = in->spec();
    if (spec.deep || spec.depth > 1)
        throw Error({"the picture is deep or a volume", path.string(), "expected a flat picture"});
    InputPicture picture;
    picture.format = in->format_name();
    picture.image = Image::make(spec.width, spec.height, spec.channelnames);
    for (const OIIO::ParamValue &value : spec.extra_attribs)
        if (value.type() == OIIO::TypeDesc::STRING)
            picture.attributes[value.name().string()] = value.get_string();
    if (!in->read_image(0, 0, 0, -1, OIIO::TypeDesc::FLOAT, picture.image.data.data()))
        throw Error({"cannot read the picture: " + clean(in->geterror(), {}, path), path.string(),
                     "expected a complete picture"});
    return picture;
}

void write_png_samples(const std::filesystem::path &path, const Image &shape, int bits,
                       const void *samples) {
    if (path.extension() != ".png")
        throw Error({"the file does not end in .png", path.string(), "expected NAME.png"});
    NewFile file(path);
    const OIIO::TypeDesc type = bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::UINT8;
    OIIO::ImageSpec spec(shape.width, shape.height, static_cast<int>(shape.channels.size()), type);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const auto out = OIIO::ImageOutput::create(file.temporary().string());
    if (!out)
        throw_write(OIIO::geterror(), file, path);
    if (!out->open(file.temporary().string(), spec) || !out->write_image(type, samples) ||
        !out->close())
        throw_write(out->geterror(), file, path);
    file.commit();
}

} // namespace tsuya
