#pragma once
// How the filaments of one system meet light.

#include <optional>

#include <glm/glm.hpp>

#include "rough_dielectric.h"
#include "rough_surface.h"
#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

// What light meets on its way through a filament.
struct FilamentBody {
    RoughDielectric boundary;
    double depth;      // optical, of a diameter: what the dye absorbs
    double scattering; // events per metre
    double anisotropy; // mean cosine of their turns

    // \param optics with a transmission above 0
    FilamentBody(const FilamentOptics &optics, const RoughSurface &surface,
                 RoughDielectric::Normals normals = RoughDielectric::Normals::visible);
};

// The direction after a particle of delustrant. \param g mean cosine of the turn
glm::vec3 scattered(const glm::vec3 &direction, double g, Random &random);

struct FilamentMatter {
    RoughSurface surface;
    std::optional<FilamentBody> body{}; // none: what enters is lost

    explicit FilamentMatter(const FilamentOptics &optics,
                            RoughDielectric::Normals normals = RoughDielectric::Normals::visible);
};

} // namespace tsuya::lab
