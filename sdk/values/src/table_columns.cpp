#include "table_columns.h"

#include <algorithm>
#include <charconv>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr std::string_view kDegreeSign = "\xC2\xB0";
constexpr double kShortestNm = 100, kLongestNm = 3000; // ultraviolet to near infrared

// "Theta_i [deg]" and "theta_i (°)" as theta_i_deg.
std::string plain_name(std::string name) {
    if (const std::size_t at = name.find(kDegreeSign); at != name.npos)
        name.replace(at, kDegreeSign.size(), "deg");
    std::string plain;
    for (const char c : name) {
        const bool upper = c >= 'A' && c <= 'Z';
        const bool kept = upper || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '.';
        if (kept)
            plain += upper ? static_cast<char>(c - 'A' + 'a') : c;
        else if (!plain.empty() && plain.back() != '_')
            plain += '_';
    }
    while (plain.ends_with('_'))
        plain.pop_back();
    return plain;
}

// Cuts `ending` off the end.
bool take_ending(std::string &name, std::string_view ending) {
    if (!name.ends_with(ending))
        return false;
    name.resize(name.size() - ending.size());
    return true;
}

// `550nm` as 550.
std::optional<double> wavelength_of(std::string_view channel) {
    double value = 0;
    const auto [end, code] =
        std::from_chars(channel.data(), channel.data() + channel.size(), value);
    const std::string_view unit = channel.substr(static_cast<std::size_t>(end - channel.data()));
    const bool good = code == std::errc{} && value > 0 && (unit == "nm" || unit == "_nm");
    return good ? std::optional(value) : std::nullopt;
}

bool is_colour(std::string_view channel) {
    return channel == "r" || channel == "g" || channel == "b";
}

// Sorts the names of a header into columns.
class HeaderReader {
  public:
    HeaderReading read(const std::vector<detail::DelimitedField> &fields) {
        for (std::size_t i = 0; i < fields.size(); ++i)
            if (!take(plain_name(fields[i].text), i) && !fields[i].text.empty())
                columns_.unused.push_back(fields[i].text);
        check_angles();
        check_values();
        std::sort(columns_.values.begin(), columns_.values.end(),
                  [](const ValueColumn &a, const ValueColumn &b) {
                      return std::pair(a.wavelength_nm, a.value) <
                             std::pair(b.wavelength_nm, b.value);
                  });
        return {std::move(columns_), std::move(problem_)};
    }

  private:
    bool take(const std::string &name, std::size_t field) {
        return take_angle(name, field) || take_value(name, field);
    }

    bool take_angle(const std::string &name, std::size_t field) {
        for (AngleColumn &angle : columns_.angle) {
            if (name == angle.name)
                fail(name + " has no unit");
            const bool degrees = name == angle.name + "_deg";
            if (!degrees && name != angle.name + "_rad")
                continue;
            if (angle.unit > 0)
                fail(angle.name + " is given twice");
            angle.field = field;
            angle.unit = degrees ? kDegree : 1;
            return true;
        }
        return false;
    }

    bool take_value(const std::string &name, std::size_t field) {
        for (const auto &[what, member] :
             {std::pair("brdf", &ValueColumn::value), std::pair("sigma", &ValueColumn::sigma)}) {
            std::string channel = name;
            take_ending(channel, "_per_sr") || take_ending(channel, "_1_sr");
            if (channel != what && !channel.starts_with(std::string(what) + "_"))
                continue;
            channel.erase(0, std::min(channel.size(), std::string_view(what).size() + 1));
            if (!channel.empty() && !is_colour(channel) && !wavelength_of(channel))
                return false;
            if (const auto nm = wavelength_of(channel);
                nm && !(*nm >= kShortestNm && *nm <= kLongestNm))
                fail("the wavelength of " + name + " is not from 100 to 3000 nm");
            std::optional<std::size_t> &place = column_of(channel).*member;
            if (place)
                fail(name + " is given twice");
            place = field;
            return true;
        }
        return false;
    }

    ValueColumn &column_of(const std::string &channel) {
        const auto wavelength_nm = wavelength_of(channel);
        for (ValueColumn &column : columns_.values)
            if (wavelength_nm ? column.wavelength_nm == wavelength_nm : column.channel == channel)
                return column;
        return columns_.values.emplace_back(
            ValueColumn{.channel = channel, .wavelength_nm = wavelength_nm});
    }

    void check_angles() {
        for (const AngleColumn &angle : columns_.angle)
            if (angle.unit == 0)
                fail("the header line has no column " + angle.name + "_deg");
    }

    void check_values() {
        if (columns_.values.empty())
            fail("the header line has no column brdf_per_sr");
        int whole = 0, colours = 0, wavelengths = 0;
        for (const ValueColumn &column : columns_.values) {
            if (!column.value)
                fail("sigma of '" + column.channel + "' has no column of values");
            ++(column.wavelength_nm ? wavelengths : column.channel.empty() ? whole : colours);
        }
        if ((whole > 0) + (colours > 0) + (wavelengths > 0) > 1)
            fail("columns of values are of several kinds");
        if (colours == 1 || colours == 2)
            fail("one of brdf_r, brdf_g and brdf_b is missing");
    }

    void fail(const std::string &problem) {
        if (problem_.empty())
            problem_ = problem;
    }

    TableColumns columns_{};
    std::string problem_{};
};

} // namespace

std::size_t TableColumns::needed() const {
    std::size_t last = 0;
    for (const AngleColumn &column : angle)
        last = std::max(last, column.field);
    for (const ValueColumn &column : values)
        last = std::max({last, column.value.value_or(0), column.sigma.value_or(0)});
    return last + 1;
}

bool TableColumns::in_degrees() const {
    return std::ranges::all_of(angle, [](const AngleColumn &a) { return a.unit == kDegree; });
}

std::string accepted_columns() {
    return "expected the columns theta_i_deg, phi_i_deg, theta_r_deg, phi_r_deg and brdf_per_sr, "
           "or brdf_r, brdf_g and brdf_b, or such as brdf_550nm, in any order";
}

HeaderReading read_header(const std::vector<detail::DelimitedField> &fields) {
    return HeaderReader().read(fields);
}

} // namespace tsuya
