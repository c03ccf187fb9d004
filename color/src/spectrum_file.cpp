#include "tsuya/color/spectrum_file.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

constexpr std::string_view kBlank = " \t\r";
constexpr const char *kColumns = "expected two columns: wavelength_nm,value";

/// A field with the column, counted from 1, where it begins.
struct Field {
    std::string_view text;
    std::size_t column = 1;
};

std::vector<Field> split(std::string_view line) {
    std::vector<Field> fields;
    for (std::size_t begin = 0; begin <= line.size();) {
        const std::size_t end = std::min(line.find(',', begin), line.size());
        std::string_view text = line.substr(begin, end - begin);
        const std::size_t first = std::min(text.find_first_not_of(kBlank), text.size());
        text.remove_prefix(first);
        text = text.substr(0, text.find_last_not_of(kBlank) + 1);
        fields.push_back({text, begin + first + 1});
        begin = end + 1;
    }
    return fields;
}

std::optional<double> number(std::string_view text) {
    double value = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

std::string as_text(double value) {
    std::ostringstream text;
    text << value;
    return text.str();
}

/// Takes line after line and keeps what is wrong with them.
class Reader {
  public:
    Reader(std::string path, ValueRange range) : path_(std::move(path)), range_(range) {}

    void read(std::string_view line) {
        ++line_;
        const std::size_t first = line.find_first_not_of(kBlank);
        if (first == std::string_view::npos || line[first] == '#')
            return;
        const std::vector<Field> fields = split(line);
        const bool may_be_header = !std::exchange(begun_, true);
        if (may_be_header && fields.size() == 2 && !number(fields[0].text) &&
            !number(fields[1].text) && !fields[0].text.empty())
            return;
        if (fields.size() != 2)
            return add("the row has " + detail::counted(fields.size(), "column"), 1, kColumns);
        const auto wavelength_nm = number(fields[0].text), value = number(fields[1].text);
        if (!wavelength_nm || !value) {
            const Field &bad = wavelength_nm ? fields[1] : fields[0];
            return add("'" + std::string(bad.text) + "' is not a number", bad.column,
                       "expected a finite number such as 560 or 0.25");
        }
        if (!check(*wavelength_nm, fields[0], *value, fields[1]))
            return;
        spectrum_.wavelength_nm.push_back(*wavelength_nm);
        spectrum_.value.push_back(*value);
    }

    Spectrum finish() {
        if (problems_.empty() && spectrum_.value.empty())
            problems_.add({"the file holds no spectrum", path_, kColumns});
        problems_.throw_if_any();
        return std::move(spectrum_);
    }

    bool full() const { return problems_.full(); }

  private:
    bool check(double wavelength_nm, const Field &at, double value, const Field &value_at) {
        const std::size_t before = problems_.all().size();
        if (wavelength_nm <= 0)
            add("the wavelength is " + as_text(wavelength_nm) + " nm", at.column,
                "expected a wavelength greater than 0");
        else if (!spectrum_.wavelength_nm.empty() &&
                 wavelength_nm <= spectrum_.wavelength_nm.back())
            add("the wavelength " + as_text(wavelength_nm) + " nm does not increase", at.column,
                "expected more than " + as_text(spectrum_.wavelength_nm.back()));
        if (value < range_.low || value > range_.high)
            add("the value is " + as_text(value), value_at.column,
                range_.high < ValueRange{}.high
                    ? "expected " + as_text(range_.low) + " to " + as_text(range_.high)
                    : "expected " + as_text(range_.low) + " or more");
        return problems_.all().size() == before;
    }

    void add(std::string what, std::size_t column, std::string accepted) {
        problems_.add({std::move(what),
                       path_ + ':' + std::to_string(line_) + ':' + std::to_string(column),
                       std::move(accepted)});
    }

    std::string path_;
    ValueRange range_;
    std::size_t line_ = 0;
    bool begun_ = false;
    Spectrum spectrum_{{}, {}};
    Problems problems_;
};

} // namespace

Spectrum read_spectrum_csv(const std::filesystem::path &path, const ValueRange &range) {
    const std::string text = read_text(path);
    Reader reader(path.string(), range);
    std::istringstream lines(text);
    for (std::string line; !reader.full() && std::getline(lines, line);)
        reader.read(line);
    return reader.finish();
}

void write_spectrum_csv(const std::filesystem::path &path, const Spectrum &spectrum,
                        const std::string &comment) {
    check_spectrum(spectrum, std::numeric_limits<double>::lowest(), ValueRange{}.high,
                   path.string());
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    std::istringstream lines(comment);
    for (std::string line; std::getline(lines, line);)
        text << "# " << line << '\n';
    text << "wavelength_nm,value\n";
    for (std::size_t i = 0; i < spectrum.value.size(); ++i)
        text << spectrum.wavelength_nm[i] << ',' << spectrum.value[i] << '\n';
    write_file(path, text.str());
}

} // namespace tsuya
