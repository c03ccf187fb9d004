#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include <glm/gtc/quaternion.hpp>

#include "files/gltf_document.h"
#include "files/gltf_hints.h"
#include "mesh/stop.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

/// Corners and morphed vertices that any file may ask for, and how many more a byte of it: a node
/// can repeat a mesh, which a small file must not turn into a huge one.
constexpr std::size_t kFreeCorners = 1u << 22;
constexpr std::size_t kCornersPerByte = 64;

glm::dmat4 local_transform(const tinygltf::Node &node) {
    glm::dmat4 m(1.0);
    if (node.matrix.size() == 16) {
        for (int i = 0; i < 16; ++i)
            m[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
        return m;
    }
    const auto part = [](const std::vector<double> &v, std::size_t n) { return v.size() == n; };
    if (part(node.translation, 3))
        m[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
    if (part(node.rotation, 4)) {
        glm::dquat q(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        const double length = glm::length(q);
        if (length > 0.0)
            m *= glm::mat4_cast(q / length);
    }
    if (part(node.scale, 3))
        for (int i = 0; i < 3; ++i)
            m[i] *= node.scale[static_cast<std::size_t>(i)];
    return m;
}

/// Corners of the triangles of a primitive; empty for points and lines.
std::vector<std::uint32_t> triangle_corners(const tinygltf::Primitive &primitive,
                                            const std::vector<std::uint32_t> &index) {
    const std::size_t n = index.size();
    std::vector<std::uint32_t> corners;
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES) {
        corners.assign(index.begin(), index.begin() + static_cast<std::ptrdiff_t>(n - n % 3));
    } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        for (std::size_t i = 0; i + 2 < n; ++i)
            corners.insert(corners.end(), {index[i], index[i + 1 + i % 2], index[i + 2 - i % 2]});
    } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        for (std::size_t i = 1; i + 1 < n; ++i)
            corners.insert(corners.end(), {index[0], index[i], index[i + 1]});
    }
    return corners;
}

