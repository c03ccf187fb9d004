#include "tsuya/sdk/reflectance_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

constexpr std::array<std::string_view, 6> kColumns = {"theta_i_deg", "phi_i_deg",   "theta_r_deg",
                                                      "phi_r_deg",   "brdf_per_sr", "sigma_per_sr"};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

// As %g of the C locale, whatever the locale is.
std::string number_text(double value, int digits) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::general, digits);
    return {text.data(), end.ptr};
}

// Reads the lines of a table and remembers where it is, for errors.
class TableReader {
  public:
    explicit TableReader(const std::filesystem::path &file)
        : name_(file.string()), text_(read_file(file)) {
        table_.symmetry_declared = false;
    }

    ReflectanceTable read() {
        std::string_view rest = text_;
        while (!rest.empty() && !problems_.full()) {
            const std::string_view line = rest.substr(0, rest.find('\n'));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
            ++line_;
            read_line(line);
        }
        if (problems_.empty() && table_.rows.empty())
            problem("the table has no row", 1, "expected rows below the header line " + header());
        problems_.throw_if_any();
        return std::move(table_);
    }

  private:
    void read_line(std::string_view line) {
        const std::string_view content = trimmed(line);
        if (content.empty())
            return;
        if (content.front() == '#')
            read_key(trimmed(content.substr(1)));
        else if (!seen_header_)
            read_header(content);
        else
            read_row(line);
    }

    void read_key(std::string_view content) {
        const auto colon = content.find(':');
        if (colon == std::string_view::npos)
            return;
        const std::string key(trimmed(content.substr(0, colon)));
        const std::string value(trimmed(content.substr(colon + 1)));
        if (key != "symmetry") {
            table_.keys[key] = value;
            return;
        }
        for (const Symmetry s : {Symmetry::none, Symmetry::half_turn, Symmetry::orthotropic})
            if (value == name_of(s)) {
                table_.symmetry = s;
                table_.symmetry_declared = true;
                return;
            }
        const std::array<std::string, 3> known = {"orthotropic", "half-turn", "none"};
        problem("unknown symmetry '" + value + "'", 1, accepted_names(value, known));
    }

    void read_header(std::string_view content) {
        seen_header_ = true;
        const std::string full = header();
        const std::string without_sigma = full.substr(0, full.rfind(','));
        if (content == full)
            columns_ = 6;
        else if (content == without_sigma)
            columns_ = 5;
        else
            problem("the header line is '" + std::string(content) + "'", 1,
                    "expected " + without_sigma + "[,sigma_per_sr]");
    }

    void read_row(std::string_view line) {
        std::array<double, 6> value{};
        std::size_t begin = 0;
        for (std::size_t c = 0; c < columns_; ++c) {
            const std::size_t end = std::min(line.find(',', begin), line.size());
            const std::optional<double> v = number(line.substr(begin, end - begin), begin + 1, c);
            if (!v)
                return;
            value[c] = *v;
            const bool last = c + 1 == columns_;
            if (last != (end == line.size())) {
                problem("the row has " + std::string(last ? "more" : "fewer") + " than " +
                            std::to_string(columns_) + " columns",
                        end + 1, "expected " + header());
                return;
            }
            begin = end + 1;
        }
        table_.rows.push_back({value[0] * kDegree, value[1] * kDegree, value[2] * kDegree,
                               value[3] * kDegree, value[4], value[5]});
    }

    std::optional<double> number(std::string_view field, std::size_t column, std::size_t c) {
        const std::string_view content = trimmed(field);
        double v = 0;
        const auto [end, code] =
            std::from_chars(content.data(), content.data() + content.size(), v);
        const std::string shown = std::string(kColumns[c]) + " is '" + std::string(content) + "'";
        if (code != std::errc{} || end != content.data() + content.size() || !std::isfinite(v))
            problem(shown, column, "expected a finite number");
        else if (c >= 4 && v < 0)
            problem(shown, column, "expected a number not below 0");
        else if ((c == 0 || c == 2) && !(v >= 0 && v <= 90))
            problem(shown, column, "expected an angle from the normal of 0 to 90 degrees");
        else if ((c == 1 || c == 3) && !(std::abs(v) <= 360))
            problem(shown, column, "expected an angle from the weft of -360 to 360 degrees");
        else
            return v;
        return std::nullopt;
    }

    static std::string header() {
        std::string text;
        for (const std::string_view column : kColumns)
            text += (text.empty() ? "" : ",") + std::string(column);
        return text;
    }

    void problem(std::string what, std::size_t column, std::string accepted) {
        problems_.add({std::move(what),
                       name_ + ":" + std::to_string(line_) + ":" + std::to_string(column),
                       std::move(accepted)});
    }

    std::string name_, text_;
    ReflectanceTable table_;
    Problems problems_;
    std::size_t line_ = 0, columns_ = 0;
    bool seen_header_ = false;
};

} // namespace

const char *name_of(Symmetry symmetry) {
    switch (symmetry) {
    case Symmetry::none:
        return "none";
    case Symmetry::half_turn:
        return "half-turn";
    case Symmetry::orthotropic:
        break;
    }
    return "orthotropic";
}

