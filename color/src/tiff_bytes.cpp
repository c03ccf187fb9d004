#include "tiff_bytes.h"

#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace tsuya {
namespace {

constexpr std::uint32_t kRowsPerStrip = 16;     // what a reader of a few rows has to read
constexpr std::uint32_t kDenominator = 1000000; // of rational numbers

/// How a tag's values are stored.
enum Type : std::uint32_t { kByte = 1, kText = 2, kShort = 3, kLong = 4, kRational = 5 };

using TiffTags = std::map<std::uint32_t, std::string>; // ascending, as the format asks for

/// Puts values behind each other, and makes tags that point to them.
class TiffWriter {
  public:
    TiffWriter() : bytes_("II*\0\0\0\0\0", 8) {}

    std::uint32_t end() const { return static_cast<std::uint32_t>(bytes_.size()); }
    void put(std::uint32_t value, int size) { bytes_ += little(value, size); }

    /// A tag of the picture's own directory.
    void tag(std::uint32_t key, Type type, const std::vector<std::uint32_t> &values) {
        tag(tags_, key, type, values);
    }
    void text(std::uint32_t key, const std::string &words) { text(tags_, key, words); }

    void tag(TiffTags &tags, std::uint32_t key, Type type,
             const std::vector<std::uint32_t> &values) {
        const int size = type == kShort ? 2 : type == kLong || type == kRational ? 4 : 1;
        std::string data;
        for (const std::uint32_t value : values)
            data += little(value, size);
        const auto count = static_cast<std::uint32_t>(values.size()) / (type == kRational ? 2 : 1);
        if (data.size() > 4) {
            const std::uint32_t at = end();
            bytes_ += data + std::string(data.size() % 2, '\0');
            data = little(at, 4);
        }
        data.resize(4);
        tags[key] = little(key, 2) + little(type, 2) + little(count, 4) + data;
    }
    void text(TiffTags &tags, std::uint32_t key, const std::string &words) {
        std::vector<std::uint32_t> letters(words.begin(), words.end());
        letters.push_back(0);
        tag(tags, key, kText, letters);
    }
    void number(TiffTags &tags, std::uint32_t key, double value) {
        tag(tags, key, kRational,
            {static_cast<std::uint32_t>(std::lround(value * kDenominator)), kDenominator});
    }

    /// \return where it stands in the file
    std::uint32_t put_directory(const TiffTags &tags) {
        const std::uint32_t at = end();
        put(static_cast<std::uint32_t>(tags.size()), 2);
        for (const auto &[key, entry] : tags)
            bytes_ += entry;
        put(0, 4);
        return at;
    }

    std::string finish() {
        const std::uint32_t directory = put_directory(tags_);
        return bytes_.replace(4, 4, little(directory, 4));
    }

  private:
    static std::string little(std::uint32_t value, int size) {
        std::string text;
        for (int i = 0; i < size; ++i)
            text += static_cast<char>((value >> (8 * i)) & 255);
        return text;
    }

    std::string bytes_;
    TiffTags tags_{};
};

void put_samples(TiffWriter &file, const Image &image) {
    const auto height = static_cast<std::uint32_t>(image.height);
    const std::size_t row = static_cast<std::size_t>(image.width) * image.channels.size();
    std::vector<std::uint32_t> offsets, sizes;
    for (std::uint32_t y = 0; y < height; y += kRowsPerStrip) {
        const std::size_t rows = std::min(kRowsPerStrip, height - y);
        offsets.push_back(file.end());
        for (std::size_t i = y * row; i < (y + rows) * row; ++i)
            file.put(static_cast<std::uint32_t>(std::lround(image.data[i])), 2);
        sizes.push_back(file.end() - offsets.back());
    }
    const auto channels = static_cast<std::uint32_t>(image.channels.size());
    file.tag(256, kLong, {static_cast<std::uint32_t>(image.width)});
    file.tag(257, kLong, {height});
    file.tag(258, kShort, std::vector<std::uint32_t>(channels, 16)); // bits
    file.tag(259, kShort, {1});                                      // not compressed
    file.tag(262, kShort, {channels == 3 ? 2u : 1u});                // red, green, blue, or grey
    file.tag(273, kLong, offsets);
    file.tag(277, kShort, {channels});
    file.tag(278, kLong, {kRowsPerStrip});
    file.tag(279, kLong, sizes);
}

/// Tags of a directory of their own, as Exif has it.
void put_exposure(TiffWriter &file, const CameraFrame &frame) {
    TiffTags exposure;
    if (frame.exposure_s)
        file.number(exposure, 33434, *frame.exposure_s);
    if (frame.f_number)
        file.number(exposure, 33437, *frame.f_number);
    if (frame.iso)
        file.tag(exposure, 34855, kShort, {static_cast<std::uint32_t>(std::lround(*frame.iso))});
    if (!frame.time.empty())
        file.text(exposure, 36867, frame.time);
    if (!exposure.empty())
        file.tag(34665, kLong, {file.put_directory(exposure)});
}

void put_filters(TiffWriter &file, const std::string &cfa) {
    const std::string colours = "RGB";
    std::vector<std::uint32_t> filters;
    for (const char colour : cfa)
        filters.push_back(static_cast<std::uint32_t>(colours.find(colour)));
    file.text(271, "Tsuya");
    file.text(272, "camera");
    file.text(50708, "Tsuya camera");
    file.tag(254, kLong, {0});
    file.tag(262, kShort, {32803}); // colour filter array
    file.tag(33421, kShort, {2, 2});
    file.tag(33422, kByte, filters);
    file.tag(50706, kByte, {1, 4, 0, 0}); // version 1.4
    file.tag(50710, kByte, {0, 1, 2});
}

} // namespace

std::string tiff_bytes(const CameraFrame &frame) {
    TiffWriter file;
    put_samples(file, frame.image);
    put_exposure(file, frame);
    if (!frame.cfa.empty())
        put_filters(file, frame.cfa);
    return file.finish();
}

} // namespace tsuya
