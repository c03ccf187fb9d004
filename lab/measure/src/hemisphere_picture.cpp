#include "hemisphere_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "crowded_places.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::lab {
namespace {

constexpr std::size_t kMostLights = 24, kColumns = 4;
constexpr double kMargin = 16, kLine = 20, kTitle = 40;
constexpr double kWeft = 40, kWarp = 16; // for the words at the ends of the axes
constexpr double kKeyWidth = 330;        // beside the disks
constexpr double kLampRadius = 5;
// Of crosses, in radii of a mark: nearer, two overlap; so far they join a patch; the patch around
// one
constexpr double kOverlap = 2, kStep = 3.5, kPatch = 2;
constexpr const char *kFaint = "#b8b8b8", *kLampColour = "#e08a00";

using Marks = std::vector<const HemisphereMark *>;
using Numbers = std::vector<std::size_t>;

std::vector<glm::dvec2> picked(const std::vector<glm::dvec2> &places, const Numbers &numbers) {
    std::vector<glm::dvec2> some;
    for (const std::size_t i : numbers)
        some.push_back(places[i]);
    return some;
}

/// The marks under one light.
struct LightMarks {
    double theta_i = 0, phi_i = 0;
    Marks marks{};
};

std::vector<LightMarks> by_light(const std::vector<HemisphereMark> &marks) {
    std::vector<LightMarks> lights;
    for (const HemisphereMark &mark : marks) {
        const DirectionPair &at = mark.directions;
        auto light = std::find_if(lights.begin(), lights.end(), [&](const LightMarks &known) {
            return std::abs(known.theta_i - at.theta_i) < 1e-6 &&
                   std::abs(known.phi_i - at.phi_i) < 1e-6;
        });
        if (light == lights.end())
            light = lights.insert(light, {.theta_i = at.theta_i, .phi_i = at.phi_i});
        light->marks.push_back(&mark);
    }
    return lights;
}

/// The disk of one light.
class Disk {
  public:
    Disk(Drawing &drawing, const glm::dvec2 &centre, double radius)
        : drawing_(drawing), centre_(centre), radius_(radius) {}

    glm::dvec2 at(double theta, double phi) const {
        return centre_ + radius_ * theta / (kPi / 2) * glm::dvec2(std::cos(phi), -std::sin(phi));
    }

    /// Whether there are patches of crosses.
    bool draw(const LightMarks &light, bool joined) {
        draw_grid();
        const Marks alone = draw_crowds(light);
        std::vector<glm::dvec2> path;
        for (const HemisphereMark *mark : light.marks)
            if (mark->shape != MarkShape::cross)
                path.push_back(place_of(*mark));
        if (joined && path.size() > 1)
            drawing_.polyline(path, {.colour = "#8a8a8a", .width = 0.6});
        for (const HemisphereMark *mark : alone)
            draw_mark(drawing_, mark->shape, place_of(*mark), mark_radius(), mark->colour,
                      mark->told);
        drawing_.ring(at(light.theta_i, light.phi_i), kLampRadius,
                      {.colour = kLampColour, .width = 2});
        drawing_.write(centre_ - glm::dvec2(0, radius_ + kWarp + 8),
                       "light from theta " + number_text(light.theta_i / kDegree, 4) + "°, phi " +
                           number_text(light.phi_i / kDegree, 4) + "°",
                       {.anchor = "middle"});
        return alone.size() < light.marks.size();
    }

    static void draw_mark(Drawing &drawing, MarkShape shape, const glm::dvec2 &at, double radius,
                          const std::string &colour, const std::string &told) {
        if (shape == MarkShape::dot)
            drawing.dot(at, radius, colour, told);
        else if (shape == MarkShape::square)
            drawing.square(at, radius, colour, told);
        else
            drawing.cross(at, radius, colour, told);
    }

  private:
    double mark_radius() const { return radius_ / 60; }

    glm::dvec2 place_of(const HemisphereMark &mark) const {
        return at(mark.directions.theta_r, mark.directions.phi_r);
    }
    std::vector<glm::dvec2> places_of(const Marks &marks) const {
        std::vector<glm::dvec2> places;
        for (const HemisphereMark *mark : marks)
            places.push_back(place_of(*mark));
        return places;
    }

    /// Draws crosses that would overlap as patches. Returns the marks that are left.
    Marks draw_crowds(const LightMarks &light) {
        Marks alone;
        std::map<std::string, Marks> crosses; // by colour
        for (const HemisphereMark *mark : light.marks)
            (mark->shape == MarkShape::cross ? crosses[mark->colour] : alone).push_back(mark);
        for (const auto &[colour, marks] : crosses) {
            const std::vector<glm::dvec2> places = places_of(marks);
            const Crowds sorted =
                sort_out_crowds(places, kOverlap * mark_radius(), kStep * mark_radius());
            for (const std::size_t i : sorted.alone)
                alone.push_back(marks[i]);
            for (const Numbers &crowd : sorted.crowds)
                drawing_.patch(picked(places, crowd), kPatch * mark_radius(), colour,
                               marks[crowd.front()]->told + "; " +
                                   detail::counted(crowd.size(), "view") + " here");
            if (!sorted.crowds.empty())
                tell_number(
                    marks.size() - sorted.alone.size(), colour,
                    picked(places, *std::ranges::max_element(sorted.crowds, {}, &Numbers::size)));
        }
        return alone;
    }