bool ReflectanceTable::has_sigma() const {
    return std::any_of(rows.begin(), rows.end(), [](const auto &r) { return r.sigma_per_sr > 0; });
}

ReflectanceTable ReflectanceTable::normal_incidence() const {
    ReflectanceTable result{
        .keys = keys, .symmetry = symmetry, .symmetry_declared = symmetry_declared};
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(result.rows),
                 [](const ReflectanceRow &r) { return r.theta_i < 1e-9; });
    return result;
}

std::optional<Symmetry> likely_symmetry(const ReflectanceTable &table) {
    constexpr double kSlack = kDegree; // of angles as rigs write them
    if (table.symmetry != Symmetry::none)
        return std::nullopt;
    std::set<double> azimuths;
    for (const ReflectanceRow &row : table.rows)
        if (row.theta_i > kSlack)
            azimuths.insert(std::fmod(row.phi_i + 4 * kPi, 2 * kPi));
    if (azimuths.empty())
        return std::nullopt;
    double gap = 2 * kPi - *azimuths.rbegin() + *azimuths.begin();
    for (auto next = std::next(azimuths.begin()); next != azimuths.end(); ++next)
        gap = std::max(gap, *next - *std::prev(next));
    if (gap > 1.5 * kPi - kSlack)
        return Symmetry::orthotropic;
    return gap > kPi + kSlack ? std::optional(Symmetry::half_turn) : std::nullopt;
}

void check_table(const ReflectanceTable &table, const std::string &where) {
    constexpr double kFactor = 2, kSigmas = 5, kSame = 1e-9;
    Problems problems;
    const auto row_name = [](const ReflectanceRow &r) {
        const auto degrees = [](double angle) { return number_text(angle / kDegree, 6); };
        return "light (" + degrees(r.theta_i) + ", " + degrees(r.phi_i) + ") view (" +
               degrees(r.theta_r) + ", " + degrees(r.phi_r) + ") degrees";
    };
    const auto refuse = [&](const ReflectanceRow &r, const std::string &what,
                            const char *accepted) {
        problems.add({row_name(r) + ": " + what, where, accepted});
    };
    const double horizon = kPi / 2 + kSame;
    std::vector<ReflectanceRow> sorted = table.rows;
    for (const ReflectanceRow &r : sorted) {
        if (!(std::isfinite(r.brdf_per_sr) && r.brdf_per_sr >= 0 && r.sigma_per_sr >= 0))
            refuse(r, "the value is " + number_text(r.brdf_per_sr, 6),
                   "expected a finite number not below 0");
        if (!(r.theta_i >= 0 && r.theta_i <= horizon && r.theta_r >= 0 && r.theta_r <= horizon &&
              std::isfinite(r.phi_i) && std::isfinite(r.phi_r)))
            refuse(r, "the direction is not above the cloth",
                   "expected angles from the normal of 0 to 90 degrees");
    }
    problems.throw_if_any();
    const auto key = [](const ReflectanceRow &r) {
        const auto rounded = [](double angle) { return std::lround(angle / 1e-6); };
        return std::array{rounded(r.theta_i), r.theta_i > kSame ? rounded(r.phi_i) : 0,
                          rounded(r.theta_r), r.theta_r > kSame ? rounded(r.phi_r) : 0};
    };
    std::sort(sorted.begin(), sorted.end(),
              [&](const auto &a, const auto &b) { return key(a) < key(b); });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const ReflectanceRow &a = sorted[i - 1], &b = sorted[i];
        const double high = std::max(a.brdf_per_sr, b.brdf_per_sr);
        const double low = std::min(a.brdf_per_sr, b.brdf_per_sr);
        if (key(a) == key(b) && high > kFactor * low &&
            high - low > kSigmas * std::hypot(a.sigma_per_sr, b.sigma_per_sr))
            refuse(a,
                   "measured twice, " + number_text(a.brdf_per_sr, 6) + " and " +
                       number_text(b.brdf_per_sr, 6),
                   "expected repeats within a factor of 2, or a sigma_per_sr that explains them");
    }
    problems.throw_if_any();
}

ReflectanceTable read_reflectance_table(const std::filesystem::path &file) {
    return TableReader(file).read();
}

void write_reflectance_table(const ReflectanceTable &table, const std::filesystem::path &file) {
    std::string text;
    for (const auto &[key, value] : table.keys)
        text += "# " + key + ": " + value + "\n";
    text += std::string("# symmetry: ") + name_of(table.symmetry) + "\n";
    const bool sigma = table.has_sigma();
    text += "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr";
    text += sigma ? ",sigma_per_sr\n" : "\n";
    for (const ReflectanceRow &r : table.rows) {
        for (const double angle : {r.theta_i, r.phi_i, r.theta_r, r.phi_r})
            text += number_text(angle / kDegree, 9) + ",";
        text += number_text(r.brdf_per_sr, 6);
        text += sigma ? "," + number_text(r.sigma_per_sr, 3) + "\n" : "\n";
    }
    write_file(file, text);
}

} // namespace tsuya
