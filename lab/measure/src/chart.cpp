#include "chart.h"

#include <algorithm>
#include <cmath>

#include "tsuya/lab/number_text.h"

namespace tsuya::lab {
namespace {

constexpr const char *kGrid = "#d8d8d8", *kFrame = "#777";
constexpr double kSteps = 5; // between ticks, or a few more

double share_of(const ChartAxis &axis, double value) {
    const double share = axis.logarithmic
                             ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                             : (value - axis.low) / (axis.high - axis.low);
    return std::isnan(share) ? 0 : std::clamp(share, 0.0, 1.0);
}

} // namespace

std::vector<double> ticks_of(const ChartAxis &axis) {
    std::vector<double> ticks;
    if (axis.logarithmic) {
        const int first = static_cast<int>(std::ceil(std::log10(axis.low) - 1e-9));
        for (int power = first; std::pow(10.0, power) <= axis.high * (1 + 1e-9); ++power)
            ticks.push_back(std::pow(10.0, power));
        return ticks;
    }
    const double rough = (axis.high - axis.low) / kSteps;
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double steps[] = {1, 2, 5, 10};
    const double step = power * *std::find_if(steps, steps + 3, [&](double s) {
                            return s * power >= rough * (1 - 1e-9);
                        });
    const auto first = std::lround(std::ceil(axis.low / step - 1e-9));
    for (long i = first; static_cast<double>(i) * step <= axis.high + 1e-9 * step; ++i)
        ticks.push_back(static_cast<double>(i) * step);
    return ticks;
}

Chart::Chart(Drawing &drawing, const glm::dvec2 &corner, const glm::dvec2 &size, ChartAxis x,
             ChartAxis y)
    : drawing_(drawing), corner_(corner), size_(size), x_(std::move(x)), y_(std::move(y)) {
    if (!x_.words.empty())
        draw_x();
    if (!y_.words.empty())
        draw_y();
    drawing_.polyline({corner_, corner_ + glm::dvec2(size_.x, 0), corner_ + size_,
                       corner_ + glm::dvec2(0, size_.y), corner_},
                      {.colour = kFrame});
}

glm::dvec2 Chart::at(double x, double y) const {
    return corner_ + size_ * glm::dvec2(share_of(x_, x), 1 - share_of(y_, y));
}

void Chart::draw_x() const {
    const double bottom = corner_.y + size_.y;
    for (const double tick : ticks_of(x_)) {
        const double x = corner_.x + size_.x * share_of(x_, tick);
        drawing_.line({x, corner_.y}, {x, bottom}, {.colour = kGrid});
        drawing_.write({x, bottom + 16}, number_text(tick, 4), {.anchor = "middle"});
    }
    drawing_.write({corner_.x + size_.x / 2, bottom + 34}, x_.words, {.anchor = "middle"});
}

void Chart::draw_y() const {
    for (const double tick : ticks_of(y_)) {
        const double y = corner_.y + size_.y * (1 - share_of(y_, tick));
        drawing_.line({corner_.x, y}, {corner_.x + size_.x, y}, {.colour = kGrid});
        drawing_.write({corner_.x - 6, y + 4}, number_text(tick, 4), {.anchor = "end"});
    }
    drawing_.write(corner_ - glm::dvec2(0, 8), y_.words);
}

} // namespace tsuya::lab
