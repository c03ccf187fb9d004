#include "files/gltf_alpha.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "files/png_alpha.h"
#include "files/words.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Why a picture's alpha is not read.
struct NotShown {
    std::string why;
};

double factor_of(const tinygltf::Material &material) {
    const std::vector<double> &factor = material.pbrMetallicRoughness.baseColorFactor;
    return factor.size() == 4 ? std::clamp(factor[3], 0.0, 1.0) : 1.0;
}

/// False where the alpha is 1 everywhere: no picture, and a factor of 1.
bool lets_light_through(const tinygltf::Material &material) {
    const bool mode = material.alphaMode == "MASK" || material.alphaMode == "BLEND";
    return mode &&
           (material.pbrMetallicRoughness.baseColorTexture.index >= 0 || factor_of(material) < 1.0);
}

std::string list_of(const std::vector<std::string> &panels) {
    constexpr std::size_t kShown = 4;
    std::string names = panels.size() == 1 ? "panel " : "panels ";
    for (std::size_t p = 0; p < std::min(panels.size(), kShown); ++p)
        names += (p > 0 ? ", " : "") + in_quotes(panels[p]);
    if (panels.size() > kShown)
        names += " and " + std::to_string(panels.size() - kShown) + " more";
    return names;
}

/// `%20` and the like in an address.
std::string decoded(const std::string &uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        unsigned int code = 0;
        if (uri[i] == '%' && i + 2 < uri.size() &&
            std::sscanf(uri.substr(i + 1, 2).c_str(), "%2x", &code) == 1) {
            text += static_cast<char>(code);
            i += 2;
        } else {
            text += uri[i];
        }
    }
    return text;
}

} // namespace

void GltfAlpha::note(const tinygltf::Primitive &primitive, const std::vector<glm::dvec2> &uv,
                     const std::string &panel) {
    const auto index = static_cast<std::size_t>(primitive.material);
    if (primitive.material < 0 || index >= model_.materials.size() ||
        !lets_light_through(model_.materials[index]))
        return;
    Panels &of = panels_[primitive.material];
    of.names.push_back(panel);
    of.without_uv = of.without_uv || uv.empty();
    for (int axis : {0, 1})
        of.beyond[axis] = of.beyond[axis] || std::ranges::any_of(uv, [&](const glm::dvec2 &t) {
                              return t[axis] < 0.0 || t[axis] > 1.0;
                          });
    const auto colour = primitive.attributes.find("COLOR_0");
    if (colour != primitive.attributes.end() && colour->second >= 0 &&
        static_cast<std::size_t>(colour->second) < model_.accessors.size())
        of.vertex_alpha =
            of.vertex_alpha ||
            model_.accessors[static_cast<std::size_t>(colour->second)].type == TINYGLTF_TYPE_VEC4;
}

std::string GltfAlpha::picture_bytes(const tinygltf::Image &image) const {
    if (image.bufferView >= 0) {
        if (static_cast<std::size_t>(image.bufferView) >= model_.bufferViews.size())
            throw NotShown{"its picture names no buffer view"};
        const tinygltf::BufferView &view =
            model_.bufferViews[static_cast<std::size_t>(image.bufferView)];
        return std::string(
            buffer_bytes(model_, view.buffer, view.byteOffset, view.byteLength, name_ + ": image"));
    }
    if (!image.image.empty()) // of a data URI
        return {image.image.begin(), image.image.end()};
    const std::filesystem::path path = folder_ / decoded(image.uri);
    std::error_code code;
    if (folder_.empty() || !lies_inside(path, folder_) ||
        !std::filesystem::is_regular_file(path, code))
        throw NotShown{"there is no picture " + in_quotes(image.uri) + " beside the file"};
    return read_file(path);
}