    /// The number of crosses in patches of a colour, in a corner of the disk, with a line to the
    /// largest.
    void tell_number(std::size_t number, const std::string &colour,
                     const std::vector<glm::dvec2> &largest) {
        bool right = largest.front().x > centre_.x + 1;
        if (labels_[right] > labels_[!right])
            right = !right;
        const double side = right ? 1 : -1;
        const glm::dvec2 corner =
            centre_ + glm::dvec2(side * radius_, radius_ - kLine * labels_[right]++);
        const glm::dvec2 end = *std::ranges::min_element(
            largest, {}, [&](const glm::dvec2 &place) { return glm::distance(place, corner); });
        drawing_.line(corner - glm::dvec2(side * 45, 14), end, {.colour = colour, .width = 0.8});
        drawing_.write(corner, std::to_string(number) + " left out",
                       {.anchor = right ? "end" : "start", .colour = colour});
    }

    void draw_grid() {
        for (const int theta_deg : {30, 60, 90}) {
            drawing_.ring(centre_, radius_ * theta_deg / 90,
                          {.colour = kFaint, .width = theta_deg == 90 ? 1.5 : 0.8});
            drawing_.write(at(theta_deg * kDegree, -75 * kDegree) + glm::dvec2(2, -2),
                           std::to_string(theta_deg) + "°", {.size = 10, .colour = "#666"});
        }
        for (const int phi_deg : {0, 45, 90, 135})
            drawing_.line(at(kPi / 2, phi_deg * kDegree), at(kPi / 2, (phi_deg + 180) * kDegree),
                          {.colour = kFaint, .width = 0.8});
        drawing_.write(at(kPi / 2, 0) + glm::dvec2(5, 4), "weft", {.size = 11, .colour = "#666"});
        drawing_.write(at(kPi / 2, kPi / 2) - glm::dvec2(0, 5), "warp",
                       {.size = 11, .anchor = "middle", .colour = "#666"});
    }

    Drawing &drawing_;
    glm::dvec2 centre_;
    double radius_;
    std::array<int, 2> labels_{}; ///< in the corners at the left and at the right
};

void draw_key(Drawing &drawing, const HemispherePicture &picture, bool patches, glm::dvec2 at) {
    const auto line = [&](const std::string &words) {
        drawing.write(at + glm::dvec2(18, 4), words);
        at.y += kLine;
    };
    for (const KeyLine &entry : picture.key) {
        Disk::draw_mark(drawing, entry.shape, at + glm::dvec2(6, 0), 4, entry.colour, {});
        line(entry.words);
    }
    if (patches) {
        drawing.patch({at + glm::dvec2(6, 0)}, 6, "#666666");
        line("shaded: crosses that would overlap");
    }
    drawing.ring(at + glm::dvec2(6, 0), kLampRadius, {.colour = kLampColour, .width = 2});
    line("the light");
    if (!picture.scale)
        return;
    constexpr int kSteps = 60;
    constexpr double kBar = 240;
    at.y += kLine / 2;
    for (int i = 0; i < kSteps; ++i)
        drawing.rectangle(at + glm::dvec2(kBar * i / kSteps, 0), {kBar / kSteps + 0.5, 14},
                          scale_colour(static_cast<double>(i) / (kSteps - 1)));
    drawing.write(at + glm::dvec2(0, 28), picture.scale->low);
    drawing.write(at + glm::dvec2(kBar / 2, 28), picture.scale->words, {.anchor = "middle"});
    drawing.write(at + glm::dvec2(kBar, 28), picture.scale->high, {.anchor = "end"});
}

} // namespace

std::string draw(const HemispherePicture &picture) {
    std::vector<LightMarks> lights = by_light(picture.marks);
    std::string title = picture.title;
    if (lights.size() > kMostLights) {
        title += "; " + std::to_string(lights.size() - kMostLights) +
                 " more directions of light are not drawn";
        lights.resize(kMostLights);
    }
    const std::size_t columns = std::clamp<std::size_t>(lights.size(), 1, kColumns);
    const std::size_t rows = std::max<std::size_t>((lights.size() + columns - 1) / columns, 1);
    const double radius = columns == 1 ? 250 : columns == 2 ? 190 : 130;
    const glm::dvec2 cell(2 * radius + kWeft, 2 * radius + kLine + kWarp + kMargin);
    const double key_height = kLine * (static_cast<double>(picture.key.size()) + 6);
    Drawing drawing(kMargin + static_cast<double>(columns) * cell.x + kKeyWidth,
                    kTitle + std::max(static_cast<double>(rows) * cell.y, key_height));
    drawing.write({kMargin, 26}, title, {.size = 15});
    bool patches = false;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const std::size_t column = i % columns, row = i / columns;
        const glm::dvec2 corner(kMargin + static_cast<double>(column) * cell.x,
                                kTitle + static_cast<double>(row) * cell.y);
        Disk disk(drawing, corner + glm::dvec2(radius, radius + kLine + kWarp), radius);
        patches |= disk.draw(lights[i], picture.joined);
    }
    draw_key(drawing, picture, patches,
             {kMargin + static_cast<double>(columns) * cell.x + kMargin, kTitle + kLine});
    return drawing.svg();
}

} // namespace tsuya::lab
