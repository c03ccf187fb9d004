#pragma once
// A flat patch under the lamp of a goniometer, rendered once for each pair of directions: what a
// virtual camera sees instead of a number.

#include "tsuya/lab/virtual_camera.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya::test {

struct RenderedPatch {
    Fabric cloth{};
    double lamp_angle = 0.05 * kDegree;  ///< full, of a square lamp seen from the cloth
    double lamp_m = 0.6, camera_m = 0.5; ///< distances from the cloth
    double pixel_m = 0.05e-3;            ///< on the cloth seen from straight above
    int samples = 4;                     ///< of a pixel

    /// As VirtualScene::picture.
    Image render(const lab::PlannedFrame &frame, int width, int height) const;
};

} // namespace tsuya::test
