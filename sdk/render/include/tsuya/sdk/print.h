#pragma once
/// \file
/// Pictures on cloth, laid in metres of cloth: prints in dye, and where there are holes.
///
///     scene.textures = {read_texture("toile.png")};
///     scene.prints = {{.name = "toile", .layers = {{.picture = {0}, .inks = rgb_inks()}},
///                      .placement = {.width = 0.64}}};
///     scene.objects[0].print = PrintIndex{0};

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/scene_index.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// What lies on the cloth beyond the picture's edges.
enum class Repeat {
    tile,   ///< the picture again
    mirror, ///< its mirror image, then the picture again
    once    ///< nothing
};

/// In the order of Repeat.
inline constexpr std::array<std::string_view, 3> kRepeatNames = {"tile", "mirror", "once"};

/// Where a picture lies on the cloth. It follows the cloth's own coordinates (Surface::uv), so its
/// right is along the weft and its top along the warp, across seams as the pieces were cut.
struct Placement {
    double width = 1;        ///< of the picture, metres of cloth, above 0
    glm::dvec2 origin{0, 0}; ///< of its lower left corner, metres
    double turn = 0;         ///< about that corner, radians, counter-clockwise
    Repeat repeat = Repeat::tile;
};

/// One picture in dyes. What it covers has its dyes, the rest what lies below.
struct PrintLayer {
    TextureIndex picture{};
    /// Reflectances as FabricColours::dye. One: the dye of a picture of coverage (a printing
    /// screen). Eight: of the corners of the cube of linear RGB, the number of a corner is r + 2 g
    /// + 4 b; what lies between is interpolated, and so stays in 0..1. See rgb_inks.
    std::vector<Spectrum> inks{};
};

/// Pictures in dye on the face of a cloth, in place of its own dye. All layers lie alike.
struct Print {
    std::string name{};               ///< for messages
    std::vector<PrintLayer> layers{}; ///< the lowest first, at least one
    Placement placement{};
};

/// Where there is cloth and where there are holes: lace, tulle, a net.
struct Opacity {
    TextureIndex picture{}; ///< of coverage: 0 is a hole
    Placement placement{};
};

} // namespace tsuya
