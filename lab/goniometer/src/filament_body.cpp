#include "filament_body.h"

#include <cmath>

namespace tsuya::lab {

FilamentBody::FilamentBody(const FilamentOptics &optics, const RoughSurface &surface,
                           RoughDielectric::Normals normals)
    : boundary(optics, surface, normals), depth(-std::log(optics.transmission)) {}

FilamentMatter::FilamentMatter(const FilamentOptics &optics, RoughDielectric::Normals normals)
    : surface(optics) {
    if (optics.transmission > 0)
        body.emplace(optics, surface, normals);
}

} // namespace tsuya::lab
