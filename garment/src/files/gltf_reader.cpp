#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "files/gltf_alpha.h"
#include "files/gltf_compression.h"
#include "files/gltf_hints.h"
#include "files/gltf_skin.h"
#include "files/words.h"
#include "mesh/stop.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

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
    std::optional<FabricHint> hint; ///< the threads counted from +u
};

int find_attribute(const std::map<std::string, int> &attributes, const std::string &name) {
    const auto it = attributes.find(name);
    return it == attributes.end() ? -1 : it->second;
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

Part read_part(const tinygltf::Model &model, const tinygltf::Primitive &primitive,
               const std::string &where) {
    Part part;
    part.position = rows3(read_accessor(model, find_attribute(primitive.attributes, "POSITION"), 3,
                                        0, where + ": POSITION"));
    const std::size_t n = part.position.size();
    if (primitive.material < -1 ||
        primitive.material >= static_cast<int>(model.materials.size())) // -1: it has none
        throw Error({"material " + std::to_string(primitive.material) + " does not exist", where,
                     "expected a material of the file"});
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
    if (part.hint && !part.tangent.empty() && !part.uv.empty()) {
        const TangentFit fit = fit_tangents(part);
        part.hint->thread_angle = fit.angle + fit.side * part.hint->thread_angle;
    }
    return part;
}

/// Takes a part to where it stands in the file, by one matrix or by one of each vertex. Where that
/// mirrors, its triangles are turned over.
void place_part(Part &part, const std::vector<glm::dmat4> &matrices) {
    const auto matrix = [&](std::size_t v) -> const glm::dmat4 & {
        return matrices[matrices.size() == 1 ? 0 : v];
    };
    const auto place = [&](std::vector<glm::dvec3> &points) {
        for (std::size_t v = 0; v < points.size(); ++v)
            points[v] = glm::dvec3(matrix(v) * glm::dvec4(points[v], 1.0));
    };
    place(part.position);
    for (std::vector<glm::dvec3> &shape : part.morphed)
        place(shape);
    std::size_t mirrored = 0;
    for (const std::uint32_t v : part.corner)
        mirrored += glm::determinant(glm::dmat3(matrix(v))) < 0.0;
    if (2 * mirrored > part.corner.size())
        for (std::size_t c = 0; c + 2 < part.corner.size(); c += 3)
            std::swap(part.corner[c + 1], part.corner[c + 2]);
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
               const std::filesystem::path &folder, const Progress &progress)
        : model_(model), name_(name), progress_(progress),
          room_(kFreeCorners + kCornersPerByte * bytes), alpha_(model, folder, name) {
        for (const tinygltf::Buffer &buffer : model.buffers)
            room_ += kCornersPerByte * buffer.data.size();
    }

    MeshFile read() {
        nodes_ = place_nodes(model_, name_);
        for (const std::size_t index : nodes_.shown) {
            const tinygltf::Node &node = model_.nodes[index];
            if (node.mesh >= 0)
                add_mesh(node.mesh, node, nodes_.world[index],
                         name_ + ": node " + std::to_string(index));
        }
        add_unplaced_meshes();
        alpha_.report(out_);
        note_animations();
        if (out_.mesh.face_count() == 0)
            throw Error({"the file has no triangle", name_, "expected a mesh of triangles"});
        check_indices(out_.mesh, name_);
        return std::move(out_);
    }

  private:
    void add_mesh(int number, const tinygltf::Node &node, const glm::dmat4 &world,
                  const std::string &where) {
        if (static_cast<std::size_t>(number) >= model_.meshes.size())
            throw Error({"mesh " + std::to_string(number) + " does not exist", where,
                         "expected a mesh of the file"});
        placed_.insert(number);
        const tinygltf::Mesh &mesh = model_.meshes[static_cast<std::size_t>(number)];
        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive &primitive = mesh.primitives[i];
            const std::string place = where + ": primitive " + std::to_string(i);
            look_at_stop(progress_);
            std::string name = !node.name.empty() ? node.name : mesh.name;
            if (mesh.primitives.size() > 1)
                name += "/" + std::to_string(i);
            Part part = read_part(model_, primitive, place);
            if (part.corner.empty())
                continue;
            take_room(part.corner.size() + part.position.size() * (1 + part.morphed.size()), place);
            place_part(part, node.skin < 0 ? std::vector{world}
                                           : skin_matrices(model_, nodes_, node.skin, primitive,
                                                           part.position.size(), place));
            const std::uint32_t panel = add_panel(
                std::move(name),
                {.object = node.name, .group = mesh.name, .material = material_of(primitive)});
            alpha_.note(primitive, part.uv, out_.mesh.panel_name[panel]);
            add_part(part, panel);
        }
    }

    /// Meshes that stand in no node of the scene: all of them where the scene has none, else none.
    void add_unplaced_meshes() {
        std::string names;
        std::size_t count = 0;
        const bool none_placed = placed_.empty();
        for (int m = 0; m < static_cast<int>(model_.meshes.size()); ++m) {
            if (placed_.contains(m))
                continue;
            if (none_placed)
                add_mesh(m, {}, glm::dmat4(1.0), name_ + ": mesh " + std::to_string(m));
            const std::string &name = model_.meshes[static_cast<std::size_t>(m)].name;
            ++count;
            names += (names.empty() ? "" : ", ") +
                     (name.empty() ? "mesh " + std::to_string(m) : in_quotes(name));
        }
        if (count > 0)
            out_.findings.push_back(
                {none_placed ? Severity::note : Severity::warning, "unplaced_meshes",
                 detail::counted(count, "mesh stands", "meshes stand") +
                     " in no node of the scene: " + names,
                 "", none_placed ? "read where their own coordinates put them" : "left out"});
    }

    void note_animations() {
        if (model_.animations.empty())
            return;
        out_.findings.push_back(
            {Severity::note, "animations_not_read",
             detail::counted(model_.animations.size(), "animation is", "animations are") +
                 " not read",
             "",
             "shown as nodes and joints stand in the file; frames can be the morph targets "
             "(--morph-targets, in a scene morph_targets) or files of one frame each (--frames, "
             "frames)"});
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

    void add_part(const Part &part, std::uint32_t panel) {
        PolygonMesh &mesh = out_.mesh;
        // Shapes that other parts have, and this one has not, stay at rest here.
        while (out_.morph_targets.size() < part.morphed.size())
            out_.morph_targets.push_back(mesh.position);
        // Vertices that others stand for are not taken over, nor those of other parts: accessors
        // may be shared.
        const std::vector<std::uint32_t> first = weld(part);
        std::vector<std::uint32_t> number(part.position.size());
        std::vector<std::int32_t> uv_number(part.uv.size());
        std::vector<bool> used(part.position.size()), placed(part.position.size());
        for (const std::uint32_t v : part.corner) {
            used[v] = true;
            placed[first[v]] = true;
        }
        for (std::uint32_t i = 0; i < part.position.size(); ++i) {
            if (used[i] && !part.uv.empty()) {
                uv_number[i] = static_cast<std::int32_t>(mesh.uv.size());
                mesh.uv.push_back(part.uv[i]);
            }
            if (!placed[i])
                continue;
            number[i] = static_cast<std::uint32_t>(mesh.position.size());
            mesh.position.push_back(part.position[i]);
            for (std::size_t t = 0; t < out_.morph_targets.size(); ++t)
                out_.morph_targets[t].push_back(t < part.morphed.size() ? part.morphed[t][i]
                                                                        : part.position[i]);
        }
        for (std::size_t c = 0; c < part.corner.size(); ++c) {
            const std::uint32_t v = part.corner[c];
            mesh.corner_position.push_back(number[first[v]]);
            mesh.corner_uv.push_back(part.uv.empty() ? -1 : uv_number[v]);
            if (c % 3 != 2)
                continue;
            look_at_stop(progress_, c / 3);
            mesh.face_offset.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
            mesh.face_panel.push_back(panel);
        }
        if (part.hint) {
            out_.hints.push_back(*part.hint);
            out_.hints.back().panel = mesh.panel_name[panel];
        }
    }

    const tinygltf::Model &model_;
    std::string name_;
    const Progress &progress_;
    std::size_t room_; ///< corners that may still be added
    MeshFile out_;
    GltfNodes nodes_;
    std::set<int> placed_; ///< meshes that stand in a node
    GltfAlpha alpha_;
    std::map<std::string, int> uses_; ///< of panel names
};

} // namespace

MeshFile parse_gltf(std::string_view bytes, const std::string &name,
                    const std::filesystem::path &folder, const Progress &progress) {
    const tinygltf::Model model = parse_gltf_document(bytes, name, folder);
    MeshFile file = GltfReader(model, bytes.size(), name, folder, progress).read();
    share_equal_uvs(file.mesh);
    return file;
}

MeshFile read_gltf(const std::filesystem::path &path, const Progress &progress) {
    const auto folder = path.parent_path();
    return parse_gltf(read_file(path), path.string(), folder.empty() ? "." : folder, progress);
}

} // namespace tsuya::garment
