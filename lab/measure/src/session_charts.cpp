#include "session_charts.h"

#include <algorithm>
#include <cmath>

#include "chart.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr glm::dvec2 kCorner{80, 30}, kSize{860, 220};
constexpr double kBelow = 50;                  // for the words of the axis
constexpr std::size_t kManyViews = 150;        // whose dots are smaller
constexpr double kLowest = 1e-4, kHighest = 1; // relative errors that are drawn

/// The readings of one direction of light under one lighting.
struct Course {
    const LampCourse *light = nullptr;
    std::vector<const WhiteReading *> readings{};

    double mean() const {
        double sum = 0;
        for (const WhiteReading *reading : readings)
            sum += reading->rate;
        return sum / static_cast<double>(readings.size());
    }
};

std::vector<Course> courses_of(const ChannelMeasurement &channel, int strike) {
    std::vector<Course> courses;
    for (const LampCourse &light : channel.lamp) {
        Course course{.light = &light};
        for (const WhiteReading &reading : light.readings)
            if (reading.strike == strike)
                course.readings.push_back(&reading);
        std::sort(course.readings.begin(), course.readings.end(),
                  [](const auto *a, const auto *b) { return a->time_s < b->time_s; });
        if (!course.readings.empty())
            courses.push_back(std::move(course));
    }
    return courses;
}

/// One reading, in minutes and per cent.
struct WhitePoint {
    double minute = 0, per_cent = 0, sigma = 0;
};

std::vector<WhitePoint> points_of(const Course &course, double begin_s) {
    const double mean = course.mean();
    std::vector<WhitePoint> points;
    for (const WhiteReading *reading : course.readings)
        points.push_back({(reading->time_s - begin_s) / 60, 100 * (reading->rate / mean - 1),
                          100 * reading->sigma / mean});
    return points;
}

} // namespace

std::string white_chart(const ChannelMeasurement &channel, int strike) {
    const std::vector<Course> courses = courses_of(channel, strike);
    std::size_t count = 0;
    double begin_s = HUGE_VAL;
    for (const Course &course : courses) {
        count += course.readings.size();
        begin_s = std::min(begin_s, course.readings.front()->time_s);
    }
    if (count < 2)
        return "";
    std::vector<std::vector<WhitePoint>> lines;
    double minutes = 0, largest = 0.1;
    for (const Course &course : courses) {
        lines.push_back(points_of(course, begin_s));
        for (const WhitePoint &point : lines.back()) {
            minutes = std::max(minutes, point.minute);
            largest = std::max(largest, std::abs(point.per_cent) + point.sigma);
        }
    }
    Drawing drawing(kCorner.x + kSize.x + 24, kCorner.y + kSize.y + kBelow);
    const Chart chart(drawing, kCorner, kSize,
                      {.words = "minutes", .low = 0, .high = std::max(minutes, 1e-3)},
                      {.words = "white standard over its mean, per cent",
                       .low = -1.1 * largest,
                       .high = 1.1 * largest});
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string colour =
            scale_colour(lines.size() > 1 ? 0.9 * double(i) / double(lines.size() - 1) : 0.3);
        std::vector<glm::dvec2> path;
        for (const WhitePoint &point : lines[i])
            path.push_back(chart.at(point.minute, point.per_cent));
        drawing.polyline(path, {.colour = colour});
        for (std::size_t k = 0; k < path.size(); ++k) {
            const WhitePoint &point = lines[i][k];
            drawing.line(chart.at(point.minute, point.per_cent - point.sigma),
                         chart.at(point.minute, point.per_cent + point.sigma), {.colour = colour});
            drawing.dot(path[k], 3, colour,
                        "light from theta " + number_text(courses[i].light->theta_i / kDegree, 4) +
                            "°, phi " + number_text(courses[i].light->phi_i / kDegree, 4) +
                            "°: " + number_text(point.per_cent, 3) + " %");
        }
    }
    return drawing.svg();
}

std::string sigma_chart(const ChannelMeasurement &channel) {
    Drawing drawing(kCorner.x + kSize.x + 24, kCorner.y + kSize.y + kBelow);
    const Chart chart(drawing, kCorner, kSize,
                      {.words = "view, in the order of the plan",
                       .low = 0,
                       .high = static_cast<double>(std::max<std::size_t>(channel.views.size(), 1))},
                      {.words = "standard error over the value, per cent",
                       .low = 100 * kLowest,
                       .high = 100 * kHighest,
                       .logarithmic = true});
    const double radius = channel.views.size() > kManyViews ? 1.5 : 3;
    double right = kCorner.x + kSize.x;
    for (auto part = kSigmaParts.rbegin(); part != kSigmaParts.rend(); ++part) {
        drawing.write({right, kCorner.y - 8}, part->name,
                      {.anchor = "end", .colour = part->colour});
        right -= 70;
    }
    for (const SigmaPart &part : kSigmaParts)
        for (std::size_t i = 0; i < channel.views.size(); ++i) {
            const MeasuredView &view = channel.views[i];
            const double share = view.brdf_per_sr > 0 ? view.*part.value / view.brdf_per_sr : 0;
            if (share >= kLowest)
                drawing.dot(chart.at(double(i) + 0.5, 100 * share), radius, part.colour);
        }
    return drawing.svg();
}

} // namespace tsuya::lab
