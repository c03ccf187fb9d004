#include "files/gltf_hints.h"
#include "tsuya/sdk/angle.h"

#include <cmath>

namespace tsuya::garment {
namespace {

using tinygltf::Value;

double number_or(const Value &object, const char *key, double otherwise) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber())
        return otherwise;
    const double value = object.Get(key).GetNumberAsDouble();
    return std::isfinite(value) ? value : otherwise;
}

template <int N>
glm::vec<N, double> vector_or(const Value &object, const char *key,
                              const glm::vec<N, double> &otherwise) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsArray() ||
        object.Get(key).ArrayLen() != static_cast<std::size_t>(N))
        return otherwise;
    glm::vec<N, double> result;
    for (int i = 0; i < N; ++i) {
        const Value &entry = object.Get(key).Get(i);
        if (!entry.IsNumber() || !std::isfinite(entry.GetNumberAsDouble()))
            return otherwise;
        result[i] = entry.GetNumberAsDouble();
    }
    return result;
}

const tinygltf::Material *find_material(const tinygltf::Model &model, int index) {
    if (index < 0 || static_cast<std::size_t>(index) >= model.materials.size())
        return nullptr;
    return &model.materials[static_cast<std::size_t>(index)];
}

const Value *find_extension(const tinygltf::ExtensionMap &extensions, const char *name) {
    const auto it = extensions.find(name);
    return it != extensions.end() && it->second.IsObject() ? &it->second : nullptr;
}

} // namespace

glm::dvec2 GltfUv::apply(const glm::dvec2 &uv) const {
    // [KhrTextureTransform] T * R * S, with R = [[c, s], [-s, c]]
    const glm::dvec2 t = uv * scale;
    const double c = std::cos(rotation), s = std::sin(rotation);
    return offset + glm::dvec2(c * t.x + s * t.y, -s * t.x + c * t.y);
}

GltfUv gltf_uv(const tinygltf::Model &model, int index) {
    GltfUv uv;
    const tinygltf::Material *const material = find_material(model, index);
    if (!material || material->pbrMetallicRoughness.baseColorTexture.index < 0)
        return uv;
    const tinygltf::TextureInfo &texture = material->pbrMetallicRoughness.baseColorTexture;
    double set = texture.texCoord;
    if (const Value *const moved = find_extension(texture.extensions, "KHR_texture_transform")) {
        set = number_or(*moved, "texCoord", set);
        uv.offset = vector_or<2>(*moved, "offset", uv.offset);
        uv.scale = vector_or<2>(*moved, "scale", uv.scale);
        uv.rotation = number_or(*moved, "rotation", 0.0);
    }
    constexpr double kMostSets = 64;
    if (set >= 0 && set < kMostSets)
        uv.attribute = "TEXCOORD_" + std::to_string(static_cast<int>(set));
    return uv;
}

std::optional<FabricHint> gltf_hint(const tinygltf::Model &model, int index) {
    const tinygltf::Material *const material = find_material(model, index);
    if (!material)
        return std::nullopt;
    const Value *const anisotropy =
        find_extension(material->extensions, "KHR_materials_anisotropy");
    const Value *const sheen = find_extension(material->extensions, "KHR_materials_sheen");
    if (!anisotropy && !sheen)
        return std::nullopt;
    FabricHint hint{.material = material->name};
    if (anisotropy) {
        hint.anisotropy_strength = number_or(*anisotropy, "anisotropyStrength", 0.0);
        // [KhrAnisotropy] the rotation is counter-clockwise from the tangent; threads lie across.
        hint.thread_angle = number_or(*anisotropy, "anisotropyRotation", 0.0) + 0.5 * kPi;
    }
    if (sheen) {
        hint.sheen_colour = glm::vec3(vector_or<3>(*sheen, "sheenColorFactor", glm::dvec3(0.0)));
        hint.sheen_roughness = number_or(*sheen, "sheenRoughnessFactor", 0.0);
    }
    return hint;
}

} // namespace tsuya::garment
