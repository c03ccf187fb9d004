#pragma once
/// \file
/// Lines, dots and words as SVG.

#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab {

/// How a line is drawn.
struct Pen {
    std::string_view colour = "#222";
    double width = 1;
    std::string_view dashes{}; ///< lengths of strokes and gaps: `4 3`; empty: a whole line
};

/// How words are written.
struct Words {
    double size = 12;
    std::string_view anchor = "start"; ///< or middle, end: which part of them is at the place
    std::string_view colour = "#222";
};

/// A place is in units from the upper left corner, x to the right and y down.
class Drawing {
  public:
    Drawing(double width, double height) : size_(width, height) {}

    void line(const glm::dvec2 &from, const glm::dvec2 &to, const Pen &pen = {});
    void polyline(const std::vector<glm::dvec2> &points, const Pen &pen = {});
    void rectangle(const glm::dvec2 &corner, const glm::dvec2 &size, std::string_view colour);
    void ring(const glm::dvec2 &centre, double radius, const Pen &pen = {});
    /// \param told where a pointer rests on it; may be empty
    void dot(const glm::dvec2 &centre, double radius, std::string_view colour,
             std::string_view told = {});
    void square(const glm::dvec2 &centre, double radius, std::string_view colour,
                std::string_view told = {});
    void cross(const glm::dvec2 &centre, double radius, std::string_view colour,
               std::string_view told = {});
    /// What dots of the radius at all these places cover, tinted and outlined.
    void patch(const std::vector<glm::dvec2> &centres, double radius, std::string_view colour,
               std::string_view told = {});
    void write(const glm::dvec2 &at, std::string_view text, const Words &words = {});

    /// The whole picture on white.
    std::string svg() const;

  private:
    void add(const std::string &element, std::string_view told);

    glm::dvec2 size_;
    std::string parts_{};
};

/// Text as it stands in SVG and HTML: `&lt;` for `<`, and so on.
std::string escaped(std::string_view text);

/// From dark blue over green to yellow. \param share from 0 to 1
std::string scale_colour(double share);

} // namespace tsuya::lab
