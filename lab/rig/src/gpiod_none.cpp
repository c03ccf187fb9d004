// Without libgpiod.
#include "gpiod_api.h"

namespace tsuya::lab::gpiod_api {

void need_library() {
    throw Error({.what = "this build of Tsuya has no libgpiod, so no real lines",
                 .where = "lines",
                 .accepted = "a build on a computer with libgpiod-dev, or simulated lines"});
}

ChipInfo chip_info(const std::string &) {
    need_library();
    return {};
}

std::unique_ptr<Request> request(const RequestSettings &, const std::string &) {
    need_library();
    return nullptr;
}

} // namespace tsuya::lab::gpiod_api
