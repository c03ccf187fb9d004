#include "grain_option.h"

#include <charconv>
#include <cmath>
#include <numbers>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {

void add_grain(Options &options, std::string &grain) {
    options
        .option("--grain", &grain, "DIRECTION",
                "warp direction where the garment has no usable UV: vertical, horizontal, or "
                "degrees from the vertical")
        .check([&grain] { parse_grain(grain); });
}

std::optional<double> parse_grain(const std::string &text) {
    if (text.empty())
        return std::nullopt;
    if (text == "vertical")
        return 0.0;
    if (text == "horizontal")
        return 0.5 * std::numbers::pi;
    double degrees = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
    if (error != std::errc{} || stop != text.data() + text.size() || !(std::abs(degrees) <= 360))
        throw Error({"'" + text + "' is no direction of the warp", "--grain",
                     "expected vertical, horizontal, or degrees from the vertical"});
    return degrees * kDegree;
}

} // namespace tsuya::program
