#include "files/ply_rows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "files/declared_count.h"
#include "files/words.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

static_assert(std::endian::native == std::endian::little);

template <typename T> double number_of(const char *bytes) {
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return static_cast<double>(value);
}

double number_of(const char *bytes, PlyType type) {
    switch (type) {
    case PlyType::int8:
        return number_of<std::int8_t>(bytes);
    case PlyType::uint8:
        return number_of<std::uint8_t>(bytes);
    case PlyType::int16:
        return number_of<std::int16_t>(bytes);
    case PlyType::uint16:
        return number_of<std::uint16_t>(bytes);
    case PlyType::int32:
        return number_of<std::int32_t>(bytes);
    case PlyType::uint32:
        return number_of<std::uint32_t>(bytes);
    case PlyType::float32:
        return number_of<float>(bytes);
    default:
        return number_of<double>(bytes);
    }
}

} // namespace

std::string PlyRows::where() const {
    return format_ == PlyFormat::text ? name_ + ":" + std::to_string(line_)
                                      : name_ + ": " + element_ + " " + std::to_string(row_);
}

void PlyRows::refuse_end() const {
    throw Error({"the file ends within '" + element_ + "'", where(),
                 "expected as many rows as the header declares"});
}

void PlyRows::read(const PlyElement &element, std::size_t row) {
    row_ = row;
    if (row == 0) {
        element_ = element.name;
        number_.assign(element.properties.size(), 0.0);
        list_.assign(element.properties.size(), {});
    }
    if (format_ == PlyFormat::text && !element.properties.empty())
        begin_line();
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
        const PlyProperty &property = element.properties[p];
        if (!property.length) {
            number_[p] = take_number(property.type);
            continue;
        }
        list_[p].resize(take_length(property));
        number_[p] = static_cast<double>(list_[p].size());
        for (double &entry : list_[p])
            entry = take_number(property.type);
    }
    if (const std::string_view more = take_word(row_text_); !more.empty())
        throw Error({in_quotes(more) + " follows the numbers of the row", where(),
                     "expected what the header declares for '" + element_ + "'"});
}

void PlyRows::begin_line() {
    do {
        if (rest_.empty())
            refuse_end();
        row_text_ = take_line(rest_);
        ++line_;
    } while (row_text_.find_first_not_of(" \t\r") == std::string_view::npos);
}

double PlyRows::take_text() {
    const std::string_view word = take_word(row_text_);
    if (word.empty())
        throw Error({"a number is missing", where(),
                     "expected what the header declares for '" + element_ + "'"});
    if (const std::optional<double> number = parse_number(word))
        return *number;
    throw Error({in_quotes(word) + " is no number", where(), "expected a number"});
}

double PlyRows::take_number(PlyType type) {
    if (format_ == PlyFormat::text)
        return take_text();
    const std::size_t size = ply_bytes(type);
    if (rest_.size() < size)
        refuse_end();
    char bytes[sizeof(double)];
    std::copy_n(rest_.data(), size, bytes);
    rest_.remove_prefix(size);
    if (format_ == PlyFormat::big_endian)
        std::reverse(bytes, bytes + size);
    return number_of(bytes, type);
}

std::size_t PlyRows::take_length(const PlyProperty &property) {
    const double length = take_number(*property.length);
    const double most =
        format_ == PlyFormat::text
            ? static_cast<double>(row_text_.size())
            : static_cast<double>(rest_.size()) / static_cast<double>(ply_bytes(property.type));
    if (!(length >= 0.0 && length <= most && length == std::floor(length)))
        throw Error({"the list '" + property.name + "' has the length " + number_text(length),
                     where(), "expected no more entries than the file holds"});
    return static_cast<std::size_t>(length);
}

} // namespace tsuya::garment
