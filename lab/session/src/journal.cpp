#include "tsuya/lab/journal.h"

#include "json_line.h"
#include "tsuya/sdk/file.h"

#include <array>
#include <cstdio>
#include <limits>

namespace tsuya::lab {
namespace {

const std::vector<std::string> kKinds{"session", "move",   "arrived", "open",  "close", "file",
                                      "ok",      "reject", "lamp",    "fault", "note"};
constexpr std::string_view kCrcKey = ",\"crc\":\"";
constexpr std::size_t kCrcEnd = 8 + 2; // digits, quote, brace

// [CRC] 3.2.9, bits reflected: as in gzip and zip.
constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t value = i;
        for (int bit = 0; bit < 8; ++bit)
            value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320u : 0u);
        table[i] = value;
    }
    return table;
}

std::string crc_of(std::string_view bytes) {
    static constexpr auto kTable = crc_table();
    std::uint32_t crc = 0xFFFFFFFFu;
    for (const char byte : bytes)
        crc = (crc >> 8) ^ kTable[(crc ^ static_cast<unsigned char>(byte)) & 0xFFu];
    char text[9];
    std::snprintf(text, sizeof text, "%08x", ~crc);
    return text;
}

void check_crc(std::string_view line, const std::string &where) {
    const std::size_t at = line.rfind(kCrcKey);
    if (at == std::string_view::npos || line.size() != at + kCrcKey.size() + kCrcEnd ||
        line.substr(at + kCrcKey.size(), 8) != crc_of(line.substr(0, at)))
        throw Error(
            {"the checksum of the line is wrong", where, "expected the journal as it was written"});
}

JournalEvent event_of(JsonLine line) {
    constexpr double kMost = std::numeric_limits<double>::max();
    JournalEvent event{.seq = line.count("seq"), .time_s = line.number("time_s", 0, kMost)};
    event.kind = static_cast<EventKind>(line.choice("kind", kKinds));
    if (line.has("frame"))
        event.frame = line.count("frame");
    line.text("crc");
    for (const auto &[key, value] : line.rest().items()) {
        if (value.is_string())
            event.texts[key] = value.get<std::string>();
        else if (value.is_number())
            event.numbers[key] = value.get<double>();
        else
            line.fail("'" + key + "' is neither text nor number");
    }
    return event;
}

} // namespace

const char *name_of(EventKind kind) { return kKinds[static_cast<std::size_t>(kind)].c_str(); }

std::string JournalEvent::text(const std::string &key) const {
    const auto at = texts.find(key);
    return at == texts.end() ? "" : at->second;
}

double JournalEvent::number(const std::string &key) const {
    const auto at = numbers.find(key);
    return at == numbers.end() ? 0 : at->second;
}

std::string journal_line(const JournalEvent &event) {
    JsonTree tree{{"seq", event.seq}, {"time_s", event.time_s}, {"kind", name_of(event.kind)}};
    if (event.frame)
        tree["frame"] = *event.frame;
    for (const auto &[key, value] : event.texts)
        tree[key] = value;
    for (const auto &[key, value] : event.numbers)
        tree[key] = value;
    // Names of files may be in any encoding.
    std::string line = tree.dump(-1, ' ', false, JsonTree::error_handler_t::replace);
    line.pop_back();
    return line + std::string(kCrcKey) + crc_of(line) + "\"}";
}

Journal read_journal(const std::filesystem::path &file) {
    const std::string text = read_file(file);
    const TextLines lines = lines_of(text);
    Journal journal{.whole_bytes = text.size() - lines.rest.size(), .torn = !lines.rest.empty()};
    for (const std::string_view line : lines.whole) {
        const std::string where = file.string() + ":" + std::to_string(journal.events.size() + 1);
        check_crc(line, where);
        journal.events.push_back(event_of({line, where}));
        if (journal.events.back().seq != journal.events.size() - 1)
            throw Error({"the line has seq " + std::to_string(journal.events.back().seq), where,
                         "expected " + std::to_string(journal.events.size() - 1)});
    }
    return journal;
}

} // namespace tsuya::lab
