#pragma once
// The columns of TABLE.csv, found by their names.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/detail/delimited_text.h"

namespace tsuya {

// theta_i, phi_i, theta_r or phi_r: which field, and radians a unit of it.
struct AngleColumn {
    std::string name{};
    std::size_t field = 0;
    double unit = 0; // 0: the header names none
};

// Values of one channel and their standard errors.
struct ValueColumn {
    std::string channel{}; // empty: the whole reflectance
    std::optional<double> wavelength_nm{};
    std::optional<std::size_t> value{}, sigma{}; // fields
};

struct TableColumns {
    std::array<AngleColumn, 4> angle{{{"theta_i"}, {"phi_i"}, {"theta_r"}, {"phi_r"}}};
    std::vector<ValueColumn> values{};
    std::vector<std::string> unused{}; // names of other columns

    // Fields that a row must have.
    std::size_t needed() const;
    bool in_degrees() const;
};

// What is accepted, in words of a header line.
std::string accepted_columns();

// A header names all columns once. Otherwise `problem` says what is wrong.
struct HeaderReading {
    TableColumns columns{};
    std::string problem{};
};
HeaderReading read_header(const std::vector<detail::DelimitedField> &fields);

} // namespace tsuya
