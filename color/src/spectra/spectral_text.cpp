#include "spectra/spectral_text.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <sstream>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

using detail::DecimalReader;
using detail::DelimitedField;
using Fields = std::vector<DelimitedField>;

constexpr const char *kRows = "expected rows of wavelength_nm,value";
constexpr std::size_t kFewestWavelengths = 5; // of a line of wavelengths

struct Line {
    std::size_t number = 0;
    std::string_view text{};
};

/// A number, or what was meant as one: neither a word, a date nor a time.
bool begins_like_number(std::string_view text) {
    const std::size_t sign = text.starts_with('-') || text.starts_with('+') ? 1 : 0;
    if (text.size() <= sign || text.find_first_of(":/") != text.npos)
        return false;
    if (const std::size_t minus = text.find('-', 1);
        minus != text.npos && text[minus - 1] != 'e' && text[minus - 1] != 'E')
        return false;
    return std::isdigit(static_cast<unsigned char>(text[sign])) || text[sign] == '.';
}

bool is_number(const DelimitedField &field) { return DecimalReader().read(field.text).has_value(); }

Fields without_empty_end(Fields fields) {
    while (!fields.empty() && fields.back().text.empty())
        fields.pop_back();
    return fields;
}

/// Fields of a line of samples: all that name a wavelength, which rise or fall.
std::vector<std::size_t> wavelength_fields(const Fields &fields) {
    std::vector<std::size_t> found;
    std::vector<double> nm;
    for (std::size_t i = 0; i < fields.size(); ++i)
        if (const auto wavelength = wavelength_in_name(fields[i].text)) {
            found.push_back(i);
            nm.push_back(*wavelength);
        }
    const bool ordered = std::ranges::is_sorted(nm, std::less_equal<>()) ||
                         std::ranges::is_sorted(nm, std::greater_equal<>());
    return found.size() >= kFewestWavelengths && ordered ? found : std::vector<std::size_t>{};
}

bool all_numbers(const Fields &fields) {
    return fields.size() >= 2 && std::ranges::all_of(fields, [](const DelimitedField &field) {
               return field.text.empty() || is_number(field);
           });
}

bool names_wavelength(std::string_view name) {
    const std::string plain = plain_name(name);
    return plain == "nm" || plain == "wl" || plain == "lambda" || name.find("\xCE\xBB") == 0 ||
           plain.starts_with("lambda") || plain.starts_with("wavelen") ||
           plain.starts_with("wellenl");
}

/// Nanometres of a unit that a header names; 1 where it names none.
double unit_in_name(std::string_view name) {
    if (name.find("\xC2\xB5m") != name.npos || name.find("\xCE\xBCm") != name.npos)
        return 1000;
    if (name.find("\xC3\x85") != name.npos)
        return 0.1;
    std::string word;
    for (const char c : std::string(name) + ' ')
        if (std::isalpha(static_cast<unsigned char>(c))) {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        } else {
            if (word == "um" || word.starts_with("micro"))
                return 1000;
            if (word.starts_with("angstrom"))
                return 0.1;
            word.clear();
        }
    return 1;
}

class TextReader {
  public:
    TextReader(std::string_view text, std::string name) : name_(std::move(name)) {
        std::size_t number = 0;
        for (std::size_t begin = 0; begin < text.size();) {
            const std::size_t end = std::min(text.find('\n', begin), text.size());
            const std::string_view line = text.substr(begin, end - begin);
            const std::string_view content = detail::without_blanks(line);
            ++number;
            if (!content.empty() && content.front() != '#')
                lines_.push_back({number, line});
            begin = end + 1;
        }
    }

    SpectrumFile read() {
        for (std::size_t first = 0; first < lines_.size(); ++first)
            for (const char separator : {';', '\t', ',', ' '}) {
                const Fields fields = fields_of(lines_[first], separator);
                if (const auto at = wavelength_fields(fields);
                    !at.empty() && first + 1 < lines_.size() && !rises_in_rows(first, separator)) {
                    separator_ = separator;
                    read_samples(first, fields, at);
                    return finish();
                }
                if (all_numbers(fields) || is_below_header(first, fields, separator)) {
                    separator_ = separator;
                    read_columns(first, fields.size());
                    return finish();
                }
            }
        if (problems_.empty())
            problems_.add({"the file holds no spectrum", name_, kRows});
        return finish();
    }

  private:
    static Fields fields_of(const Line &line, char separator) {
        return without_empty_end(detail::split_fields(line.text, separator));
    }

    /// The line is a row of many columns, like the next, and no line of wavelengths.
    bool rises_in_rows(std::size_t line, char separator) const {
        const Fields now = fields_of(lines_[line], separator),
                     next = fields_of(lines_[line + 1], separator);
        return all_numbers(now) && all_numbers(next) &&
               wavelength_fields(next).size() == next.size();
    }

