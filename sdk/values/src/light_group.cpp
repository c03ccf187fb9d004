#include "tsuya/sdk/light_group.h"

#include <algorithm>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr std::size_t kLongest = 64; // bytes; EXR names a channel in 255

std::string what_is_wrong(const std::string &name) {
    if (name.empty())
        return "a light group has no name";
    if (name.size() > kLongest)
        return "the name of a light group is too long";
    const bool bad = std::any_of(name.begin(), name.end(), [](char c) {
        return c == '=' || static_cast<unsigned char>(c) < ' ' || c == 127;
    });
    return bad ? "the name of a light group has '=' or a control character" : "";
}

} // namespace

void check_light_group(const std::string &name, const std::string &where) {
    if (const std::string what = what_is_wrong(name); !what.empty())
        throw Error({what, where,
                     "expected 1 to " + std::to_string(kLongest) +
                         " bytes, without '=' and control characters, such as \"key\""});
}

} // namespace tsuya