std::vector<glm::dvec3> rows3(const std::vector<double> &numbers) {
    std::vector<glm::dvec3> rows(numbers.size() / 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
        rows[i] = {numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    return rows;
}

/// One primitive in the coordinates of its mesh.
struct Part {
    std::vector<glm::dvec3> position;
    std::vector<std::vector<glm::dvec3>> morphed; ///< one a target
    std::vector<glm::dvec2> uv;                   ///< v upwards; may be empty
    std::vector<glm::dvec4> tangent;              ///< may be empty
    std::vector<std::uint32_t> corner;
    std::optional<FabricHint> hint;
};

int find_attribute(const std::map<std::string, int> &attributes, const std::string &name) {
    const auto it = attributes.find(name);
    return it == attributes.end() ? -1 : it->second;
}

Part read_part(const tinygltf::Model &model, const tinygltf::Primitive &primitive,
               const std::string &where) {
    Part part;
    part.position = rows3(read_accessor(model, find_attribute(primitive.attributes, "POSITION"), 3,
                                        0, where + ": POSITION"));
    const std::size_t n = part.position.size();
    std::vector<std::uint32_t> index(n);
    std::iota(index.begin(), index.end(), 0u);
    if (primitive.indices >= 0)
        index = read_indices(model, primitive.indices, where + ": indices");
    part.corner = triangle_corners(primitive, index);
    for (const std::uint32_t v : part.corner)
        if (v >= n)
            throw Error({"index " + std::to_string(v) + " names no vertex", where,
                         "expected less than " + std::to_string(n)});
    const GltfUv transform = gltf_uv(model, primitive.material);
    if (const int uv = find_attribute(primitive.attributes, transform.attribute); uv >= 0) {
        const auto numbers = read_accessor(model, uv, 2, n, where + ": " + transform.attribute);
        for (std::size_t i = 0; i < n; ++i) {
            const glm::dvec2 t = transform.apply({numbers[2 * i], numbers[2 * i + 1]});
            part.uv.emplace_back(t.x, 1.0 - t.y); // glTF counts v downwards
        }
    }
    if (const int t = find_attribute(primitive.attributes, "TANGENT"); t >= 0) {
        const auto numbers = read_accessor(model, t, 4, n, where + ": TANGENT");
        for (std::size_t i = 0; i < n; ++i)
            part.tangent.emplace_back(numbers[4 * i], numbers[4 * i + 1], numbers[4 * i + 2],
                                      numbers[4 * i + 3]);
    }
    for (const auto &target : primitive.targets) {
        part.morphed.push_back(part.position);
        if (const int p = find_attribute(target, "POSITION"); p >= 0) {
            const auto shift = rows3(read_accessor(model, p, 3, n, where + ": target POSITION"));
            for (std::size_t i = 0; i < n; ++i)
                part.morphed.back()[i] += shift[i];
        }
    }
    part.hint = gltf_hint(model, primitive.material);
    return part;
}

/// Angle of the tangents in the UV plane, and whether the bitangents run with +v (1) or against it
/// (-1): means over the triangles.
struct TangentFit {
    double angle = 0, side = 1;
};

TangentFit fit_tangents(const Part &part) {
    glm::dvec2 direction(0.0);
    double side = 0.0;
    for (std::size_t c = 0; c + 2 < part.corner.size(); c += 3) {
        const std::uint32_t i = part.corner[c], j = part.corner[c + 1], k = part.corner[c + 2];
        const glm::dvec3 p = part.position[j] - part.position[i],
                         q = part.position[k] - part.position[i];
        const glm::dvec2 s = part.uv[j] - part.uv[i], t = part.uv[k] - part.uv[i];
        const double det = s.x * t.y - s.y * t.x;
        const glm::dvec3 area = glm::cross(p, q);
        if (det == 0.0 || !(glm::dot(area, area) > 0.0))
            continue;
        const glm::dvec3 p_u = (p * t.y - q * s.y) / det, p_v = (q * s.x - p * t.x) / det;
        const glm::dvec4 sum = part.tangent[i] + part.tangent[j] + part.tangent[k];
        const glm::dvec3 tangent(sum);
        // tangent = a p_u + b p_v in the plane of the triangle
        const double uu = glm::dot(p_u, p_u), uv = glm::dot(p_u, p_v), vv = glm::dot(p_v, p_v);
        const double tu = glm::dot(tangent, p_u), tv = glm::dot(tangent, p_v);
        const double gram = uu * vv - uv * uv;
        if (!(gram > 0.0))
            continue;
        const glm::dvec2 found((tu * vv - tv * uv) / gram, (tv * uu - tu * uv) / gram);
        const double length = glm::length(found);
        if (!(length > 0.0) || !std::isfinite(length))
            continue;
        const double weight = glm::length(area);
        direction += weight / length * found;
        side += weight * (sum.w * glm::dot(glm::cross(area, tangent), p_v) < 0.0 ? -1.0 : 1.0);
    }
    if (direction == glm::dvec2(0.0))
        return {};
    return {std::atan2(direction.y, direction.x), side < 0.0 ? -1.0 : 1.0};
}

/// Vertices at exactly one place in every shape become one. Returns the first of each.
std::vector<std::uint32_t> weld(const Part &part) {
    const auto order = [&](std::uint32_t a, std::uint32_t b) {
        const auto compare = [&](const std::vector<glm::dvec3> &p) {
            for (int i = 0; i < 3; ++i)
                if (p[a][i] != p[b][i])
                    return p[a][i] < p[b][i] ? -1 : 1;
            return 0;
        };
        int result = compare(part.position);
        for (std::size_t t = 0; t < part.morphed.size() && result == 0; ++t)
            result = compare(part.morphed[t]);
        return result;
    };
    std::vector<std::uint32_t> sorted(part.position.size()), first(part.position.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    std::sort(sorted.begin(), sorted.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int o = order(a, b);
        return o != 0 ? o < 0 : a < b;
    });
    for (std::size_t i = 0; i < sorted.size(); ++i)
        first[sorted[i]] =
            i > 0 && order(sorted[i - 1], sorted[i]) == 0 ? first[sorted[i - 1]] : sorted[i];
    return first;
}

class GltfReader {
  public:
    GltfReader(const tinygltf::Model &model, std::size_t bytes, const std::string &name,
               const Progress &progress)
        : model_(model), name_(name), progress_(progress),
          room_(kFreeCorners + kCornersPerByte * bytes) {
        for (const tinygltf::Buffer &buffer : model.buffers)
            room_ += kCornersPerByte * buffer.data.size();
    }

    MeshFile read() {
        struct Visit {
            int node;
            glm::dmat4 parent;
        };
        std::vector<Visit> open;
        const std::vector<int> roots = root_nodes();
        for (auto it = roots.rbegin(); it != roots.rend(); ++it)
            open.push_back({*it, glm::dmat4(1.0)});
        std::vector<bool> seen(model_.nodes.size(), false);
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const std::string where = name_ + ": node " + std::to_string(visit.node);
            if (visit.node < 0 || static_cast<std::size_t>(visit.node) >= seen.size())
                throw Error({"the node does not exist", where, "expected a node of the file"});
            const auto index = static_cast<std::size_t>(visit.node);
            if (seen[index])
                throw Error({"the node has two parents", where, "expected a tree"});
            seen[index] = true;
            const tinygltf::Node &node = model_.nodes[index];
            const glm::dmat4 world = visit.parent * local_transform(node);
            add_node(node, world, where);
            for (auto it = node.children.rbegin(); it != node.children.rend(); ++it)
                open.push_back({*it, world});
        }
        if (out_.mesh.face_count() == 0)
            throw Error({"the file has no triangle", name_, "expected a mesh of triangles"});
        check_indices(out_.mesh, name_);
        return std::move(out_);
    }

  private:
    std::vector<int> root_nodes() const {
        const auto scene = static_cast<std::size_t>(std::max(0, model_.defaultScene));
        if (scene < model_.scenes.size())
            return model_.scenes[scene].nodes;
        std::set<int> children;
        for (const tinygltf::Node &node : model_.nodes)
            children.insert(node.children.begin(), node.children.end());
        std::vector<int> roots;
        for (int i = 0; i < static_cast<int>(model_.nodes.size()); ++i)
            if (!children.contains(i))
                roots.push_back(i);
        return roots;
    }

    void add_node(const tinygltf::Node &node, const glm::dmat4 &world, const std::string &where) {
        if (node.mesh < 0)
            return;
        if (static_cast<std::size_t>(node.mesh) >= model_.meshes.size())
            throw Error({"mesh " + std::to_string(node.mesh) + " does not exist", where,
                         "expected a mesh of the file"});
        const tinygltf::Mesh &mesh = model_.meshes[static_cast<std::size_t>(node.mesh)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive &primitive = mesh.primitives[i];
            const std::string place = where + ": primitive " + std::to_string(i);
            look_at_stop(progress_);
            PanelLabel label{
                .object = node.name, .group = mesh.name, .material = material_of(primitive)};
            std::string name = !node.name.empty() ? node.name : mesh.name;
            if (mesh.primitives.size() > 1)
                name += "/" + std::to_string(i);
            const Part part = read_part(model_, primitive, place);
            if (!part.corner.empty())
                add_part(part, world, add_panel(std::move(name), std::move(label)), place);
        }
    }

    /// A panel of a name that no other has.
    std::uint32_t add_panel(std::string name, PanelLabel label) {
        if (name.empty())
            name = "unnamed";
        const int use = ++uses_[name];
        if (use > 1)
            name += "#" + std::to_string(use);
        out_.mesh.panel_name.push_back(name);
        out_.mesh.panel_label.push_back(std::move(label));
        return static_cast<std::uint32_t>(out_.mesh.panel_name.size() - 1);
    }

    void take_room(std::size_t amount, const std::string &where) {
        if (amount > room_)
            throw Error(
                {"nodes repeat meshes too often for a file of this size", where, "expected fewer"});
        room_ -= amount;
    }

    std::string material_of(const tinygltf::Primitive &primitive) const {
        const auto material = static_cast<std::size_t>(primitive.material);
        return primitive.material >= 0 && material < model_.materials.size()
                   ? model_.materials[material].name
                   : std::string();
    }

    void add_part(const Part &part, const glm::dmat4 &world, std::uint32_t panel,
                  const std::string &where) {
        take_room(part.corner.size() + part.position.size() * (1 + part.morphed.size()), where);
        PolygonMesh &mesh = out_.mesh;
        const auto uv_base = static_cast<std::int32_t>(mesh.uv.size());
        const auto place = [&](const glm::dvec3 &p) {
            return glm::dvec3(world * glm::dvec4(p, 1.0));
        };
        // Shapes that other parts have, and this one has not, stay at rest here.
        while (out_.morph_targets.size() < part.morphed.size())
            out_.morph_targets.push_back(mesh.position);
        // Vertices that others stand for are not taken over.
        const std::vector<std::uint32_t> first = weld(part);
        std::vector<std::uint32_t> number(part.position.size());
        for (std::uint32_t i = 0; i < part.position.size(); ++i) {
            if (first[i] != i)
                continue;
            number[i] = static_cast<std::uint32_t>(mesh.position.size());
            mesh.position.push_back(place(part.position[i]));
            for (std::size_t t = 0; t < out_.morph_targets.size(); ++t)
                out_.morph_targets[t].push_back(
                    place(t < part.morphed.size() ? part.morphed[t][i] : part.position[i]));
        }
        mesh.uv.insert(mesh.uv.end(), part.uv.begin(), part.uv.end());
        const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
        for (std::size_t c = 0; c < part.corner.size(); c += 3) {
            look_at_stop(progress_, c / 3);
            for (const std::size_t k : {c, c + (mirrored ? 2 : 1), c + (mirrored ? 1 : 2)}) {
                const std::uint32_t v = part.corner[k];
                mesh.corner_position.push_back(number[first[v]]);
                mesh.corner_uv.push_back(part.uv.empty() ? -1
                                                         : uv_base + static_cast<std::int32_t>(v));
            }
            mesh.face_offset.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
            mesh.face_panel.push_back(panel);
        }
        if (part.hint)
            add_hint(part, panel);
    }

    void add_hint(const Part &part, std::uint32_t panel) {
        FabricHint hint = *part.hint;
        hint.panel = out_.mesh.panel_name[panel];
        if (!part.tangent.empty() && !part.uv.empty()) {
            const TangentFit fit = fit_tangents(part);
            hint.thread_angle = fit.angle + fit.side * hint.thread_angle;
        }
        out_.hints.push_back(std::move(hint));
    }

    const tinygltf::Model &model_;
    std::string name_;
    const Progress &progress_;
    std::size_t room_; ///< corners that may still be added
    MeshFile out_;
    std::map<std::string, int> uses_; ///< of panel names
};

} // namespace

MeshFile parse_gltf(std::string_view bytes, const std::string &name,
                    const std::filesystem::path &folder, const Progress &progress) {
    const tinygltf::Model model = parse_gltf_document(bytes, name, folder);
    MeshFile file = GltfReader(model, bytes.size(), name, progress).read();
    share_equal_uvs(file.mesh);
    return file;
}

MeshFile read_gltf(const std::filesystem::path &path, const Progress &progress) {
    const auto folder = path.parent_path();
    return parse_gltf(read_file(path), path.string(), folder.empty() ? "." : folder, progress);
}

} // namespace tsuya::garment
