// Files of luminous intensities, [LM63].

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/intensity_profile.h"
#include "tsuya/sdk/text.h"

namespace tsuya {
namespace {

constexpr int kMostAngles = 2000;
constexpr int kTypeC = 1, kTypeB = 2, kTypeA = 3;

/// Intensity at angles of types A and B; dark beyond what was measured.
double ahead(const IntensityProfile &measured, double vertical, double horizontal) {
    if (measured.horizontal.front() >= 0) // both sides are alike
        horizontal = std::abs(horizontal);
    constexpr double kRounding = 1e-9;
    struct Place {
        std::size_t index;
        double share; // of the next
    };
    const auto place = [](const std::vector<double> &list, double angle) -> std::optional<Place> {
        if (angle < list.front() - kRounding || angle > list.back() + kRounding)
            return std::nullopt;
        const auto next = std::upper_bound(list.begin() + 1, list.end() - 1, angle);
        const auto index = static_cast<std::size_t>(next - list.begin()) - 1;
        return Place{index, (angle - list[index]) / (list[index + 1] - list[index])};
    };
    const auto v = place(measured.vertical, vertical), h = place(measured.horizontal, horizontal);
    if (!v || !h)
        return 0;
    const auto along = [&](std::size_t row) {
        const double *const values = measured.candela.data() + row * measured.vertical.size();
        return std::lerp(values[v->index], values[v->index + 1], v->share);
    };
    return std::max(0.0, std::lerp(along(h->index), along(h->index + 1), h->share));
}

/// A profile of type A or B with angles from and about the axis, at which H and V are 0. Plane 0 is
/// that of V = 90. For one who looks along the axis with that above, H counts to the right: in A
/// about the upward direction, where V is the height above the plane across it; in B V counts about
/// the direction to the right, and H is from the plane across that.
IntensityProfile about_the_axis(const IntensityProfile &measured, int type) {
    constexpr int kFromAxis = 180, kAbout = 360; // half a degree, and one
    IntensityProfile profile;
    for (int i = 0; i <= kFromAxis; ++i)
        profile.vertical.push_back(kHalfPi * i / kFromAxis);
    for (int j = 0; j <= kAbout; ++j)
        profile.horizontal.push_back(2 * kPi * j / kAbout);
    for (const double about : profile.horizontal)
        for (const double from_axis : profile.vertical) {
            const double forward = std::cos(from_axis), up = std::sin(from_axis) * std::cos(about),
                         right = -std::sin(from_axis) * std::sin(about);
            profile.candela.push_back(
                type == kTypeA ? ahead(measured, std::asin(up), std::atan2(right, forward))
                               : ahead(measured, std::atan2(up, forward), std::asin(right)));
        }
    return profile;
}

class IesReader {
  public:
    IesReader(std::string_view text, std::string name) : rest_(text), name_(std::move(name)) {}

    IntensityProfile read() {
        read_heading();
        number("number of lamps");
        number("lumens per lamp");
        const double multiplier = above_zero("candela multiplier");
        const int verticals = count("number of vertical angles", 2);
        const int horizontals = count("number of horizontal angles", 1);
        const int type = photometric_type();
        for (const char *what : {"units", "width", "length", "height"})
            number(what);
        const double factor =
            multiplier * above_zero("ballast factor") * above_zero("ballast-lamp factor");
        number("input watts");
        IntensityProfile profile;
        profile.vertical = angles(verticals, "vertical angle");
        if (type == kTypeC)
            check_vertical(profile.vertical);
        else
            check_ahead(profile.vertical, "vertical");
        profile.horizontal = angles(horizontals, "horizontal angle");
        if (type == kTypeC) {
            turn_horizontal(profile.horizontal);
        } else {
            check_ahead(profile.horizontal, "horizontal");
            if (horizontals < 2 || profile.horizontal.front() > 0 ||
                !(profile.horizontal.back() > 0))
                refuse("the horizontal angles do not reach from 0 to the right",
                       "expected angles from -90 or 0 to 90 degrees");
        }
        for (int i = 0; i < verticals * horizontals; ++i) {
            const double value = number("intensity");
            if (value < 0)
                refuse("the intensity " + shown(value) + " is below 0", "expected candelas");
            profile.candela.push_back(value * factor);
        }
        if (!(profile.highest() > 0))
            refuse("the luminaire is dark", "expected intensities above 0");
        return type == kTypeC ? profile : about_the_axis(profile, type);
    }

  private:
    [[noreturn]] void refuse(const std::string &what, const std::string &accepted) const {
        throw Error({what, name_ + ":" + std::to_string(line_), accepted});
    }
    static std::string shown(double value) {
        std::string text = std::to_string(value);
        text.erase(text.find_last_not_of('0') + 1);
        if (text.back() == '.')
            text.pop_back();
        return text;
    }

    std::optional<std::string_view> next_line() {
        if (rest_.empty())
            return std::nullopt;
        ++line_;
        const std::size_t end = rest_.find('\n');
        std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
        while (!line.empty() && std::isspace(static_cast<unsigned char>(line.back())))
            line.remove_suffix(1);
        return line;
    }

