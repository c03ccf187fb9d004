#include "files/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "files/declared_count.h"
#include "files/words.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

struct TypeName {
    std::string_view name;
    PlyType type;
};
constexpr std::array<TypeName, 16> kTypes{{{"char", PlyType::int8},
                                           {"int8", PlyType::int8},
                                           {"uchar", PlyType::uint8},
                                           {"uint8", PlyType::uint8},
                                           {"short", PlyType::int16},
                                           {"int16", PlyType::int16},
                                           {"ushort", PlyType::uint16},
                                           {"uint16", PlyType::uint16},
                                           {"int", PlyType::int32},
                                           {"int32", PlyType::int32},
                                           {"uint", PlyType::uint32},
                                           {"uint32", PlyType::uint32},
                                           {"float", PlyType::float32},
                                           {"float32", PlyType::float32},
                                           {"double", PlyType::float64},
                                           {"float64", PlyType::float64}}};

PlyType parse_type(std::string_view word, const std::string &where) {
    for (const TypeName &known : kTypes)
        if (known.name == word)
            return known.type;
    throw Error({in_quotes(word) + " is no type of PLY", where,
                 "expected char, uchar, short, ushort, int, uint, float or double"});
}

PlyFormat parse_format(std::string_view word, const std::string &where) {
    if (word == "ascii")
        return PlyFormat::text;
    if (word == "binary_little_endian")
        return PlyFormat::little_endian;
    if (word == "binary_big_endian")
        return PlyFormat::big_endian;
    throw Error({in_quotes(word) + " is no format of PLY", where,
                 "expected ascii, binary_little_endian or binary_big_endian"});
}

PlyProperty parse_property(const std::vector<std::string_view> &words, const std::string &where) {
    if (words.size() == 3)
        return {.name = std::string(words[2]), .type = parse_type(words[1], where)};
    if (words.size() != 5 || words[1] != "list")
        throw Error({"the property is not whole", where,
                     "expected property TYPE NAME, or property list TYPE TYPE NAME"});
    const PlyType length = parse_type(words[2], where);
    if (length == PlyType::float32 || length == PlyType::float64)
        throw Error({"the length of a list is declared as '" + std::string(words[2]) + "'", where,
                     "expected a type of integers"});
    return {.name = std::string(words[4]), .type = parse_type(words[3], where), .length = length};
}

/// `comment panel NUMBER NAME`, as write_ply has it; other comments say nothing.
void note_panel(std::string_view line, PlyHeader &header) {
    take_word(line);
    if (take_word(line) != "panel")
        return;
    const std::string_view word = take_word(line);
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc{} || stop != word.data() + word.size() || line.size() < 2)
        return;
    header.panel_name[number] = std::string(line.substr(1));
}

void parse_line(std::string_view line, const std::string &where, PlyHeader &header) {
    const std::vector<std::string_view> words = words_of(line);
    const std::string_view keyword = words.empty() ? std::string_view() : words[0];
    if (keyword == "comment") {
        note_panel(line, header);
    } else if (keyword == "format" && words.size() >= 2) {
        header.format = parse_format(words[1], where);
    } else if (keyword == "element" && words.size() == 3) {
        header.elements.push_back(
            {.name = std::string(words[1]), .rows = parse_count(words[2], where), .where = where});
    } else if (keyword == "property" && !header.elements.empty()) {
        header.elements.back().properties.push_back(parse_property(words, where));
    } else if (!words.empty() && keyword != "obj_info" && keyword != "end_header") {
        throw Error({"the line is not one of a PLY header", where,
                     "expected format, comment, element NAME COUNT or property"});
    }
}

} // namespace

std::size_t ply_bytes(PlyType type) {
    constexpr std::array<std::size_t, 8> kBytes{1, 1, 2, 2, 4, 4, 4, 8};
    return kBytes.at(static_cast<std::size_t>(type));
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
    for (std::size_t p = 0; p < properties.size(); ++p)
        if (properties[p].name == property)
            return p;
    return std::nullopt;
}

PlyHeader parse_ply_header(std::string_view text, const std::string &name) {
    PlyHeader header;
    take_line(text);
    for (header.lines = 1; !text.empty(); ++header.lines)
        parse_line(take_line(text), name + ":" + std::to_string(header.lines + 1), header);
    return header;
}

void check_ply_counts(const PlyHeader &header, std::uint64_t body_bytes) {
    const bool text = header.format == PlyFormat::text;
    for (const PlyElement &element : header.elements) {
        std::uint64_t row = 0;
        for (const PlyProperty &p : element.properties)
            row += text ? 2 : ply_bytes(p.length.value_or(p.type)); // text: a digit and a blank
        const std::uint64_t last_line_end = text ? 1 : 0;
        check_count(element.rows, std::max<std::uint64_t>(row, 1), body_bytes + last_line_end,
                    element.where);
    }
}

} // namespace tsuya::garment
