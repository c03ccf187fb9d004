#include "tsuya/sdk/reflectance_file.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "table_columns.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

constexpr double kVanishing = 1e-30;        // 1/sr: no instrument tells it from 0
constexpr double kNoiseSigmas = 5;          // as in check_table
constexpr double kNoiseOfPeak = 0.1;        // of values without a standard error
constexpr double kNoiseOfRows = 0.25;       // that may lie below 0 then
constexpr double kRoundedRightAngle = 1e-3; // degrees: pi/2 as 1.5708

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char &c : lower)
        c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return lower;
}

// A value as its file has it, with the place of it.
struct ReadValue {
    double value = 0, sigma = 0;
    std::size_t line = 0, column = 0;
    std::string text{};
};

class TableReader {
  public:
    TableReader(std::string_view text, std::string name) : name_(std::move(name)), text_(text) {
        frame_.symmetry_declared = false;
    }

    ReflectanceFile read() {
        for (std::string_view rest = text_; !rest.empty() && !problems_.full();) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
            ++line_;
            read_line(line);
        }
        line_ = std::max<std::size_t>(line_, 1); // an empty file has a first line too
        if (problems_.empty() && frame_.rows.empty())
            problem("the table has no row", 1, accepted_columns());
        if (problems_.empty())
            check_units();
        for (std::size_t c = 0; c < columns_.values.size() && problems_.empty(); ++c)
            add_channel(columns_.values[c], values_[c]);
        problems_.throw_if_any();
        if (!columns_.unused.empty())
            file_.warnings.push_back("columns that are not used: " + unused());
        return std::move(file_);
    }

  private:
    void read_line(std::string_view line) {
        const std::string_view content = detail::without_blanks(line);
        if (content.starts_with('#') || content.starts_with("\"#"))
            read_key(content);
        else if (content.find_first_not_of(";,\t ") == content.npos ||
                 (!seen_header_ && read_separator(content)))
            return;
        else if (!seen_header_)
            read_header_line(line);
        else
            read_row(detail::split_fields(line, separator_), line);
    }

    // `sep=;`, which spreadsheets put first.
    bool read_separator(std::string_view content) {
        constexpr std::string_view kSeparator = "sep=";
        if (content.size() > kSeparator.size() + 1 || !content.starts_with(kSeparator))
            return false;
        given_separator_ = content.size() > kSeparator.size() ? content.back() : '\t';
        return true;
    }

    // A spreadsheet may put the comment in quotes and fill the line up with separators.
    void read_key(std::string_view content) {
        std::string comment(content);
        if (content.starts_with('"'))
            comment = detail::split_fields(content, ';').front().text;
        comment.resize(comment.find_last_not_of(";,\t ") + 1);
        const std::string_view entry = detail::without_blanks(std::string_view(comment).substr(1));
        const auto colon = entry.find(':');
        if (colon == entry.npos)
            return;
        const std::string key(detail::without_blanks(entry.substr(0, colon)));
        const std::string value(detail::without_blanks(entry.substr(colon + 1)));
        if (lower_case(key) == "symmetry")
            read_symmetry(value);
        else
            frame_.keys[key] = value;
    }

    void read_symmetry(const std::string &value) {
        std::string name = lower_case(value);
        std::replace_if(
            name.begin(), name.end(), [](char c) { return c == '_' || c == ' '; }, '-');
        if (const auto symmetry = symmetry_named(name)) {
            if (frame_.symmetry_declared && frame_.symmetry != *symmetry)
                problem("the symmetry is '" + value + "', and another one above", 1,
                        "expected one symmetry");
            frame_.symmetry = *symmetry;
            frame_.symmetry_declared = true;
        } else {
            problem("unknown symmetry '" + value + "'", 1, accepted_names(name, symmetry_names()));
        }
    }

    void read_header_line(std::string_view line) {
        seen_header_ = true;
        header_line_ = line_;
        separator_ = given_separator_ ? given_separator_ : detail::find_separator(line);
        const std::vector<detail::DelimitedField> fields = detail::split_fields(line, separator_);
        HeaderReading header = read_header(fields);
        columns_ = std::move(header.columns);
        names_ = fields;
        values_.resize(columns_.values.size());
        const bool numbers = std::ranges::all_of(fields, [](const detail::DelimitedField &field) {
            return field.text.empty() || detail::DecimalReader().read(field.text);
        });
        if (numbers)
            problem("the first line is no header line but numbers", 1, accepted_columns());
        else if (!header.problem.empty())
            problem(header.problem, 1, accepted_columns());
        bad_header_ = numbers || !header.problem.empty();
    }

    void read_row(const std::vector<detail::DelimitedField> &fields, std::string_view line) {
        if (bad_header_)
            return;
        const std::string count = detail::counted(names_.size(), "column");
        if (fields.size() < columns_.needed())
            return problem("the row has fewer than " + count, line.size() + 1,
                           "expected as many as the header line");
        for (std::size_t i = names_.size(); i < fields.size(); ++i)
            if (!fields[i].text.empty())
                return problem("the row has more than " + count, fields[i].column,
                               "expected as many as the header line; decimals after a comma need "
                               "columns parted by ';'");
        ReflectanceRow row;
        if (read_angles(fields, row) && read_values(fields))
            frame_.rows.push_back(row);
    }

    bool read_angles(const std::vector<detail::DelimitedField> &fields, ReflectanceRow &row) {
        const std::array<double *, 4> places = {&row.theta_i, &row.phi_i, &row.theta_r, &row.phi_r};
        for (std::size_t i = 0; i < places.size(); ++i) {
            const AngleColumn &column = columns_.angle[i];
            const detail::DelimitedField &field = fields[column.field];
            const auto v = number(field, column.field);
            if (!v)
                return false;
            const bool from_normal = i % 2 == 0, radians = column.unit == 1;
            const double degrees = *v * column.unit / kDegree;
            const double slack = radians ? kRoundedRightAngle : 0;
            const std::string shown = names_[column.field].text + " is '" + field.text + "'";
            if (from_normal ? !(degrees >= 0 && degrees <= 90 + slack)
                            : !(std::abs(degrees) <= 360 + slack)) {
                problem(shown, field.column,
                        from_normal ? "expected an angle from the normal of 0 to 90 degrees"
                                    : "expected an angle from the weft of -360 to 360 degrees");
                return false;
            }
            *places[i] = from_normal ? std::min(*v * column.unit, kPi / 2) : *v * column.unit;
        }
        return true;
    }

    bool read_values(const std::vector<detail::DelimitedField> &fields) {
        for (std::size_t c = 0; c < columns_.values.size(); ++c) {
            const ValueColumn &column = columns_.values[c];
            const detail::DelimitedField &field = fields[*column.value];
            const auto v = number(field, *column.value);
            const auto sigma = v && column.sigma
                                   ? standard_error(fields[*column.sigma], *column.sigma)
                                   : std::optional(0.0);
            if (!v || !sigma)
                return false;
            values_[c].push_back({*v, *sigma, line_, field.column, *v < 0 ? field.text : ""});
        }
        return true;
    }

    // 0 where the field is empty.
    std::optional<double> standard_error(const detail::DelimitedField &field, std::size_t column) {
        const auto value = field.text.empty() ? std::optional(0.0) : number(field, column);
        if (!value || *value >= 0)
            return value;
        problem(names_[column].text + " is '" + field.text + "'", field.column,
                "expected a number not below 0");
        return std::nullopt;
    }

    std::optional<double> number(const detail::DelimitedField &field, std::size_t column) {
        const auto value = decimals_.read(field.text);
        if (!value)
            problem(names_[column].text + " is '" + field.text + "'", field.column,
                    decimals_.mixed() ? "expected decimals after a point or after a comma, not both"
                                      : "expected a finite number");
        return value;
    }

    // Degrees that are nowhere above 90 degrees in radians.
    void check_units() {
        constexpr double kRightAngle = 1.5709, kTurn = 6.2833, kSomeTurn = 0.3;
        double theta = 0, phi = 0;
        for (const ReflectanceRow &row : frame_.rows) {
            theta = std::max({theta, row.theta_i / kDegree, row.theta_r / kDegree});
            phi = std::max({phi, std::abs(row.phi_i) / kDegree, std::abs(row.phi_r) / kDegree});
        }
        const bool small = columns_.in_degrees() && theta > kSomeTurn && theta <= kRightAngle;
        if (!small || phi > kTurn)
            return;
        const std::string what = "no direction is farther than 1.571 from the normal and 6.283 "
                                 "from the weft, as in radians";
        if (phi < kSomeTurn)
            return file_.warnings.push_back(what);
        problems_.add({what, name_ + ":" + std::to_string(header_line_) + ":1",
                       "expected degrees, or the columns theta_i_rad, phi_i_rad, theta_r_rad and "
                       "phi_r_rad"});
    }

    void add_channel(const ValueColumn &column, const std::vector<ReadValue> &values) {
        TableChannel channel{column.channel, column.wavelength_nm, frame_};
        const std::string of = column.channel.empty() ? "" : " of channel " + column.channel;
        double peak = 0;
        for (const ReadValue &v : values)
            peak = std::max(peak, v.value);
        const auto negative = static_cast<std::size_t>(
            std::ranges::count_if(values, [](const ReadValue &v) { return v.value < 0; }));
        const bool few =
            static_cast<double>(negative) <= kNoiseOfRows * static_cast<double>(values.size());
        std::size_t vanishing = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const ReadValue &v = values[i];
            const double noise = v.sigma > 0 ? kNoiseSigmas * v.sigma
                                 : few       ? kNoiseOfPeak * peak
                                             : 0;
            if (v.value < -noise)
                refuse_negative(column, v);
            const bool vanishes = v.value > 0 && v.value < kVanishing;
            vanishing += vanishes;
            channel.table.rows[i].brdf_per_sr = vanishes ? 0 : std::max(v.value, 0.0);
            channel.table.rows[i].sigma_per_sr = v.sigma;
        }
        if (negative > 0)
            file_.warnings.push_back(detail::counted(negative, "value") + " below 0" + of +
                                     " within noise count as 0");
        if (vanishing > 0)
            file_.warnings.push_back(detail::counted(vanishing, "value") + " below 1e-30 per sr" +
                                     of + " count as 0");
        if (peak < kVanishing)
            file_.warnings.push_back("all values" + of + " are 0: the cloth is black");
        file_.channels.push_back(std::move(channel));
    }

    void refuse_negative(const ValueColumn &column, const ReadValue &v) {
        problems_.add({names_[*column.value].text + " is '" + v.text + "'",
                       name_ + ":" + std::to_string(v.line) + ":" + std::to_string(v.column),
                       "expected a number not below 0, but for noise: within 5 standard errors, or "
                       "10 % of the largest value in up to a quarter of the rows"});
    }

    std::string unused() const {
        std::string names;
        for (const std::string &name : columns_.unused)
            names += (names.empty() ? "" : ", ") + name;
        return names;
    }

    void problem(std::string what, std::size_t column, std::string accepted) {
        problems_.add({std::move(what),
                       name_ + ":" + std::to_string(line_) + ":" + std::to_string(column),
                       std::move(accepted)});
    }

    std::string name_;
    std::string_view text_;
    ReflectanceFile file_{};
    ReflectanceTable frame_{}; // keys, symmetry and directions of all channels
    TableColumns columns_{};
    std::vector<detail::DelimitedField> names_{};  // of the header line
    std::vector<std::vector<ReadValue>> values_{}; // of each channel
    detail::DecimalReader decimals_{};
    Problems problems_{};
    std::size_t line_ = 0, header_line_ = 0;
    char separator_ = ',', given_separator_ = 0;
    bool seen_header_ = false, bad_header_ = false;
};

} // namespace

ReflectanceFile parse_reflectance_file(std::string_view text, const std::string &name) {
    return TableReader(text, name).read();
}

ReflectanceFile read_reflectance_file(const std::filesystem::path &file) {
    return parse_reflectance_file(read_text(file), file.string());
}

void check_single_channel(const ReflectanceFile &file, const std::string &where) {
    if (file.channels.size() > 1)
        throw Error({"the table has " + std::to_string(file.channels.size()) + " channels", where,
                     "expected one column of values, brdf_per_sr"});
}

ReflectanceTable read_reflectance_table(const std::filesystem::path &file) {
    ReflectanceFile read = read_reflectance_file(file);
    check_single_channel(read, file.string());
    return std::move(read.channels.front().table);
}

} // namespace tsuya
