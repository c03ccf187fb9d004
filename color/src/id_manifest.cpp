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
            text += c == '\\' ? escaped() : c;
        return text;
    }
    /// Of the escapes that have a letter, those of control characters are shown as a blank.
    char escaped() {
        const char c = next();
        if (c == 'u')
            for (int i = 0; i < 4; ++i)
                next();
        return c == '"' || c == '\\' || c == '/' ? c : ' ';
    }
    std::uint32_t number(const std::string &hex) const {
        std::uint32_t value = 0;
        const char *const end = hex.data() + hex.size();
        if (const auto [rest, error] = std::from_chars(hex.data(), end, value, 16);
            error != std::errc{} || rest != end)
            fail();
        return value;
    }

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
