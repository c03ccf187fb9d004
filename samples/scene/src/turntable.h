#pragma once
// What turns about a vertical: a figure before a camera and lights that stand still, a mesh at its
// place.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/surface.h"

namespace tsuya::scene {

// About the vertical line through `axis`, as below.
glm::dvec3 turned(const glm::dvec3 &point, const glm::dvec3 &axis, double angle);

// About the vertical line through `axis`, counter-clockwise as seen from above: the figure's right
// comes to the place of its front. \param angle radians
Surface turned(const Surface &surface, const glm::dvec3 &axis, double angle);

// Where points are in all of `views` even turns: what a camera has to see.
std::vector<glm::dvec3> all_turns(const std::vector<glm::dvec3> &points, const glm::dvec3 &axis,
                                  int views);

// Of the view: even steps of a whole turn, radians.
double turn_of(int view, int views);

} // namespace tsuya::scene
