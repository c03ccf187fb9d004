#include "id_manifest.h"

#include <charconv>
#include <string_view>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

/// Reads `{"name":"hash",...}`.
class ManifestReader {
  public:
    ManifestReader(std::string_view text, const std::string &layer) : rest_(text), layer_(layer) {}

    std::map<std::uint32_t, std::string> read() {
        std::map<std::uint32_t, std::string> names;
        expect('{');
        if (!accept('}')) {
            do {
                std::string name = string();
                expect(':');
                names[number(string())] = std::move(name);
            } while (accept(','));
            expect('}');
        }
        return names;
    }

  private:
    [[noreturn]] void fail() const {
        throw Error({"the manifest of its ids cannot be read", layer_,
                     "expected an attribute cryptomatte/<key>/manifest such as "
                     "{\"name\":\"0123abcd\"}"});
    }
    bool accept(char c) {
        while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\n'))
            rest_.remove_prefix(1);
        if (rest_.empty() || rest_.front() != c)
            return false;
        rest_.remove_prefix(1);
        return true;
    }
    void expect(char c) {
        if (!accept(c))
            fail();
    }
    char next() {
        if (rest_.empty())
            fail();
        const char c = rest_.front();
        rest_.remove_prefix(1);
        return c;
    }
    std::string string() {
        expect('"');
        std::string text;
        for (char c = next(); c != '"'; c = next())
            if (c == '\\')
                append_escaped(text);
            else
                text += c;
        return text;
    }
    /// Control characters are shown as a blank.
    void append_escaped(std::string &text) {
        const char c = next();
        if (c == 'u')
            append_utf8(text, code_point());
        else
            text += c == '"' || c == '\\' || c == '/' ? c : ' ';
    }
    std::uint32_t code_unit() {
        std::string hex;
        for (int i = 0; i < 4; ++i)
            hex += next();
        return number(hex);
    }
    /// Of `XXXX` after `\u`, or of two that are surrogates; a surrogate alone is U+FFFD.
    std::uint32_t code_point() {
        const std::uint32_t first = code_unit();
        if (first < kHighSurrogate || first > kLastSurrogate)
            return first;
        if (first >= kLowSurrogate || !rest_.starts_with("\\u"))
            return kReplacement;
        const std::string_view after = rest_;
        rest_.remove_prefix(2);
        const std::uint32_t second = code_unit();
        if (second >= kLowSurrogate && second <= kLastSurrogate)
            return 0x10000 + ((first - kHighSurrogate) << 10) + (second - kLowSurrogate);
        rest_ = after;
        return kReplacement;
    }
    static void append_utf8(std::string &text, std::uint32_t code) {
        const auto add = [&](std::uint32_t byte) { text += static_cast<char>(byte); };
        if (code < 0x80)
            return add(code < 0x20 || code == 0x7f ? ' ' : code);
        const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3; // bytes of six bits
        add(((0xff00u >> (more + 1)) & 0xffu) | code >> (6 * more));
        for (int i = more - 1; i >= 0; --i)
            add(0x80 | ((code >> (6 * i)) & 0x3f));
    }
    std::uint32_t number(const std::string &hex) const {
        std::uint32_t value = 0;
        const char *const end = hex.data() + hex.size();
        if (const auto [rest, error] = std::from_chars(hex.data(), end, value, 16);
            error != std::errc{} || rest != end)
            fail();
        return value;
    }

    static constexpr std::uint32_t kHighSurrogate = 0xd800, kLowSurrogate = 0xdc00,
                                   kLastSurrogate = 0xdfff, kReplacement = 0xfffd;

    std::string_view rest_;
    std::string layer_;
};

} // namespace

std::map<std::uint32_t, std::string> id_manifest(const std::map<std::string, std::string> &metadata,
                                                 const std::string &layer) {
    constexpr std::string_view kName = "/name";
    for (const auto &[key, value] : metadata)
        if (key.starts_with("cryptomatte/") && key.ends_with(kName) && value == layer) {
            const auto manifest =
                metadata.find(key.substr(0, key.size() - kName.size()) + "/manifest");
            return ManifestReader(manifest == metadata.end() ? "" : manifest->second, layer).read();
        }
    return ManifestReader("", layer).read();
}

} // namespace tsuya
