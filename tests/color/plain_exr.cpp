#include "color/plain_exr.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <zlib.h>

namespace tsuya::test {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kManyParts = 0x1000, kLongNames = 0x400;

class Bytes {
  public:
    explicit Bytes(const std::string &bytes) : bytes_(bytes) {}

    template <class T> T number() {
        T value{};
        std::memcpy(&value, take(sizeof value).data(), sizeof value);
        return value;
    }
    std::string take(std::size_t size) {
        if (at_ + size > bytes_.size())
            throw std::runtime_error("the file ends too early");
        at_ += size;
        return bytes_.substr(at_ - size, size);
    }
    std::string text() {
        const std::size_t end = bytes_.find('\0', at_);
        if (end == std::string::npos)
            throw std::runtime_error("a name without an end");
        const std::string found = bytes_.substr(at_, end - at_);
        at_ = end + 1;
        return found;
    }
    bool done() const { return at_ == bytes_.size(); }

  private:
    const std::string &bytes_;
    std::size_t at_ = 0;
};

std::array<int, 4> box(const std::string &bytes) {
    std::array<int, 4> box{};
    std::memcpy(box.data(), bytes.data(), sizeof box);
    return box;
}

/// Empty at the end of the headers.
bool read_header(Bytes &in, PlainPart &part) {
    for (std::string name = in.text(); !name.empty(); name = in.text()) {
        part.type[name] = in.text();
        part.attribute[name] = in.take(in.number<std::uint32_t>());
    }
    if (part.attribute.empty())
        return false;
    part.data_window = box(part.attribute.at("dataWindow"));
    part.display_window = box(part.attribute.at("displayWindow"));
    const std::string list = part.attribute.at("channels");
    Bytes channels(list);
    for (std::string name = channels.text(); !name.empty(); name = channels.text()) {
        part.channels.push_back(name);
        part.pixel_type[name] = static_cast<int>(channels.number<std::uint32_t>());
        channels.take(4);
        if (channels.number<std::int32_t>() != 1 || channels.number<std::int32_t>() != 1)
            throw std::runtime_error("a channel of another sampling");
    }
    return true;
}

float from_half(std::uint16_t bits) {
    const int sign = bits >> 15, exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    double value =
        exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
    if (exponent == 31)
        value = mantissa == 0 ? INFINITY : NAN;
    return static_cast<float>(sign ? -value : value);
}

/// ZIP of OpenEXR: deflated differences of the even bytes and then the odd ones.
std::string unpacked(const std::string &packed, std::size_t size) {
    if (packed.size() == size)
        return packed;
    std::string bytes(size, '\0');
    uLongf length = size;
    if (uncompress(reinterpret_cast<Bytef *>(bytes.data()), &length,
                   reinterpret_cast<const Bytef *>(packed.data()), packed.size()) != Z_OK ||
        length != size)
        throw std::runtime_error("a block that is not zlib's");
    for (std::size_t i = 1; i < size; ++i)
        bytes[i] = static_cast<char>(bytes[i - 1] + bytes[i] - 128);
    std::string whole(size, '\0');
    for (std::size_t i = 0; i < size; ++i)
        whole[i] = bytes[i / 2 + (i % 2) * ((size + 1) / 2)];
    return whole;
}

void read_block(Bytes &in, PlainPart &part) {
    const auto [x0, y0, x1, y1] = part.data_window;
    const char compression = part.attribute.at("compression").at(0);
    if (compression != 0 && compression != 3)
        throw std::runtime_error("packed neither by ZIP nor not at all");
    const int rows = compression == 3 ? 16 : 1;
    const int first = in.number<std::int32_t>(), end = std::min(first + rows, y1 + 1);
    const std::string packed = in.take(in.number<std::uint32_t>());
    const auto width = static_cast<std::size_t>(x1 - x0 + 1);
    std::size_t row_size = 0;
    for (const std::string &name : part.channels)
        row_size += width * (part.pixel_type[name] == 1 ? 2 : 4);
    const std::string block = unpacked(packed, row_size * static_cast<std::size_t>(end - first));
    Bytes values(block);
    for (int y = first; y < end; ++y)
        for (const std::string &name : part.channels) {
            float *const row =
                part.values.at(name).data() + static_cast<std::size_t>(y - y0) * width;
            for (std::size_t x = 0; x < width; ++x)
                row[x] = part.pixel_type[name] == 1 ? from_half(values.number<std::uint16_t>())
                                                    : values.number<float>();
        }
}

void append(std::string &out, std::uint32_t value) {
    out.append(reinterpret_cast<const char *>(&value), sizeof value);
}

void append(std::string &out, const std::string &name, const std::string &type,
            const std::string &value) {
    out += name + '\0' + type + '\0';
    append(out, static_cast<std::uint32_t>(value.size()));
    out += value;
}

std::string as_bytes(const std::vector<std::uint32_t> &values) {
    return {reinterpret_cast<const char *>(values.data()), 4 * values.size()};
}

} // namespace

