#include "files/interchange/assimp_scene.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <assimp/ColladaMetaData.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include "files/interchange/file_units.h"
#include "files/words.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::garment {
namespace {

/// What of one node is one panel, with a vertex a corner as Assimp has it.
struct Piece {
    const aiMesh *mesh = nullptr;
    std::uint32_t panel = 0;
};

/// Equal points become one. Returns the number of each point, counted from `first`, and appends the
/// different ones.
std::vector<std::uint32_t> weld(const std::vector<glm::dvec3> &points,
                                std::vector<glm::dvec3> &different) {
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
        const glm::dvec3 &p = points[a], &q = points[b];
        return std::array{p.x, p.y, p.z} < std::array{q.x, q.y, q.z};
    };
    std::vector<std::uint32_t> sorted(points.size()), first(points.size()), number(points.size());
    std::iota(sorted.begin(), sorted.end(), 0u);
    std::stable_sort(sorted.begin(), sorted.end(), less);
    for (std::size_t i = 0; i < sorted.size(); ++i)
        first[sorted[i]] =
            i > 0 && !less(sorted[i - 1], sorted[i]) ? first[sorted[i - 1]] : sorted[i];
    for (std::uint32_t v = 0; v < points.size(); ++v) {
        if (first[v] == v) {
            number[v] = static_cast<std::uint32_t>(different.size());
            different.push_back(points[v]);
        } else {
            number[v] = number[first[v]];
        }
    }
    return number;
}

glm::dmat4 matrix_of(const aiMatrix4x4 &m) {
    // Assimp's rows are ours
    return glm::transpose(glm::dmat4(m.a1, m.a2, m.a3, m.a4, m.b1, m.b2, m.b3, m.b4, m.c1, m.c2,
                                     m.c3, m.c4, m.d1, m.d2, m.d3, m.d4));
}

std::string text_of(const aiString &text) { return {text.data, text.length}; }

/// Of a node of a Collada file without a name the id or the sid. Empty where Assimp made one up.
std::string name_of(const aiNode &node) {
    std::string name = text_of(node.mName);
    if (!name.starts_with("$ColladaAutoName$"))
        return name;
    aiString id;
    for (const char *const key : {AI_METADATA_COLLADA_ID, AI_METADATA_COLLADA_SID})
        if (node.mMetaData && node.mMetaData->Get(key, id))
            return text_of(id);
    return {};
}

class SceneToMesh {
  public:
    SceneToMesh(const aiScene &scene, const std::string &extension) : scene_(scene) {
        units_ = units_of(scene, extension);
    }

    MeshFile read(const std::vector<std::string> &remarks) {
        if (scene_.mRootNode)
            add_node(*scene_.mRootNode, units_.to_metres);
        add_findings(remarks);
        return std::move(out_);
    }

  private:
    void add_node(const aiNode &node, const glm::dmat4 &parent) {
        const glm::dmat4 world = parent * matrix_of(node.mTransformation);
        std::vector<Piece> pieces;
        for (unsigned int i = 0; i < node.mNumMeshes; ++i) {
            const aiMesh &mesh = *scene_.mMeshes[node.mMeshes[i]];
            note_left_out(mesh);
            pieces.push_back({&mesh, add_panel(node, mesh)});
        }
        add_pieces(pieces, world);
        for (unsigned int i = 0; i < node.mNumChildren; ++i)
            add_node(*node.mChildren[i], world);
    }

    /// All of one node, so that what it has of several materials stays joined.
    void add_pieces(const std::vector<Piece> &pieces, const glm::dmat4 &world) {
        const bool mirrors = glm::determinant(glm::dmat3(world)) < 0.0;
        std::vector<glm::dvec3> points;
        for (const Piece &piece : pieces)
            for (unsigned int v = 0; v < piece.mesh->mNumVertices; ++v) {
                const aiVector3D &p = piece.mesh->mVertices[v];
                points.emplace_back(world * glm::dvec4(p.x, p.y, p.z, 1.0));
            }
        const std::vector<std::uint32_t> number = weld(points, out_.mesh.position);
        std::size_t first = 0;
        for (const Piece &piece : pieces) {
            const auto uv_start = static_cast<std::int32_t>(out_.mesh.uv.size());
            const bool with_uv = piece.mesh->HasTextureCoords(0);
            for (unsigned int v = 0; with_uv && v < piece.mesh->mNumVertices; ++v) {
                const aiVector3D &t = piece.mesh->mTextureCoords[0][v];
                out_.mesh.uv.emplace_back(t.x, t.y);
            }
            for (unsigned int f = 0; f < piece.mesh->mNumFaces; ++f)
                add_face(piece.mesh->mFaces[f], piece.panel, mirrors, [&](unsigned int v) {
                    return std::pair(number.at(first + v),
                                     with_uv ? uv_start + static_cast<std::int32_t>(v) : -1);
                });
            first += piece.mesh->mNumVertices;
        }
    }

