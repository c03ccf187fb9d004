#pragma once
// Between the places of a yarn's path: the Catmull-Rom spline that the filaments follow.

namespace tsuya::lab::detail {

// \param height of the path at an integer place
// \param t from that place to the next, 0 to 1
template <class Height> double spline(const Height &height, int place, double t) {
    const double a = height(place - 1), b = height(place), c = height(place + 1),
                 d = height(place + 2);
    return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

// What it rises by a place there.
template <class Height> double spline_rise(const Height &height, int place, double t) {
    const double a = height(place - 1), b = height(place), c = height(place + 1),
                 d = height(place + 2);
    return 0.5 * (c - a + t * (2 * (2 * a - 5 * b + 4 * c - d) + t * 3 * (3 * (b - c) + d - a)));
}

} // namespace tsuya::lab::detail
