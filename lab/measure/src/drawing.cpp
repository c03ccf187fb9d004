#include "drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "tsuya/lab/number_text.h"

namespace tsuya::lab {
namespace {

/// A hundredth of a unit is enough.
std::string place(double value) { return number_text(std::round(value * 100) / 100, 8); }

std::string attribute(const char *name, std::string_view value) {
    return std::string(" ") + name + "=\"" + escaped(value) + "\"";
}

std::string stroke(const Pen &pen) {
    std::string text =
        attribute("stroke", pen.colour) + attribute("stroke-width", place(pen.width));
    return pen.dashes.empty() ? text : text + attribute("stroke-dasharray", pen.dashes);
}

std::string pair(const glm::dvec2 &p) { return place(p.x) + " " + place(p.y); }

} // namespace

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text)
        switch (c) {
        case '&':
            result += "&amp;";
            break;
        case '<':
            result += "&lt;";
            break;
        case '>':
            result += "&gt;";
            break;
        case '"':
            result += "&quot;";
            break;
        case '\'':
            result += "&#39;";
            break;
        default:
            if (static_cast<unsigned char>(c) >= ' ' || c == '\n' || c == '\t')
                result += c;
        }
    return result;
}

std::string scale_colour(double share) {
    constexpr std::array<glm::dvec3, 5> kStops{
        {{58, 16, 92}, {50, 88, 160}, {36, 148, 132}, {124, 198, 70}, {250, 226, 30}}};
    const double at = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
    const auto low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const glm::dvec3 colour = glm::mix(kStops[low], kStops[low + 1], at - static_cast<double>(low));
    std::array<char, 8> text{};
    std::snprintf(
        text.data(), text.size(), "#%02x%02x%02x", static_cast<unsigned>(std::lround(colour.r)),
        static_cast<unsigned>(std::lround(colour.g)), static_cast<unsigned>(std::lround(colour.b)));
    return text.data();
}

void Drawing::add(const std::string &element, std::string_view told) {
    parts_ += told.empty() ? element + "/>\n"
                           : element + "><title>" + escaped(told) + "</title></" +
                                 element.substr(1, element.find(' ') - 1) + ">\n";
}

void Drawing::line(const glm::dvec2 &from, const glm::dvec2 &to, const Pen &pen) {
    polyline({from, to}, pen);
}

void Drawing::polyline(const std::vector<glm::dvec2> &points, const Pen &pen) {
    std::string path;
    for (const glm::dvec2 &point : points)
        path += (path.empty() ? "M" : "L") + pair(point);
    add("<path" + attribute("d", path) + attribute("fill", "none") + stroke(pen), {});
}

void Drawing::rectangle(const glm::dvec2 &corner, const glm::dvec2 &size, std::string_view colour) {
    add("<rect" + attribute("x", place(corner.x)) + attribute("y", place(corner.y)) +
            attribute("width", place(size.x)) + attribute("height", place(size.y)) +
            attribute("fill", colour),
        {});
}

void Drawing::ring(const glm::dvec2 &centre, double radius, const Pen &pen) {
    add("<circle" + attribute("cx", place(centre.x)) + attribute("cy", place(centre.y)) +
            attribute("r", place(radius)) + attribute("fill", "none") + stroke(pen),
        {});
}

void Drawing::dot(const glm::dvec2 &centre, double radius, std::string_view colour,
                  std::string_view told) {
    add("<circle" + attribute("cx", place(centre.x)) + attribute("cy", place(centre.y)) +
            attribute("r", place(radius)) + attribute("fill", colour),
        told);
}

void Drawing::square(const glm::dvec2 &centre, double radius, std::string_view colour,
                     std::string_view told) {
    add("<rect" + attribute("x", place(centre.x - radius)) +
            attribute("y", place(centre.y - radius)) + attribute("width", place(2 * radius)) +
            attribute("height", place(2 * radius)) + attribute("fill", colour),
        told);
}

void Drawing::cross(const glm::dvec2 &centre, double radius, std::string_view colour,
                    std::string_view told) {
    const glm::dvec2 a(radius, radius), b(radius, -radius);
    add("<path" +
            attribute("d", "M" + pair(centre - a) + "L" + pair(centre + a) + "M" +
                               pair(centre - b) + "L" + pair(centre + b)) +
            stroke({.colour = colour, .width = radius / 2}),
        told);
}

void Drawing::patch(const std::vector<glm::dvec2> &centres, double radius, std::string_view colour,
                    std::string_view told) {
    // A stroke of no length with round ends is a dot; one path paints where they overlap once.
    std::string dots;
    for (const glm::dvec2 &centre : centres)
        dots += "M" + pair(centre) + "h0";
    const auto layer = [&](double r, std::string_view paint, const std::string &more) {
        add("<path" + attribute("d", dots) + stroke({.colour = paint, .width = 2 * r}) + more, {});
    };
    parts_ += "<g stroke-linecap=\"round\">";
    if (!told.empty())
        parts_ += "<title>" + escaped(told) + "</title>";
    layer(radius, colour, "");
    layer(radius - 1, "#ffffff", "");
    layer(radius - 1, colour, attribute("stroke-opacity", "0.25"));
    parts_ += "</g>\n";
}

void Drawing::write(const glm::dvec2 &at, std::string_view text, const Words &words) {
    parts_ += "<text" + attribute("x", place(at.x)) + attribute("y", place(at.y)) +
              attribute("font-size", place(words.size)) + attribute("text-anchor", words.anchor) +
              attribute("fill", words.colour) + ">" + escaped(text) + "</text>\n";
}

std::string Drawing::svg() const {
    return "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("width", place(size_.x)) +
           attribute("height", place(size_.y)) + attribute("viewBox", "0 0 " + pair(size_)) +
           " font-family=\"DejaVu Sans, sans-serif\">\n"
           "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n" +
           parts_ + "</svg>\n";
}

} // namespace tsuya::lab
