#include "tsuya/color/rgb_primaries.h"

#include <glm/matrix.hpp>

#include "tsuya/color/observer.h"

namespace tsuya {

glm::dmat3 xyz_from_rgb(const RgbPrimaries &p) {
    const glm::dmat3 primaries(xyz_of_chromaticity(p.red), xyz_of_chromaticity(p.green),
                               xyz_of_chromaticity(p.blue));
    const glm::dvec3 scale = glm::inverse(primaries) * xyz_of_chromaticity(p.white);
    return {primaries[0] * scale.x, primaries[1] * scale.y, primaries[2] * scale.z};
}

} // namespace tsuya
