#include "tsuya/scene/export.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/ggx.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

// The facets that come nearest to the fabric; none where it does not reflect.
std::optional<GgxFacets> facets_of(const Fabric &fabric, const Progress &progress) {
    if (!has_specular(fabric))
        return {};
    if (const GgxFacets *const facets = std::get_if<GgxFacets>(&fabric.specular))
        return *facets;
    if (const Bard *const views = views_of(fabric))
        return fit_ggx(*views, progress);
    // Yarns alone, or a table: fitted to what they show of light from straight above
    const std::optional<Brdf> brdf = make_brdf(fabric, "fabrics." + fabric.name, progress);
    ReflectanceTable table{.symmetry = Symmetry::half_turn};
    for (int theta = 0; theta <= 80; theta += 5)
        for (int phi = 0; phi < 180; phi += 10) {
            const double t = theta * kDegree, p = phi * kDegree;
            table.rows.push_back(
                {0, 0, t, p,
                 static_cast<double>(brdf->evaluate({0, 0, 1}, glm::vec3(direction_of(t, p))))});
        }
    return fit_ggx(Bard::fit(table, BardSmoothness{}, fabric.name, progress), progress);
}

// One material has one colour: the mean of weft and warp where they are dyed apart.
// [KhrAnisotropy] The width along the long axis is alpha + strength^2 (1 - alpha).
garment::GltfMaterial material_of(const Fabric &fabric, const std::optional<GgxFacets> &facets) {
    const Spectrum d65 = lamp("D65");
    const auto *const yarns = std::get_if<YarnLobes>(&fabric.specular);
    const glm::dvec3 dyed =
        glm::mix(xyz_of(d65, fabric.colours.dye_of_warp()),
                 xyz_of(d65, fabric.colours.dye_of_weft()), yarns ? yarns->weft_share() : 0.5);
    const glm::dvec3 xyz = dyed / white_of(d65) * srgb_white();
    garment::GltfMaterial material{
        .name = fabric.name,
        .colour = glm::clamp(srgb_from_xyz() * xyz, glm::dvec3(0), glm::dvec3(1)),
        .roughness = 1,
        .ior = 1};
    if (!facets)
        return material;
    const double wide = std::max(facets->alpha_weft, facets->alpha_warp);
    const double narrow = std::min(facets->alpha_weft, facets->alpha_warp);
    material.roughness = std::sqrt(narrow);
    material.anisotropy_strength = narrow < 1 ? std::sqrt((wide - narrow) / (1 - narrow)) : 0.0;
    material.anisotropy_rotation = facets->alpha_warp > facets->alpha_weft ? kHalfPi : 0.0;
    constexpr double kMostF0 = 0.9;
    const double root = std::sqrt(std::min(facets->f0, kMostF0));
    material.ior = facets->refractive_index.value_or((1 + root) / (1 - root));
    return material;
}

double error_of(const Fabric &fabric, const GgxFacets &facets, const Progress &progress) {
    const std::optional<Brdf> truth = make_brdf(fabric, "fabrics." + fabric.name, progress);
    const GgxBrdf seen(facets);
    ReflectanceTable table{.symmetry = Symmetry::none};
    for (int light = 0; light < 15; ++light) {
        const double theta_i = (light < 5 ? 0.0 : light < 10 ? 30.0 : 60.0) * kDegree;
        const double phi_i = light * 37.0 * kDegree;
        for (int theta = 0; theta < 90; theta += 5)
            for (int phi = 0; phi < 360; phi += 10) {
                const double t = theta * kDegree, p = phi * kDegree;
                table.rows.push_back(
                    {theta_i, phi_i, t, p,
                     static_cast<double>(truth->evaluate(glm::vec3(direction_of(theta_i, phi_i)),
                                                         glm::vec3(direction_of(t, p))))});
            }
    }
    return measure_accuracy(
               table,
               [&](const glm::dvec3 &l, const glm::dvec3 &v) {
                   return static_cast<double>(seen.evaluate(glm::vec3(l), glm::vec3(v)));
               },
               progress)
        .mean.l2_cos.value_or(0);
}

} // namespace

std::vector<ExportedFabric> export_glb(const TryOn &job, const std::filesystem::path &file,
                                       const Progress &progress) {
    TryOnScene made = make_try_on_scene(job, progress);
    Scene &scene = made.scene;
    const Object &garment = scene.objects.front();
    const Surface &surface = scene.surfaces[garment.surface.value];
    FabricColours &colours = scene.fabrics[garment.fabric.value].colours;
    if (!job.dyes.empty() && !(job.keeps_own_dye && colours.any_dye()))
        colours.dye_all(parse_dye(job.dyes.front()));
    std::vector<std::uint32_t> fabric_of_panel(panel_count(surface), garment.fabric.value);
    for (const PanelFabric &panel : garment.panels)
        fabric_of_panel[panel.panel] = panel.fabric.value;
    std::vector<ExportedFabric> exported;
    std::vector<garment::GltfMaterial> materials;
    std::vector<std::size_t> material_of_panel;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t index : fabric_of_panel) {
        const auto known = std::find(used.begin(), used.end(), index);
        material_of_panel.push_back(static_cast<std::size_t>(known - used.begin()));
        if (known != used.end())
            continue;
        used.push_back(index);
        const Fabric &fabric = scene.fabrics[index];
        const std::optional<GgxFacets> facets = facets_of(fabric, progress);
        materials.push_back(material_of(fabric, facets));
        exported.push_back({fabric.name, materials.back().roughness,
                            materials.back().anisotropy_strength,
                            facets ? error_of(fabric, *facets, progress) : 0.0});
    }
    garment::write_glb(file, surface, materials, material_of_panel, progress);
    return exported;
}

} // namespace tsuya::scene