    /// A row with words beside the numbers, right below a line that names the wavelengths.
    bool is_below_header(std::size_t line, const Fields &fields, char separator) const {
        if (line == 0 || std::ranges::count_if(fields, is_number) < 2)
            return false;
        const Fields names = fields_of(lines_[line - 1], separator);
        for (std::size_t i = 0; i < names.size() && names.size() == fields.size(); ++i)
            if (names_wavelength(names[i].text) && is_number(fields[i]))
                return true;
        return false;
    }

    SpectrumFile finish() {
        problems_.throw_if_any();
        return std::move(file_);
    }

    /// The last line that may hold values: behind it no field begins like a number.
    std::size_t end_of_values(std::size_t first) const {
        std::size_t end = lines_.size();
        while (end > first + 1 && std::ranges::none_of(fields_of(lines_[end - 1], separator_),
                                                       [](const DelimitedField &field) {
                                                           return begins_like_number(field.text);
                                                       }))
            --end;
        return end;
    }

    /// Header lines stand right before the values and have as many fields.
    std::vector<Fields> header_lines(std::size_t first, std::size_t count) {
        std::vector<Fields> headers;
        for (std::size_t i = 0; i < first; ++i) {
            Fields fields = fields_of(lines_[i], separator_);
            if (fields.size() != count) {
                headers.clear();
            } else if (begins_like_number(fields.front().text)) {
                for (const DelimitedField &field : fields)
                    number_at(lines_[i], field);
            } else {
                headers.push_back(std::move(fields));
            }
        }
        return headers;
    }

    void read_columns(std::size_t first, std::size_t count) {
        const std::vector<Fields> headers = header_lines(first, count);
        std::size_t wavelengths = 0;
        double unit_nm = 1;
        for (const Fields &header : headers)
            for (std::size_t i = count; i-- > 0;)
                if (names_wavelength(header[i].text))
                    wavelengths = i;
        for (const Fields &header : headers)
            if (const double unit = unit_in_name(header[wavelengths].text); unit != 1)
                unit_nm = unit;
        const Fields values = fields_of(lines_[first], separator_);
        std::vector<std::size_t> columns;
        for (std::size_t i = 0; i < count; ++i)
            if (i != wavelengths && is_number(values[i])) {
                columns.push_back(i);
                file_.samples.push_back({.name = column_name(headers, i)});
                for (const Fields &header : headers)
                    file_.samples.back().percent |= header[i].text.find('%') != std::string::npos;
            }
        const std::size_t end = end_of_values(first);
        for (std::size_t i = first; i < end && !problems_.full(); ++i)
            read_row(lines_[i], wavelengths, columns, count, unit_nm);
    }

    std::string column_name(const std::vector<Fields> &headers, std::size_t column) const {
        for (const Fields &header : headers)
            if (const std::string &name = header[column].text; !name.empty() && taken(name).empty())
                return name;
        return std::to_string(column + 1);
    }

    std::string taken(const std::string &name) const {
        for (const SpectrumSample &sample : file_.samples)
            if (plain_name(sample.name) == plain_name(name))
                return sample.name;
        return {};
    }

    void read_row(const Line &line, std::size_t wavelengths,
                  const std::vector<std::size_t> &columns, std::size_t count, double unit_nm) {
        const Fields fields = fields_of(line, separator_);
        const std::size_t needed = std::max(wavelengths, columns.back()) + 1;
        if (fields.size() < needed || fields.size() > count) {
            add(line, 1, "the row has " + detail::counted(fields.size(), "column"),
                "expected " + detail::counted(count, "column") + " as in the rows before it");
            return;
        }
        const auto nm = number_at(line, fields[wavelengths]);
        std::vector<std::optional<double>> values;
        for (const std::size_t column : columns)
            values.push_back(number_at(line, fields[column]));
        if (!nm || std::ranges::any_of(values, [](const auto &value) { return !value; }) ||
            !check_order(line, fields[wavelengths].column, *nm * unit_nm))
            return;
        for (std::size_t i = 0; i < columns.size(); ++i)
            add_value(file_.samples[i], *nm * unit_nm, *values[i],
                      place(line, fields[columns[i]].column));
    }

    /// Wavelengths rise or fall, as the first two say.
    bool check_order(const Line &line, std::size_t column, double nm) {
        if (!(nm > 0)) {
            add(line, column, "the wavelength is " + number_text(nm) + " nm",
                "expected a wavelength greater than 0");
            return false;
        }
        if (last_nm_ > 0) {
            if (direction_ == 0)
                direction_ = nm < last_nm_ ? -1 : 1;
            if (!((nm - last_nm_) * direction_ > 0)) {
                add(line, column,
                    "the wavelength " + number_text(nm) + " nm does not " +
                        (direction_ > 0 ? "increase" : "decrease"),
                    std::string("expected ") + (direction_ > 0 ? "more" : "less") + " than " +
                        number_text(last_nm_));
                return false;
            }
        }
        last_nm_ = nm;
        return true;
    }

