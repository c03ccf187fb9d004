#pragma once
/// \file
/// A garment or body as the renderer takes it: triangles with a yarn frame at every vertex.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// Indexed triangles. Every array of vertex data is either empty or as long as `position`. Vertices
/// where frames or UVs differ (seams between panels) are separate vertices at exactly equal
/// positions. Counter-clockwise triangles look outward along `normal`.
struct Surface {
    std::vector<glm::dvec3> position{}; ///< metres
    std::vector<glm::vec3> normal{};    ///< unit, of the limit surface
    std::vector<glm::vec3>
        warp{}; ///< unit dP/dv of the cloth, perpendicular to normal; empty: no cloth
    std::vector<glm::vec3>
        weft{};                  ///< unit dP/du of the cloth, perpendicular to normal; with warp it
                                 ///< encloses 90 degrees less the shear of the drape; may be empty
    std::vector<glm::vec2> uv{}; ///< metres of cloth
    std::vector<glm::uvec3> triangle{};
    std::vector<std::uint32_t> panel{}; ///< per triangle; empty: all of panel 0
    std::vector<std::string> panel_name{};
};

/// Number of panels that its triangles or names have, at least 1.
std::size_t panel_count(const Surface &surface);

/// Throws Error naming `where` if the surface breaks its own rules: index out of range, array
/// lengths, not finite, no triangle.
void check_surface(const Surface &surface, const std::string &where);

} // namespace tsuya
