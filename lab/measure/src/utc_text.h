#pragma once
/// \file
/// Times as text.

#include <ctime>
#include <string>

namespace tsuya::lab {

/// A time in UTC, in a format of strftime.
/// \param time_s seconds since 1970
inline std::string utc_text(double time_s, const char *format) {
    const auto seconds = static_cast<std::time_t>(time_s);
    std::tm utc{};
    gmtime_r(&seconds, &utc);
    char text[32];
    std::strftime(text, sizeof text, format, &utc);
    return text;
}

} // namespace tsuya::lab
