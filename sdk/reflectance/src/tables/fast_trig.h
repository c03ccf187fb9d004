#pragma once
// Angles without a call into the math library: polynomials fitted at Chebyshev nodes, inlined and
// vectorised. Errors against double over the whole range: angle_of 3e-7 relative, sine_cosine 3e-7.

#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {

// Angle in [0, pi] of a point with sine >= 0; 0 at the origin.
inline float angle_of(float sine, float cosine) {
    const float x = std::fabs(cosine);
    const float larger = sine > x ? sine : x, smaller = sine > x ? x : sine;
    const float t = larger > 0 ? smaller / larger : 0.0f, t2 = t * t;
    float p = 0.00276628346f;
    p = p * t2 - 0.015731249f;
    p = p * t2 + 0.0421376228f;
    p = p * t2 - 0.0745685473f;
    p = p * t2 + 0.106183708f;
    p = p * t2 - 0.141977981f;
    p = p * t2 + 0.199918717f;
    p = p * t2 - 0.333330363f;
    p = p * t2 + 1.0f;
    float angle = t * p;
    angle = sine > x ? kHalfPiF - angle : angle;
    return cosine < 0 ? kPiF - angle : angle;
}

struct SineCosine {
    float sine, cosine;
};

// For an angle in [0, pi]; the sine keeps its relative precision towards 0.
inline SineCosine sine_cosine(float angle) {
    const float rest = kPiF - angle;
    const bool behind = rest < angle;
    const float x = behind ? rest : angle, x2 = x * x;
    float s = 2.60510774e-06f;
    s = s * x2 - 0.000198090172f;
    s = s * x2 + 0.00833304971f;
    s = s * x2 - 0.166666582f;
    s = s * x2 + 1.0f;
    float c = -2.60506567e-07f;
    c = c * x2 + 2.47601092e-05f;
    c = c * x2 - 0.00138883607f;
    c = c * x2 + 0.0416666344f;
    c = c * x2 - 0.5f;
    c = c * x2 + 1.0f;
    return {x * s, behind ? -c : c};
}

} // namespace tsuya