    template <class Corner>
    void add_face(const aiFace &face, std::uint32_t panel, bool mirrors, Corner &&corner) {
        constexpr unsigned int kLeast = 3;
        if (face.mNumIndices < kLeast) {
            ++lines_;
            return;
        }
        PolygonMesh &mesh = out_.mesh;
        for (unsigned int i = 0; i < face.mNumIndices; ++i) {
            const unsigned int at = mirrors ? face.mNumIndices - 1 - i : i;
            const auto [position, uv] = corner(face.mIndices[at]);
            mesh.corner_position.push_back(position);
            mesh.corner_uv.push_back(uv);
        }
        mesh.face_offset.push_back(static_cast<std::uint32_t>(mesh.corner_position.size()));
        mesh.face_panel.push_back(panel);
    }

    /// A panel of a name that no other has.
    std::uint32_t add_panel(const aiNode &node, const aiMesh &mesh) {
        PanelLabel label{.object = name_of(node), .group = text_of(mesh.mName)};
        if (mesh.mMaterialIndex < scene_.mNumMaterials)
            label.material = text_of(scene_.mMaterials[mesh.mMaterialIndex]->GetName());
        if (label.material == AI_DEFAULT_MATERIAL_NAME) // made up by Assimp
            label.material.clear();
        std::string name = !label.object.empty() && node.mParent ? label.object : label.group;
        if (name.empty())
            name = "unnamed";
        if (node.mNumMeshes > 1 && !label.material.empty())
            name += "/" + label.material;
        const int use = ++uses_[name];
        if (use > 1)
            name += "#" + std::to_string(use);
        out_.mesh.panel_name.push_back(std::move(name));
        out_.mesh.panel_label.push_back(std::move(label));
        return static_cast<std::uint32_t>(out_.mesh.panel_name.size() - 1);
    }

    void note_left_out(const aiMesh &mesh) {
        skinned_ += mesh.mNumBones > 0;
        morph_targets_ += mesh.mNumAnimMeshes;
        uv_sets_ = std::max(uv_sets_, mesh.GetNumUVChannels());
    }

    void add_findings(const std::vector<std::string> &remarks) {
        const auto add = [&](Severity severity, const char *key, std::string what,
                             std::string action) {
            out_.findings.push_back({severity, key, std::move(what), "", std::move(action)});
        };
        if (!units_.stated.empty())
            add(Severity::note, "file_units", units_.stated, units_.action);
        if (uv_sets_ > 1)
            add(Severity::note, "uv_sets", "a mesh has " + std::to_string(uv_sets_) + " UV sets",
                "the first is taken; export the one of the pattern pieces alone if it is another");
        if (skinned_ > 0)
            add(Severity::warning, "skin_not_applied",
                detail::counted(skinned_, "mesh hangs", "meshes hang") + " on bones",
                "kept in the rest pose; export the posed mesh, or GLB, whose skins are applied");
        std::vector<std::string> left;
        for (const auto &[count, one] :
             {std::pair<std::size_t, const char *>(scene_.mNumAnimations, "animation"),
              {morph_targets_, "morph target"},
              {lines_, "point or line"}})
            if (count > 0)
                left.push_back(std::to_string(count) + " x " + one);
        if (!left.empty())
            add(Severity::note, "not_read", "the file has what is not read: " + list(left),
                "left out; frames of an animation can be read from one file each");
        if (!remarks.empty())
            add(Severity::note, "importer_remarks",
                "Assimp remarks: " + cause_of(remarks.front()) +
                    (remarks.size() == 1
                         ? ""
                         : " (and " + std::to_string(remarks.size() - 1) + " more)"),
                "look whether all panels are there");
    }

    static std::string list(const std::vector<std::string> &words) {
        std::string text;
        for (const std::string &word : words)
            text += (text.empty() ? "" : ", ") + word;
        return text;
    }

    const aiScene &scene_;
    FileUnits units_{};
    MeshFile out_;
    std::map<std::string, int> uses_; ///< of panel names
    unsigned int uv_sets_ = 0;        ///< of the mesh that has most
    std::size_t skinned_ = 0, morph_targets_ = 0, lines_ = 0;
};

} // namespace

std::string cause_of(const std::string &message) {
    constexpr std::size_t kMost = 200;
    std::string text = message.substr(0, message.find_first_of("\r\n"));
    for (const char *const mark : {"Warn,", "Error,"}) // `Warn,  T0: what it is`
        if (text.starts_with(mark))
            text.erase(0, std::min(text.find(": "), text.size() - 2) + 2);
    return text.substr(0, kMost);
}

MeshFile mesh_of(const aiScene &scene, const std::string &extension,
                 std::vector<std::string> remarks) {
    // Optional parts of an FBX file
    std::erase_if(remarks, [](const std::string &remark) {
        return remark.find("property table") != std::string::npos;
    });
    return SceneToMesh(scene, extension).read(remarks);
}

} // namespace tsuya::garment
