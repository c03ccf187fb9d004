#include "files/gltf_extensions.h"

#include <algorithm>
#include <array>

#include "files/words.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Those that say where vertices and UVs are.
constexpr std::array<std::string_view, 4> kGeometry{
    "KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_mesh_quantization",
    "KHR_texture_transform"};

/// Those about what is not read at all: materials, images and lights.
constexpr std::array<std::string_view, 6> kPassedOver{"KHR_materials_",   "KHR_texture_basisu",
                                                      "EXT_texture_webp", "EXT_texture_avif",
                                                      "MSFT_texture_dds", "KHR_lights_punctual"};

bool is_known(std::string_view extension) {
    return std::find(kGeometry.begin(), kGeometry.end(), extension) != kGeometry.end() ||
           std::any_of(kPassedOver.begin(), kPassedOver.end(),
                       [&](std::string_view prefix) { return extension.starts_with(prefix); });
}

} // namespace

void check_required_extensions(const tinygltf::Model &model, const std::string &name) {
    std::string known;
    for (const std::string_view extension : kGeometry)
        known += (known.empty() ? "" : ", ") + std::string(extension);
    Problems problems;
    for (const std::string &extension : model.extensionsRequired)
        problems.need(is_known(extension),
                      "the file requires the extension " + in_quotes(extension) +
                          ", which is not known",
                      name + ": extensionsRequired",
                      "expected an export without it; known are " + known +
                          ", and those of materials, textures and lights");
    problems.throw_if_any();
}

} // namespace tsuya::garment
