#pragma once
/// \file
/// What is rendered: surfaces with fabrics, lights in groups, a camera. Parts refer to each other
/// by typed index.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/camera.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/light.h"
#include "tsuya/sdk/print.h"
#include "tsuya/sdk/scene_index.h"
#include "tsuya/sdk/surface.h"
#include "tsuya/sdk/texture.h"

namespace tsuya {

inline constexpr double kLargestLength = 1e9; ///< of every coordinate, metres

/// The fabric of one panel of an object, in place of the object's own.
struct PanelFabric {
    std::uint32_t panel = 0; ///< of the surface's
    FabricIndex fabric{};
    std::optional<FabricIndex> back{};      ///< as Object::back
    std::optional<PrintIndex> print{};      ///< as Object::print
    std::optional<PrintIndex> back_print{}; ///< as Object::back_print
    std::optional<OpacityIndex> opacity{};  ///< as Object::opacity
};

/// A surface dressed in a fabric.
struct Object {
    std::string name{};
    SurfaceIndex surface{};
    FabricIndex fabric{};
    /// What is seen from behind (a lining), with the grain of the face. Empty: the fabric's own
    /// back: where warp floats on the face, weft floats behind, so it is the face with the two yarn
    /// systems exchanged. Cloth without yarn directions has two equal sides.
    std::optional<FabricIndex> back{};
    /// What is printed on the fabric, in place of its dye; it shows on the fabric's own back as
    /// well. For surfaces with UVs.
    std::optional<PrintIndex> print{};
    std::optional<PrintIndex> back_print{}; ///< on `back`, where that is another fabric
    /// Where the cloth has holes; empty: nowhere. For surfaces with UVs. Paths go through a hole or
    /// not by chance, light to a point is weakened by what lies on its way.
    std::optional<OpacityIndex> opacity{};
    std::vector<PanelFabric> panels{}; ///< each panel once; those not here are as the object
    /// It is what the picture is about: counted by the AOV `garment`, by which pictures are
    /// compared and exposed.
    bool garment = false;
};

/// Light from infinitely far. With a picture: latitude-longitude, row 0 towards +y, the centre
/// column towards +z; scaled by `radiance`. Its first channel is of `group`; of a coloured
/// environment the next ones are of groups with lamps of their own.
struct Environment {
    double radiance = 1.0; ///< 0 to kLargestRadiance, times every value of the picture too
    std::optional<Image> picture{};
    LightGroupIndex group{};
    bool visible = true; ///< to the camera directly
    double turn = 0;     ///< of the picture about +y, from +z to +x, radians
    /// Of the picture's second channel and on; kMostEnvironmentGroups at most, with `group`.
    std::vector<LightGroupIndex> further_groups{};
};

inline constexpr std::size_t kMostEnvironmentGroups = 4;

/// All that is rendered. Parts refer to each other by index. Positions are in metres.
struct Scene {
    std::vector<Surface> surfaces{};
    std::vector<Fabric> fabrics{};
    /// Fabrics whose dyes are chosen in the finished picture: its channels are depths of dye, see
    /// dye_depths.h and plan. It shows the dyes of the fabrics until others are set.
    std::vector<FabricIndex> open_dyes{};
    std::vector<Texture> textures{};
    std::vector<Print> prints{};
    std::vector<Opacity> opacities{};
    std::vector<Object> objects{};
    std::vector<std::string> light_groups{
        "key"}; ///< each gets its own transport, and so its own lamp
    std::vector<Light> lights{};
    std::optional<Environment> environment{};
    Camera camera{};
};

/// Which fabrics dress something, in the order of Scene::fabrics; indices out of range are left
/// out.
std::vector<bool> fabrics_in_use(const Scene &scene);

/// Throws Error with every broken rule, also of fabrics in use: an index out of range, no light, no
/// object, a light without area, a radiance or length out of bounds, a camera that looks nowhere.
void check_scene(const Scene &scene);

} // namespace tsuya
