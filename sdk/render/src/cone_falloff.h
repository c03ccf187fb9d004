#pragma once
// How the intensity of a spot falls off towards the edge of its cone.

namespace tsuya {

// Share of the intensity along the axis: a cubic in the cosine of the angle from the axis, smooth
// at both ends. Its mean over the cosines between is one half.
template <class T> T cone_falloff(T cosine, T cos_full, T cos_cone) {
    if (cosine >= cos_full || cos_full <= -1) // rounding may go below -1
        return 1;
    if (!(cosine > cos_cone))
        return 0;
    const T x = (cosine - cos_cone) / (cos_full - cos_cone);
    return x * x * (3 - 2 * x);
}

} // namespace tsuya
