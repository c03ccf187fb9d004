#include "files/gltf_document.h"

#include <cstring>
#include <sstream>

#include "mesh/stop.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

using tinygltf::Value;

class GlbWriter {
  public:
    GlbWriter(const Surface &surface, const std::vector<GltfMaterial> &materials,
              const std::vector<std::size_t> &material_of_panel, const Progress &progress)
        : surface_(surface), material_of_panel_(material_of_panel), progress_(progress) {
        model_.asset.version = "2.0";
        model_.asset.generator = "Tsuya";
        model_.buffers.emplace_back();
        for (const GltfMaterial &material : materials)
            add_material(material);
        add_vertices();
        add_panels();
        tinygltf::Node node;
        node.name = "garment";
        node.mesh = 0;
        model_.meshes.push_back(mesh_);
        model_.nodes.push_back(node);
        model_.scenes.emplace_back().nodes = {0};
        model_.defaultScene = 0;
    }

    std::string bytes() {
        std::ostringstream out;
        tinygltf::TinyGLTF().WriteGltfSceneToStream(&model_, out, false, true);
        return std::move(out).str();
    }

  private:
    void extend(tinygltf::Material &material, const char *name, Value::Object values) {
        material.extensions[name] = Value(std::move(values));
        if (std::find(model_.extensionsUsed.begin(), model_.extensionsUsed.end(), name) ==
            model_.extensionsUsed.end())
            model_.extensionsUsed.emplace_back(name);
    }

    void add_material(const GltfMaterial &from) {
        tinygltf::Material material;
        material.name = from.name;
        material.doubleSided = true;
        tinygltf::PbrMetallicRoughness &pbr = material.pbrMetallicRoughness;
        pbr.baseColorFactor = {from.colour.x, from.colour.y, from.colour.z, 1};
        pbr.metallicFactor = 0;
        pbr.roughnessFactor = from.roughness;
        extend(material, "KHR_materials_ior", {{"ior", Value(from.ior)}});
        if (from.anisotropy_strength > 0)
            extend(material, "KHR_materials_anisotropy",
                   {{"anisotropyStrength", Value(from.anisotropy_strength)},
                    {"anisotropyRotation", Value(from.anisotropy_rotation)}});
        model_.materials.push_back(std::move(material));
    }

    template <class T>
    int add_accessor(const std::vector<T> &values, int type, int component, int target) {
        std::vector<unsigned char> &data = model_.buffers[0].data;
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteOffset = data.size();
        view.byteLength = values.size() * sizeof(T);
        view.target = target;
        data.resize(data.size() + view.byteLength);
        std::memcpy(data.data() + view.byteOffset, values.data(), view.byteLength);
        model_.bufferViews.push_back(view);
        tinygltf::Accessor accessor;
        accessor.bufferView = static_cast<int>(model_.bufferViews.size()) - 1;
        accessor.componentType = component;
        accessor.count = values.size();
        accessor.type = type;
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    int add_vertex_data(const auto &values, int type) {
        return add_accessor(values, type, TINYGLTF_COMPONENT_TYPE_FLOAT,
                            TINYGLTF_TARGET_ARRAY_BUFFER);
    }

    void add_vertices() {
        std::vector<glm::vec3> position;
        glm::vec3 lower(std::numeric_limits<float>::max()), upper(-lower);
        for (const glm::dvec3 &p : surface_.position) {
            position.emplace_back(p);
            lower = glm::min(lower, position.back());
            upper = glm::max(upper, position.back());
        }
        const int places = add_vertex_data(position, TINYGLTF_TYPE_VEC3);
        for (int i = 0; i < 3; ++i) {
            model_.accessors.back().minValues.push_back(static_cast<double>(lower[i]));
            model_.accessors.back().maxValues.push_back(static_cast<double>(upper[i]));
        }
        attributes_["POSITION"] = places;
        look_at_stop(progress_);
        attributes_["NORMAL"] = add_vertex_data(surface_.normal, TINYGLTF_TYPE_VEC3);
        if (!surface_.warp.empty()) {
            // Across the warp, so that with the normal it encloses what the renderer shades with
            std::vector<glm::vec4> tangent;
            for (std::size_t v = 0; v < surface_.warp.size(); ++v)
                tangent.emplace_back(
                    glm::normalize(glm::cross(surface_.warp[v], surface_.normal[v])), 1.0f);
            attributes_["TANGENT"] = add_vertex_data(tangent, TINYGLTF_TYPE_VEC4);
        }
        if (!surface_.uv.empty()) {
            std::vector<glm::vec2> uv;
            for (const glm::vec2 &t : surface_.uv)
                uv.emplace_back(t.x, 1 - t.y);
            attributes_["TEXCOORD_0"] = add_vertex_data(uv, TINYGLTF_TYPE_VEC2);
        }
    }

    void add_panels() {
        std::vector<std::vector<std::uint32_t>> corners(material_of_panel_.size());
        for (std::size_t t = 0; t < surface_.triangle.size(); ++t) {
            look_at_stop(progress_, t);
            const std::size_t panel = surface_.panel.empty() ? 0 : surface_.panel[t];
            for (int c = 0; c < 3; ++c)
                corners[panel].push_back(surface_.triangle[t][c]);
        }
        for (std::size_t panel = 0; panel < corners.size(); ++panel) {
            if (corners[panel].empty())
                continue;
            tinygltf::Primitive primitive;
            primitive.mode = TINYGLTF_MODE_TRIANGLES;
            primitive.attributes = attributes_;
            primitive.material = static_cast<int>(material_of_panel_[panel]);
            primitive.indices = add_accessor(corners[panel], TINYGLTF_TYPE_SCALAR,
                                             TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT,
                                             TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
            if (panel < surface_.panel_name.size())
                primitive.extras =
                    Value(Value::Object{{"panel", Value(surface_.panel_name[panel])}});
            mesh_.primitives.push_back(std::move(primitive));
        }
        mesh_.name = "garment";
    }

    const Surface &surface_;
    const std::vector<std::size_t> &material_of_panel_;
    const Progress &progress_;
    tinygltf::Model model_{};
    tinygltf::Mesh mesh_{};
    std::map<std::string, int> attributes_{};
};

} // namespace

void write_glb(const std::filesystem::path &path, const Surface &surface,
               const std::vector<GltfMaterial> &materials,
               const std::vector<std::size_t> &material_of_panel, const Progress &progress) {
    begin_stage(progress, "garment: write");
    write_file(path, GlbWriter(surface, materials, material_of_panel, progress).bytes());
}

} // namespace tsuya::garment