    // Title and keywords, up to TILT and its factors.
    void read_heading() {
        std::string_view tilt;
        while (tilt.empty()) {
            const auto line = next_line();
            if (!line)
                refuse("there is no TILT line",
                       "expected a file of luminous intensities (IES LM-63)");
            if (line->starts_with("TILT="))
                tilt = line->substr(5);
        }
        if (tilt == "NONE")
            return;
        if (tilt != "INCLUDE")
            refuse("the tilt factors are in another file, " + std::string(tilt),
                   "expected TILT=NONE or TILT=INCLUDE");
        number("lamp-to-luminaire geometry");
        const int pairs = count("number of tilt angles", 1);
        for (int i = 0; i < 2 * pairs; ++i)
            number("tilt factor");
    }

    // Numbers stand on any lines, between spaces or commas.
    double number(const char *what) {
        const auto parted = [](char c) {
            return std::isspace(static_cast<unsigned char>(c)) || c == ',';
        };
        while (true) {
            while (!values_.empty() && parted(values_.front()))
                values_.remove_prefix(1);
            if (!values_.empty())
                break;
            const auto line = next_line();
            if (!line)
                refuse(std::string("the file ends where the ") + what + " should be",
                       "expected a number");
            values_ = *line;
        }
        std::size_t length = 0;
        while (length < values_.size() && !parted(values_[length]))
            ++length;
        std::string_view word = values_.substr(0, length);
        values_.remove_prefix(length);
        if (word.starts_with('+'))
            word.remove_prefix(1);
        double value = 0;
        const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (code != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
            refuse("the " + std::string(what) + " is '" + std::string(word) + "'",
                   "expected a number");
        return value;
    }
    double above_zero(const char *what) {
        const double value = number(what);
        if (!(value > 0))
            refuse("the " + std::string(what) + " is " + shown(value), "expected a value above 0");
        return value;
    }
    int count(const char *what, int least) {
        const double value = number(what);
        if (!(value >= least && value <= kMostAngles) || value != std::floor(value))
            refuse("the " + std::string(what) + " is " + shown(value),
                   "expected a whole number from " + std::to_string(least) + " to " +
                       std::to_string(kMostAngles));
        return static_cast<int>(value);
    }

    int photometric_type() {
        const double type = number("photometric type");
        if (type != kTypeA && type != kTypeB && type != kTypeC)
            refuse("photometric type " + shown(type), "expected 1, 2 or 3: type C, B or A");
        return static_cast<int>(type);
    }

    std::vector<double> angles(int how_many, const char *what) {
        std::vector<double> list;
        for (int i = 0; i < how_many; ++i) {
            const double degrees = number(what);
            if (!list.empty() && !(degrees * kDegree > list.back()))
                refuse("the " + std::string(what) + " " + shown(degrees) +
                           " is no larger than the one before",
                       "expected rising angles");
            list.push_back(degrees * kDegree);
        }
        return list;
    }
    void check_vertical(const std::vector<double> &list) const {
        constexpr double kRounding = 1e-9;
        if (list.front() < 0 || list.back() > kPi + kRounding)
            refuse("the vertical angles go from " + shown(list.front() / kDegree) + " to " +
                       shown(list.back() / kDegree),
                   "expected angles of type C, from 0 to 180 degrees");
    }
    // Types A and B: the half space ahead.
    void check_ahead(const std::vector<double> &list, const std::string &which) const {
        constexpr double kRounding = 1e-9;
        if (list.front() < -kHalfPi - kRounding || list.back() > kHalfPi + kRounding)
            refuse("the " + which + " angles go from " + shown(list.front() / kDegree) + " to " +
                       shown(list.back() / kDegree),
                   "expected angles of types A and B, from -90 to 90 degrees");
    }
    // From 0; a half turn may be given from 90 to 270.
    void turn_horizontal(std::vector<double> &list) const {
        constexpr double kRounding = 1e-6;
        const auto is = [&](double angle, double degrees) {
            return std::abs(angle - degrees * kDegree) < kRounding;
        };
        const bool turned = is(list.front(), 90) && is(list.back(), 270);
        const bool known = is(list.front(), 0) && (list.size() == 1 || is(list.back(), 90) ||
                                                   is(list.back(), 180) || is(list.back(), 360));
        if (!turned && !known)
            refuse("the horizontal angles go from " + shown(list.front() / kDegree) + " to " +
                       shown(list.back() / kDegree),
                   "expected 0 alone, or 0 to 90, 180 or 360, or 90 to 270 degrees");
        if (turned)
            for (double &angle : list)
                angle -= kHalfPi;
    }

    std::string_view rest_, values_{};
    std::string name_;
    int line_ = 0;
};

} // namespace

IntensityProfile parse_ies(std::string_view text, const std::string &name) {
    return IesReader(text, name).read();
}

IntensityProfile read_ies(const std::filesystem::path &file) {
    return parse_ies(read_text(file), file.string());
}

} // namespace tsuya
