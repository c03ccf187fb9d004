// QTX and MIF: sections of lines KEY=VALUE.

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

#include "lower_case.h"
#include "spectra/spectral_formats.h"
#include "spectra/spectral_text.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/detail/delimited_text.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

/// Values in percent at even steps, with what is wrong with them.
class Records {
  public:
    explicit Records(std::string name) : name_(std::move(name)) {}

    std::string place(std::size_t line) const { return name_ + ':' + std::to_string(line); }

    void problem(std::size_t line, std::string what, std::string accepted) {
        problems_.add({std::move(what), place(line), std::move(accepted)});
    }

    /// Numbers between separators; those that are none are problems.
    std::vector<double> numbers(std::string_view text, char separator, std::size_t line) {
        std::vector<double> all;
        for (const detail::DelimitedField &field : detail::split_fields(text, separator)) {
            if (field.text.empty())
                continue;
            if (const auto value = detail::DecimalReader().read(field.text))
                all.push_back(*value);
            else
                problem(line, "'" + field.text + "' is not a number",
                        "expected a finite number such as 5.25");
        }
        return all;
    }

    void add(std::string name, double first_nm, double step_nm, const std::vector<double> &values,
             std::size_t line) {
        SpectrumSample sample{.name = name.empty() ? std::to_string(file_.samples.size() + 1)
                                                   : std::move(name),
                              .quantity = SpectralQuantity::reflectance,
                              .percent = true};
        for (const double value : values) {
            sample.spectrum.wavelength_nm.push_back(
                first_nm + step_nm * static_cast<double>(sample.spectrum.value.size()));
            sample.spectrum.value.push_back(value);
            sample.where.push_back(place(line));
        }
        file_.samples.push_back(std::move(sample));
    }

    SpectrumFile finish(const std::string &accepted) {
        if (problems_.empty() && file_.samples.empty())
            problems_.add({"the file holds no spectrum", name_, accepted});
        problems_.throw_if_any();
        return std::move(file_);
    }

  private:
    std::string name_;
    SpectrumFile file_{};
    Problems problems_{};
};

/// Calls `take` with the number of each line and its text.
template <class Take> void for_lines(std::string_view bytes, const std::string &name, Take take) {
    std::istringstream lines(decode_text(bytes, name));
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);)
        take(++number, detail::without_blanks(line));
}

/// A standard or batch of QTX.
struct QtxRecord {
    std::string name{};
    std::optional<double> first_nm{}, step_nm{}, count{};
    std::vector<double> values{};
    std::size_t line = 0; ///< of the values
};

class QtxReader {
  public:
    explicit QtxReader(const std::string &name) : records_(name) {}

    void read(std::size_t line, std::string_view text) {
        const std::size_t equals = text.find('=');
        if (equals == text.npos) {
            // [STANDARD_DATA 0], STD_DATUM_START
            if (text.starts_with('[') || text.ends_with("_START"))
                end_record();
            return;
        }
        std::string key(detail::without_blanks(text.substr(0, equals)));
        const std::string_view value = detail::without_blanks(text.substr(equals + 1));
        if (!key.starts_with("STD_") && !key.starts_with("BAT_"))
            return;
        key.erase(0, 4);
        if (key == "NAME") {
            if (!record_.name.empty())
                end_record();
            record_.name = value;
        } else if (key == "R") {
            record_.values = records_.numbers(value, ',', line);
            record_.line = line;
        } else if (key == "REFLLOW" || key == "REFLINTERVAL" || key == "REFLPOINTS") {
            const std::vector<double> numbers = records_.numbers(value, ',', line);
            (key == "REFLLOW"        ? record_.first_nm
             : key == "REFLINTERVAL" ? record_.step_nm
                                     : record_.count) =
                numbers.empty() ? std::nullopt : std::optional(numbers.front());
        }
    }

    SpectrumFile finish() {
        end_record();
        return records_.finish(
            "expected STD_R with STD_REFLLOW, STD_REFLINTERVAL and STD_REFLPOINTS");
    }

  private:
    void end_record() {
        QtxRecord record = std::exchange(record_, {});
        std::vector<double> &values = record.values;
        if (values.empty())
            return;
        // The short form has the three numbers before the values.
        if (!record.first_nm && values.size() > 3 &&
            values[2] == static_cast<double>(values.size() - 3)) {
            record.first_nm = values[0];
            record.step_nm = values[1];
            record.count = values[2];
            values.erase(values.begin(), values.begin() + 3);
        }
        if (!record.first_nm || !record.step_nm || !(*record.step_nm > 0))
            return records_.problem(record.line, "the wavelengths of the values are missing",
                                    "expected REFLLOW and REFLINTERVAL in nm");
        if (record.count.value_or(-1) != static_cast<double>(values.size()))
            return records_.problem(record.line,
                                    "there are " + detail::counted(values.size(), "value"),
                                    "expected as many as REFLPOINTS says");
        records_.add(std::move(record.name), *record.first_nm, *record.step_nm, values,
                     record.line);
    }

    Records records_;
    QtxRecord record_{};
};

class MifReader {
  public:
    explicit MifReader(const std::string &name) : records_(name) {}

    void read(std::size_t line, std::string_view text) {
        if (text.starts_with('[')) {
            end_measurement();
            section_ = lower_case(text);
            line_ = line;
        } else if (const std::size_t equals = text.find('='); equals != text.npos) {
            if (section_ != "[measurement]" && lower_case(text.substr(0, equals)) == "name")
                name_ = detail::without_blanks(text.substr(equals + 1));
        } else if (section_ == "[measurement]" && !text.empty()) {
            if (values_.empty())
                line_ = line;
            const std::vector<double> more = records_.numbers(text, ' ', line);
            values_.insert(values_.end(), more.begin(), more.end());
        }
    }

    SpectrumFile finish() {
        end_measurement();
        return records_.finish("expected a section [MEASUREMENT] with 31 values in percent");
    }

  private:
    void end_measurement() {
        constexpr std::size_t kPoints = 31; // from 400 to 700 nm
        if (section_ != "[measurement]")
            return;
        if (values_.size() != kPoints)
            records_.problem(line_, "there are " + detail::counted(values_.size(), "value"),
                             "expected 31, from 400 to 700 nm");
        else
            records_.add(name_, 400, 10, values_, line_);
        values_.clear();
        section_.clear();
    }

    Records records_;
    std::string section_{}, name_{};
    std::vector<double> values_{};
    std::size_t line_ = 0;
};

} // namespace

SpectrumFile parse_qtx(std::string_view bytes, const std::string &name) {
    QtxReader reader(name);
    for_lines(bytes, name,
              [&](std::size_t line, std::string_view text) { reader.read(line, text); });
    return reader.finish();
}

SpectrumFile parse_mif(std::string_view bytes, const std::string &name) {
    MifReader reader(name);
    for_lines(bytes, name,
              [&](std::size_t line, std::string_view text) { reader.read(line, text); });
    return reader.finish();
}

} // namespace tsuya
