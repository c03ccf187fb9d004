#pragma once
/// \file
/// Materials of glTF that let light through in places.

#include <map>

#include "files/gltf_document.h"
#include "tsuya/garment/mesh_file.h"

namespace tsuya::garment {

/// Collects materials whose alphaMode is MASK or BLEND, and the panels that have them.
class GltfAlpha {
  public:
    /// \param folder of pictures beside the file; empty: there are none
    GltfAlpha(const tinygltf::Model &model, std::filesystem::path folder, std::string name)
        : model_(model), folder_(std::move(folder)), name_(std::move(name)) {}

    /// \param uv of the part, may be empty
    void note(const tinygltf::Primitive &primitive, const std::vector<glm::dvec2> &uv,
              const std::string &panel);
    /// Each such material as an opacity with a finding, or as a finding that says why not.
    void report(MeshFile &file) const;

  private:
    struct Panels {
        std::vector<std::string> names{};
        bool without_uv = false;   ///< one of them
        glm::bvec2 beyond{false};  ///< UVs outside of the picture, along u and along v
        bool vertex_alpha = false; ///< vertex colours with an alpha
    };
    void read_picture(const tinygltf::Texture &texture, FileOpacity &opacity) const;
    /// Repeats the picture as its sampler says. Returns how that differs from the file, may be
    /// empty.
    std::string follow_wrap(const tinygltf::Texture &texture, const glm::bvec2 &beyond,
                            FileOpacity &opacity) const;
    std::string picture_bytes(const tinygltf::Image &image) const;

    const tinygltf::Model &model_;
    std::filesystem::path folder_;
    std::string name_;
    std::map<int, Panels> panels_; ///< by material
};

} // namespace tsuya::garment
