#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include "pictures/picture_files.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

std::array<int, 2> size_of_text(const std::string &text, int size, const std::string &font) {
    const OIIO::ROI roi = OIIO::ImageBufAlgo::text_size(text, size, font);
    if (!roi.defined())
        throw Error({"the font " + font + " cannot be used", "sheet.font",
                     "expected a readable TrueType file"});
    return {roi.width(), roi.height()};
}

void draw_text(Image &image, const std::string &text, const TextPlace &place,
               const std::string &font) {
    using namespace OIIO::ImageBufAlgo;
    OIIO::ImageBuf buffer(OIIO::ImageSpec(image.width, image.height, 3, OIIO::TypeDesc::FLOAT),
                          image.data.data());
    if (!render_text(buffer, place.x, place.baseline, text, place.size, font, place.colour,
                     place.centred ? TextAlignX::Center : TextAlignX::Left, TextAlignY::Baseline))
        throw Error({"cannot write a text: " + buffer.geterror(), "sheet.font",
                     "expected a readable TrueType file"});
}

} // namespace tsuya
