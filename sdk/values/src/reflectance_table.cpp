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

// As %g of the C locale, whatever the locale is.
std::string number_text(double value, int digits) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::general, digits);
    return {text.data(), end.ptr};
}

constexpr std::array kSymmetries = {Symmetry::none, Symmetry::half_turn, Symmetry::orthotropic};

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

std::vector<std::string> symmetry_names() {
    std::vector<std::string> names;
    for (const Symmetry symmetry : kSymmetries)
        names.emplace_back(name_of(symmetry));
    return names;
}

std::optional<Symmetry> symmetry_named(std::string_view name) {
    const auto known = std::ranges::find(kSymmetries, name, name_of);
    return known == kSymmetries.end() ? std::nullopt : std::optional(*known);
}

bool ReflectanceTable::has_sigma() const {
    return std::any_of(rows.begin(), rows.end(), [](const auto &r) { return r.sigma_per_sr > 0; });
}

ReflectanceTable ReflectanceTable::normal_incidence() const {
    ReflectanceTable result{
        .keys = keys, .symmetry = symmetry, .symmetry_declared = symmetry_declared};
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(result.rows),
                 [](const ReflectanceRow &r) { return r.from_above(); });
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

std::array<long long, 4> direction_key(const ReflectanceRow &row) {
    constexpr double kPerRadian = 1e6; // angles nearer than 1e-6 are one
    const auto whole = [](double angle) { return std::llround(angle * kPerRadian); };
    const long long turn = whole(2 * kPi), theta_r = whole(row.theta_r);
    const auto azimuth = [&](double phi) { return ((whole(phi) % turn) + turn) % turn; };
    const bool oblique = !row.from_above();
    return {oblique ? whole(row.theta_i) : 0, oblique ? azimuth(row.phi_i) : 0, theta_r,
            theta_r > 0 ? azimuth(row.phi_r) : 0};
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
    std::sort(sorted.begin(), sorted.end(),
              [&](const auto &a, const auto &b) { return direction_key(a) < direction_key(b); });
    for (std::size_t i = 1; i < sorted.size(); ++i) {
        const ReflectanceRow &a = sorted[i - 1], &b = sorted[i];
        const double high = std::max(a.brdf_per_sr, b.brdf_per_sr);
        const double low = std::min(a.brdf_per_sr, b.brdf_per_sr);
        if (direction_key(a) == direction_key(b) && high > kFactor * low &&
            high - low > kSigmas * std::hypot(a.sigma_per_sr, b.sigma_per_sr))
            refuse(a,
                   "measured twice, " + number_text(a.brdf_per_sr, 6) + " and " +
                       number_text(b.brdf_per_sr, 6),
                   "expected repeats within a factor of 2, or a sigma_per_sr that explains them");
    }
    problems.throw_if_any();
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
