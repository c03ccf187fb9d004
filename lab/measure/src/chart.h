#pragma once
/// \file
/// A frame with axes in a drawing.

#include "drawing.h"

namespace tsuya::lab {

/// What an axis shows.
struct ChartAxis {
    std::string words{}; ///< empty: no words and no ticks
    double low = 0, high = 1;
    bool logarithmic = false; ///< `low` is above 0 then; ticks at powers of ten
};

/// Draws frame, ticks and words when it is made.
class Chart {
  public:
    /// \param corner of the frame, which words and numbers of the axes surround
    Chart(Drawing &drawing, const glm::dvec2 &corner, const glm::dvec2 &size, ChartAxis x,
          ChartAxis y);

    /// Where a pair of values is. Values beyond the axes are at their ends.
    glm::dvec2 at(double x, double y) const;

  private:
    void draw_x() const;
    void draw_y() const;

    Drawing &drawing_;
    glm::dvec2 corner_, size_;
    ChartAxis x_, y_;
};

/// The values at which an axis has its ticks: some 5, of 1, 2 or 5 times a power of ten.
std::vector<double> ticks_of(const ChartAxis &axis);

} // namespace tsuya::lab