    void read_samples(std::size_t header, const Fields &names, const std::vector<std::size_t> &at) {
        const bool percent = std::ranges::any_of(names, [](const DelimitedField &field) {
            return field.text.find('%') != std::string::npos;
        });
        const std::size_t end = end_of_values(header);
        for (std::size_t i = header + 1; i < end && !problems_.full(); ++i) {
            const Fields fields = fields_of(lines_[i], separator_);
            if (fields.size() <= at.back()) {
                add(lines_[i], 1, "the row has " + detail::counted(fields.size(), "column"),
                    "expected " + detail::counted(names.size(), "column") +
                        " as in the line of wavelengths");
                continue;
            }
            SpectrumSample sample{
                .name = sample_name(names, fields, at), .percent = percent, .in_row = true};
            for (const std::size_t column : at)
                if (const auto value = number_at(lines_[i], fields[column]))
                    add_value(sample, *wavelength_in_name(names[column].text), *value,
                              place(lines_[i], fields[column].column));
            file_.samples.push_back(std::move(sample));
        }
        if (file_.samples.empty())
            problems_.add({"the file holds no spectrum", name_,
                           "expected a row of values below the line of wavelengths"});
    }

    /// What stands in the column `name`, else in the first that is none of the values.
    std::string sample_name(const Fields &names, const Fields &fields,
                            const std::vector<std::size_t> &at) const {
        std::string name;
        for (std::size_t i = names.size(); i-- > 0;)
            if (std::ranges::find(at, i) == at.end() && !fields[i].text.empty()) {
                const std::string key = plain_name(names[i].text);
                if (name.empty() || i == 0 || key.ends_with("name") || key.ends_with("id"))
                    name = fields[i].text;
                if (key.ends_with("name"))
                    break;
            }
        return name.empty() || !taken(name).empty() ? std::to_string(file_.samples.size() + 1)
                                                    : name;
    }

    static void add_value(SpectrumSample &sample, double nm, double value, std::string where) {
        sample.spectrum.wavelength_nm.push_back(nm);
        sample.spectrum.value.push_back(value);
        sample.where.push_back(std::move(where));
    }

    std::optional<double> number_at(const Line &line, const DelimitedField &field) {
        const auto value = decimals_.read(field.text);
        if (!value)
            add(line, field.column,
                decimals_.mixed()
                    ? "'" + field.text + "' has another decimal mark than the numbers before it"
                    : "'" + field.text + "' is not a number",
                "expected a finite number such as 560 or 0.25");
        return value;
    }

    std::string place(const Line &line, std::size_t column) const {
        return name_ + ':' + std::to_string(line.number) + ':' + std::to_string(column);
    }

    void add(const Line &line, std::size_t column, std::string what, std::string accepted) {
        problems_.add({std::move(what), place(line, column), std::move(accepted)});
    }

    std::string name_;
    std::vector<Line> lines_{};
    char separator_ = ',';
    double last_nm_ = 0, direction_ = 0;
    DecimalReader decimals_{};
    SpectrumFile file_{};
    Problems problems_{};
};

} // namespace

std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : name)
        if (std::isalnum(static_cast<unsigned char>(c)))
            plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return plain;
}

std::string number_text(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

std::optional<double> wavelength_in_name(std::string_view name) {
    const std::size_t begin = name.find_first_of("0123456789");
    if (begin == name.npos)
        return std::nullopt;
    const std::string_view before = name.substr(0, begin);
    double nm = 0;
    const auto [end, code] = std::from_chars(name.data() + begin, name.data() + name.size(), nm);
    const std::string after = plain_name(name.substr(static_cast<std::size_t>(end - name.data())));
    const bool letters =
        std::ranges::none_of(before, [](char c) { return c == '-' || c == '.' || c == '+'; });
    constexpr double kShortest = 100, kLongest = 4000;
    return code == std::errc{} && letters && (after.empty() || after == "nm") && nm >= kShortest &&
                   nm <= kLongest
               ? std::optional(nm)
               : std::nullopt;
}

void sort_rising(SpectrumSample &sample) {
    std::vector<double> &nm = sample.spectrum.wavelength_nm;
    if (nm.size() < 2 || nm.front() < nm.back())
        return;
    std::ranges::reverse(nm);
    std::ranges::reverse(sample.spectrum.value);
    std::ranges::reverse(sample.where);
}

SpectrumFile parse_spectral_text(std::string_view text, const std::string &name) {
    return TextReader(text, name).read();
}

} // namespace tsuya
