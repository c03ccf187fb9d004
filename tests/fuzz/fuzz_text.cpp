// Text from any bytes: UTF-8 that is the same in blocks of any size, or an Error.

#include <cstdint>
#include <cstdlib>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace {

std::string decoded(std::string_view bytes, std::size_t step) {
    tsuya::TextDecoder decoder("fuzz");
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += step)
        decoder.decode(bytes.substr(at, step), text);
    decoder.finish(text);
    return text;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
    using namespace tsuya;
    const std::string_view bytes(reinterpret_cast<const char *>(data), size);
    try {
        const std::string text = decode_text(bytes, "fuzz");
        if (text.find('\r') != text.npos || decoded(bytes, 1) != text || decoded(bytes, 7) != text)
            std::abort();
        // What was decoded is UTF-8. A mark in front keeps a second mark from being taken off.
        if (decode_text("\xEF\xBB\xBF" + text, "fuzz", OddBytes::refuse) != text)
            std::abort();
    } catch (const Error &error) {
        if (error.problems().at(0).what != "the text is UTF-32")
            std::abort();
    }
    return 0;
}
