#include "files/gltf_alpha.h"

#include "files/words.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::garment {
namespace {

/// False where the alpha is 1 everywhere: no picture, and a factor of 1.
bool lets_light_through(const tinygltf::Material &material) {
    const auto &base = material.pbrMetallicRoughness;
    const bool mode = material.alphaMode == "MASK" || material.alphaMode == "BLEND";
    const bool opaque = base.baseColorTexture.index < 0 &&
                        (base.baseColorFactor.size() != 4 || base.baseColorFactor[3] >= 1.0);
    return mode && !opaque;
}

} // namespace

void GltfAlpha::note(const tinygltf::Model &model, int material, const std::string &panel) {
    const auto index = static_cast<std::size_t>(material);
    if (material >= 0 && index < model.materials.size() &&
        lets_light_through(model.materials[index]))
        panels_[material].push_back(panel);
}

void GltfAlpha::report(const tinygltf::Model &model, std::vector<Finding> &findings) const {
    constexpr std::size_t kShown = 4;
    for (const auto &[number, panels] : panels_) {
        const tinygltf::Material &material = model.materials[static_cast<std::size_t>(number)];
        std::string names;
        for (std::size_t p = 0; p < std::min(panels.size(), kShown); ++p)
            names += (p > 0 ? ", " : "") + in_quotes(panels[p]);
        if (panels.size() > kShown)
            names += " and " + std::to_string(panels.size() - kShown) + " more";
        const std::string name =
            material.name.empty() ? std::to_string(number) : in_quotes(material.name);
        findings.push_back(
            {Severity::warning, "alpha_not_shown",
             "material " + name + " of " + (panels.size() == 1 ? "panel " : "panels ") + names +
                 " has the alphaMode " + material.alphaMode,
             "",
             "its holes and its transparency are not read: shown as whole cloth; a scene may state "
             "opacity = { picture, width_m } for the panel"});
    }
}

} // namespace tsuya::garment
