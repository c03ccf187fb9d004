#pragma once
/// \file
/// The rows of a PLY file, one after the other.

#include <string>
#include <string_view>
#include <vector>

#include "files/ply_header.h"

namespace tsuya::garment {

/// Reads rows from text or bytes. A list is as long as the file has room for.
class PlyRows {
  public:
    /// \param body what follows the header \param header must outlive this
    PlyRows(std::string_view body, const PlyHeader &header, std::string name)
        : rest_(body), format_(header.format), line_(header.lines), name_(std::move(name)) {}

    /// Reads the next row. Throws Error with its place if the file has not all of it, or, as text,
    /// more than it.
    void read(const PlyElement &element, std::size_t row);

    /// The number of property `p`; of a list, its length.
    double number(std::size_t p) const { return number_[p]; }
    /// The entries of property `p`, which is a list.
    const std::vector<double> &list(std::size_t p) const { return list_[p]; }
    /// `file:line` of the row, or `file: element N` in a binary file.
    std::string where() const;

  private:
    void begin_line();
    double take_number(PlyType type);
    double take_text();
    std::size_t take_length(const PlyProperty &property);
    [[noreturn]] void refuse_end() const;

    std::string_view rest_, row_text_{};
    PlyFormat format_;
    std::size_t line_, row_ = 0;
    std::string name_, element_{};
    std::vector<double> number_{};
    std::vector<std::vector<double>> list_{};
};

} // namespace tsuya::garment