void GltfAlpha::read_picture(const tinygltf::Texture &texture, FileOpacity &opacity) const {
    if (texture.source < 0 || static_cast<std::size_t>(texture.source) >= model_.images.size())
        throw NotShown{"its picture is in a format of an extension"};
    const tinygltf::Image &image = model_.images[static_cast<std::size_t>(texture.source)];
    std::string bytes = picture_bytes(image);
    switch (alpha_in(bytes)) {
    case PictureAlpha::has:
        opacity.picture = std::move(bytes);
        opacity.picture_name =
            name_ + ": " +
            (image.uri.empty() ? "image " + std::to_string(texture.source) : in_quotes(image.uri));
        break;
    case PictureAlpha::has_not:
        break; // 1 everywhere
    case PictureAlpha::unknown:
        throw NotShown{"its picture is neither PNG nor JPEG"};
    }
}

std::string GltfAlpha::follow_wrap(const tinygltf::Texture &texture, const glm::bvec2 &beyond,
                                   FileOpacity &opacity) const {
    std::array<int, 2> wrap{TINYGLTF_TEXTURE_WRAP_REPEAT, TINYGLTF_TEXTURE_WRAP_REPEAT};
    const auto sampler = static_cast<std::size_t>(texture.sampler);
    if (texture.sampler >= 0 && sampler < model_.samplers.size())
        wrap = {model_.samplers[sampler].wrapS, model_.samplers[sampler].wrapT};
    // Of two directions that differ, one that UVs leave the picture in, and that is not clamped
    const bool by_t = beyond.y && (!beyond.x || wrap[0] == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE);
    opacity.mirrored_repeat = wrap[by_t ? 1 : 0] == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT;
    const int shown = opacity.mirrored_repeat ? TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT
                                              : TINYGLTF_TEXTURE_WRAP_REPEAT;
    std::string remark;
    for (const std::size_t axis : {0u, 1u})
        if (beyond[static_cast<int>(axis)] && wrap[axis] != shown)
            remark += std::string(remark.empty() ? ", " : " and ") +
                      (opacity.mirrored_repeat ? "mirrored" : "repeated") + " along " +
                      (axis == 0 ? "u" : "v") + " beyond the picture, where the file " +
                      (wrap[axis] == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE     ? "has its edge"
                       : wrap[axis] == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ? "mirrors it"
                                                                             : "repeats it");
    return remark;
}

void GltfAlpha::report(MeshFile &file) const {
    for (const auto &[number, panels] : panels_) {
        const tinygltf::Material &material = model_.materials[static_cast<std::size_t>(number)];
        const std::string name =
            material.name.empty() ? std::to_string(number) : in_quotes(material.name);
        FileOpacity opacity{.material =
                                material.name.empty() ? std::to_string(number) : material.name,
                            .panels = panels.names,
                            .factor = factor_of(material)};
        if (material.alphaMode == "MASK")
            opacity.cutoff = material.alphaCutoff;
        Finding finding{Severity::note, "alpha_opacity",
                        "material " + name + " of " + list_of(panels.names) +
                            " has the alphaMode " + material.alphaMode,
                        "", "its alpha becomes the opacity of these panels"};
        const int index = material.pbrMetallicRoughness.baseColorTexture.index;
        try {
            if (panels.vertex_alpha)
                throw NotShown{"it is in the colours of vertices, too"};
            if (index >= 0) {
                if (static_cast<std::size_t>(index) >= model_.textures.size())
                    throw NotShown{"it names no texture of the file"};
                const tinygltf::Texture &texture = model_.textures[static_cast<std::size_t>(index)];
                read_picture(texture, opacity);
                if (!opacity.picture.empty() && panels.without_uv)
                    throw NotShown{"a panel has no UVs"};
                finding.action += follow_wrap(texture, panels.beyond, opacity);
            }
            if (opacity.picture.empty() && opacity.factor >= 1.0)
                continue; // whole cloth
            file.opacities.push_back(std::move(opacity));
        } catch (const NotShown &reason) {
            finding.severity = Severity::warning;
            finding.key = "alpha_not_shown";
            finding.action = "shown as whole cloth: " + reason.why +
                             "; a scene may state opacity = { picture, width_m } for the panel";
        }
        file.findings.push_back(std::move(finding));
    }
}

} // namespace tsuya::garment
