#pragma once
/// \file
/// The header of a PLY file: which rows of which numbers follow.

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya::garment {

enum class PlyFormat { text, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one number in a binary file.
std::size_t ply_bytes(PlyType type);

/// One number of a row, or a list of them.
struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> length{}; ///< of a list: the type of its length
};

/// A table of the file.
struct PlyElement {
    std::string name;
    std::uint64_t rows = 0;
    std::vector<PlyProperty> properties{};
    std::string where{}; ///< `file:line` of its declaration

    /// Number of the property of this name.
    std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::text;
    std::vector<PlyElement> elements{};
    std::map<std::uint32_t, std::string> panel_name{}; ///< of `comment panel NUMBER NAME`
    std::size_t lines = 0;
};

/// Parses the decoded lines from `ply` to `end_header`. Throws Error with `name:line`.
PlyHeader parse_ply_header(std::string_view text, const std::string &name);

/// Holds the declared rows against the bytes that follow the header. Throws Error.
void check_ply_counts(const PlyHeader &header, std::uint64_t body_bytes);

} // namespace tsuya::garment
