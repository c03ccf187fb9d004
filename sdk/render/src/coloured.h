#pragma once
// A material's response in its colours.

#include "channels.h"
#include "shading.h"
#include "traced_scene.h"

namespace tsuya {

// A response in its colours, times a number.
template <int K>
Channels<K> coloured(const Response &response, const Colours &colours, float scale) {
    Channels<K> result;
    for (std::size_t k = 0; k < K; ++k)
        result.v[k] = (colours.dye[k] * response.diffuse + colours.warp[k] * response.warp) * scale;
    if (response.weft > 0)
        result.add(colours.weft, response.weft * scale);
    if (response.warp_body > 0)
        result.add(colours.warp_body, response.warp_body * scale);
    if (response.weft_body > 0)
        result.add(colours.weft_body, response.weft_body * scale);
    if (response.transmitted > 0)
        result.add(colours.transmittance, response.transmitted * scale);
    return result;
}

// What the surface of the fibres reflects of a response, in its colours, times a number.
template <int K>
Channels<K> coloured_surface(const Response &response, const Colours &colours, float scale) {
    Channels<K> result;
    result.add(colours.warp, response.warp * scale);
    if (response.weft > 0)
        result.add(colours.weft, response.weft * scale);
    return result;
}

} // namespace tsuya
