#include "tsuya/sdk/texture.h"

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

void check_texture(const Texture &texture, const std::string &where) {
    const auto &[width, height, channels, data] = texture;
    if (width < 1 || height < 1)
        throw Error({"the picture is " + std::to_string(width) + " x " + std::to_string(height),
                     where, "expected at least one pixel"});
    if (channels != 1 && channels != 3 && channels != 4)
        throw Error(
            {"the picture has " + detail::counted(static_cast<std::size_t>(channels), "channel"),
             where, "expected 1 (coverage), 3 (RGB) or 4 (RGB and coverage)"});
    const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                                static_cast<std::size_t>(channels);
    if (data.size() != samples)
        throw Error({"the picture has " + detail::counted(data.size(), "sample"), where,
                     "expected " + std::to_string(samples)});
}

} // namespace tsuya
