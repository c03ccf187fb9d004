#include "channels.h"

#include <algorithm>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

std::array<std::size_t, 3> channel_indices(const Image &image,
                                           const std::array<const char *, 3> &names,
                                           const std::string &where) {
    check_image(image, where);
    std::array<std::size_t, 3> indices{};
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = std::find(image.channels.begin(), image.channels.end(), names[i]);
        if (found == image.channels.end())
            throw Error({std::string("the picture has no channel ") + names[i], where,
                         std::string("expected the channels ") + names[0] + ", " + names[1] + ", " +
                             names[2]});
        indices[i] = static_cast<std::size_t>(found - image.channels.begin());
    }
    return indices;
}

void check_image(const Image &image, const std::string &where) {
    const bool positive = image.width > 0 && image.height > 0 && !image.channels.empty();
    if (!positive || image.data.size() != static_cast<std::size_t>(image.width) *
                                              static_cast<std::size_t>(image.height) *
                                              image.channels.size())
        throw Error({"the picture of " + std::to_string(image.width) + " x " +
                         std::to_string(image.height) + " pixels and " +
                         detail::counted(image.channels.size(), "channel") + " holds " +
                         detail::counted(image.data.size(), "value"),
                     where, "expected width x height x channels values, at least one"});
}

} // namespace tsuya
