#include "tsuya/sdk/widened_material.h"

#include <algorithm>
#include <memory>

namespace tsuya {
namespace {

// The surface at a slope of a yarn is blurred by this much, before the body's own widening: so the
// body has 0.2 radians.
constexpr double kLeastRoughness = 0.2 / 1.5;

// The share of light that the surface above the coloured part reflects.
float surface_albedo(const Material &material, const glm::vec3 &direction) {
    return material.has_specular() ? std::min(material.specular->albedo_of_light(direction), 1.0f)
                                   : 0.0f;
}

} // namespace

std::optional<Material> widened(const Material &material, const Progress &progress) {
    ModelTables tables;
    return widened(material, tables, progress);
}

std::optional<Material> widened(const Material &material, ModelTables &tables,
                                const Progress &progress) {
    if (!material.specular)
        return std::nullopt;
    if (const auto *const facets = material.specular->get_if<GgxBrdf>()) {
        const std::optional<GgxFacets> wide = facets->widened();
        if (!wide)
            return std::nullopt;
        if (!tables.wide_specular)
            tables.wide_specular = std::make_shared<const Brdf>(GgxBrdf(*wide, progress));
        Material made = material;
        made.specular = tables.wide_specular;
        return made;
    }
    const auto *const yarns = material.specular->get_if<YarnBrdf>();
    if (!yarns || !material.body || yarns->lobes().roughness >= kLeastRoughness)
        return std::nullopt;
    std::shared_ptr<const BodyBrdf> &body =
        material.has_specular() ? tables.wide_body : tables.wide_bare_body;
    if (!body) {
        YarnLobes lobes = yarns->lobes();
        lobes.roughness = kLeastRoughness;
        body = std::make_shared<const BodyBrdf>(
            lobes, [&](const glm::vec3 &d) { return surface_albedo(material, d); }, progress);
    }
    Material made = material;
    made.body = body;
    return made;
}

} // namespace tsuya
