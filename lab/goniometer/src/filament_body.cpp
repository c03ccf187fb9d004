#include "filament_body.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::lab {

FilamentBody::FilamentBody(const FilamentOptics &optics, const RoughSurface &surface,
                           RoughDielectric::Normals normals)
    : boundary(optics, surface, normals), depth(-std::log(optics.transmission)),
      scattering(optics.scattering_length > 0 ? 1 / optics.scattering_length : 0),
      anisotropy(optics.scattering_anisotropy) {}

FilamentMatter::FilamentMatter(const FilamentOptics &optics, RoughDielectric::Normals normals)
    : surface(optics) {
    if (optics.transmission > 0)
        body.emplace(optics, surface, normals);
}

glm::vec3 scattered(const glm::vec3 &direction, double g, Random &random) {
    // [Henyey] Eq. 2, inverted
    const double u = 2.0 * random.unit() - 1, share = (1 - g * g) / (1 + g * u);
    const double cosine =
        std::abs(g) < 1e-3 ? u : std::clamp((1 + g * g - share * share) / (2 * g), -1.0, 1.0);
    const double sine = std::sqrt(1 - cosine * cosine), phi = 2 * kPi * random.unit();
    return make_frame(direction).to_world({sine * std::cos(phi), sine * std::sin(phi), cosine});
}

} // namespace tsuya::lab