std::string PlainPart::text(const std::string &name) const {
    const auto found = attribute.find(name);
    return found == attribute.end() || type.at(name) != "string" ? "" : found->second;
}

std::vector<float> PlainPart::floats(const std::string &name) const {
    const std::string &bytes = attribute.at(name);
    std::vector<float> numbers(bytes.size() / sizeof(float));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

std::vector<PlainPart> read_plain_exr(const std::string &bytes) {
    Bytes in(bytes);
    if (in.number<std::uint32_t>() != kMagic)
        throw std::runtime_error("no EXR");
    const auto version = in.number<std::uint32_t>();
    const bool many = (version & kManyParts) != 0;
    if ((version & ~(kManyParts | kLongNames)) != 2)
        throw std::runtime_error("another version, tiles or deep data");
    std::vector<PlainPart> parts;
    for (PlainPart part; read_header(in, part); part = {}) {
        parts.push_back(part);
        if (!many)
            break;
    }
    std::size_t blocks = 0;
    for (PlainPart &part : parts) {
        const auto [x0, y0, x1, y1] = part.data_window;
        const int rows = part.attribute.at("compression").at(0) == 3 ? 16 : 1;
        const auto count = static_cast<std::size_t>((y1 - y0 + rows) / rows);
        in.take(8 * count); // where the blocks are: they are read one after the other
        blocks += count;
        for (const std::string &name : part.channels)
            part.values[name].resize(static_cast<std::size_t>(x1 - x0 + 1) *
                                     static_cast<std::size_t>(y1 - y0 + 1));
    }
    for (std::size_t i = 0; i < blocks; ++i)
        read_block(in, parts.at(many ? in.number<std::uint32_t>() : 0));
    if (!in.done())
        throw std::runtime_error("the file goes on");
    return parts;
}

std::map<double, std::string> spectral_channels(const PlainPart &part, const std::string &kind) {
    std::map<double, std::string> found;
    for (const std::string &name : part.channels) {
        const std::string start = kind + '.', unit = "nm";
        if (!name.starts_with(start) || !name.ends_with(unit))
            continue;
        std::string number = name.substr(start.size(), name.size() - start.size() - unit.size());
        if (number.empty() || number.find_first_not_of("0123456789,") != std::string::npos)
            continue;
        std::replace(number.begin(), number.end(), ',', '.');
        found[std::stod(number)] = name;
    }
    return found;
}

std::string plain_exr(int width, int height,
                      const std::map<std::string, std::vector<float>> &channels,
                      const std::map<std::string, std::string> &strings) {
    std::string out, list;
    append(out, kMagic);
    append(out, 2 | kLongNames);
    for (const auto &[name, values] : channels) // alphabetical, as the format asks for
        list += name + '\0' + as_bytes({2, 0, 1, 1});
    append(out, "channels", "chlist", list + '\0');
    append(out, "compression", "compression", std::string(1, '\0'));
    const auto w = static_cast<std::uint32_t>(width), h = static_cast<std::uint32_t>(height);
    for (const char *const window : {"dataWindow", "displayWindow"})
        append(out, window, "box2i", as_bytes({0, 0, w - 1, h - 1}));
    append(out, "lineOrder", "lineOrder", std::string(1, '\0'));
    append(out, "pixelAspectRatio", "float", as_bytes({0x3f800000}));
    append(out, "screenWindowCenter", "v2f", as_bytes({0, 0}));
    append(out, "screenWindowWidth", "float", as_bytes({0x3f800000}));
    for (const auto &[name, value] : strings)
        append(out, name, "string", value);
    out += '\0';
    const std::uint32_t size = 4 * w * static_cast<std::uint32_t>(channels.size());
    std::uint64_t place = out.size() + 8 * std::uint64_t{h};
    for (std::uint32_t y = 0; y < h; ++y, place += 8 + size)
        out.append(reinterpret_cast<const char *>(&place), sizeof place);
    for (std::uint32_t y = 0; y < h; ++y) {
        append(out, y);
        append(out, size);
        for (const auto &[name, values] : channels)
            out.append(reinterpret_cast<const char *>(values.data() + std::size_t{y} * w),
                       4 * std::size_t{w});
    }
    return out;
}

} // namespace tsuya::test
