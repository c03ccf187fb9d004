#include "tsuya/color/config.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"

#include <cstdio>

int main() {
    const std::size_t views = tsuya::view_names().size(); // of the OpenColorIO configuration
    tsuya::Image picture = tsuya::Image::make(2, 1, {"R", "G", "B"});
    tsuya::write_png("consumer.png", picture);
    const tsuya::Spectrum lamp = tsuya::lamp("D65");
    std::printf("%zu views, %zu samples of D65\n", views, lamp.value.size());
    return views > 0 && tsuya::read_image("consumer.png").width == 2 ? 0 : 1;
}
