#pragma once
/// \file
/// How the parts of a scene refer to each other.

#include <cstdint>

namespace tsuya {

/// An index into the array of that kind in a Scene.
template <class Tag> struct Index {
    std::uint32_t value = 0;
    bool operator==(const Index &) const = default;
};
/// Into Scene::surfaces.
using SurfaceIndex = Index<struct SurfaceTag>;
/// Into Scene::fabrics.
using FabricIndex = Index<struct FabricTag>;
/// Into Scene::textures.
using TextureIndex = Index<struct TextureTag>;
/// Into Scene::prints.
using PrintIndex = Index<struct PrintTag>;
/// Into Scene::opacities.
using OpacityIndex = Index<struct OpacityTag>;
/// Into Scene::light_groups.
using LightGroupIndex = Index<struct LightGroupTag>;

} // namespace tsuya
