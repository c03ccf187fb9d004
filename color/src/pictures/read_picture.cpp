#include "pictures/oiio_input.h"
#include "pictures/reader_parts.h"

namespace tsuya {
namespace {

InputPicture read_part(OIIO::ImageInput &in, const std::filesystem::path &path) {
    const OIIO::ImageSpec &spec = in.spec();
    InputPicture picture;
    picture.part = spec.get_string_attribute("oiio:subimagename");
    picture.format = in.format_name();
    need_memory_for(path, spec, spec.height, sizeof(float));
    picture.image = Image::make(spec.width, spec.height, spec.channelnames);
    picture.place = {spec.x - spec.full_x, spec.y - spec.full_y, spec.full_width, spec.full_height};
    for (const OIIO::ParamValue &value : spec.extra_attribs)
        if (value.type() == OIIO::TypeDesc::STRING)
            picture.attributes[value.name().string()] = value.get_string();
    if (!in.read_image(in.current_subimage(), 0, 0, -1, OIIO::TypeDesc::FLOAT,
                       picture.image.data.data()))
        fail_reading(path, in.geterror());
    return picture;
}

} // namespace

InputPicture read_picture(const std::filesystem::path &path) {
    return read_part(*open_picture(path), path);
}

std::vector<InputPicture> read_picture_parts(const std::filesystem::path &path) {
    const auto in = open_picture(path);
    std::vector<InputPicture> parts;
    for (int i = 0; in->seek_subimage(i, 0); ++i)
        parts.push_back(read_part(*in, path));
    return parts;
}

} // namespace tsuya
