#include "files/gltf_skin.h"

#include <cmath>

#include "files/declared_count.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

constexpr int kPerSet = 4; // joints in one pair of attributes

/// Of each joint: where it stands, after the inverse of where it stood when it was bound.
std::vector<glm::dmat4> joint_matrices(const tinygltf::Model &model, const GltfNodes &nodes,
                                       const tinygltf::Skin &skin, const std::string &where) {
    std::vector<double> inverse;
    if (skin.inverseBindMatrices >= 0)
        inverse =
            read_accessor(model, skin.inverseBindMatrices, 16, 0, where + ": inverseBindMatrices");
    if (!inverse.empty() && inverse.size() / 16 < skin.joints.size())
        throw Error({"the skin has fewer inverse bind matrices than joints", where,
                     "expected one a joint"});
    std::vector<glm::dmat4> matrices;
    for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        const int node = skin.joints[j];
        if (node < 0 || static_cast<std::size_t>(node) >= nodes.world.size())
            throw Error({"joint " + std::to_string(j) + " is node " + std::to_string(node) +
                             ", which does not exist",
                         where, "expected a node of the file"});
        glm::dmat4 bind(1.0);
        if (!inverse.empty())
            for (std::size_t i = 0; i < 16; ++i)
                bind[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = inverse[16 * j + i];
        matrices.push_back(nodes.world[static_cast<std::size_t>(node)] * bind);
    }
    return matrices;
}

int find_attribute(const tinygltf::Primitive &primitive, const std::string &name) {
    const auto it = primitive.attributes.find(name);
    return it == primitive.attributes.end() ? -1 : it->second;
}

/// Adds what one set of joints contributes to the sums of matrices and weights.
void add_set(const std::vector<glm::dmat4> &joints, const std::vector<double> &numbers,
             const std::vector<double> &weights, std::vector<glm::dmat4> &sum,
             std::vector<double> &weight, const std::string &where) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (weights[i] == 0.0)
            continue;
        const double joint = numbers[i];
        if (!(joint >= 0.0 && joint < static_cast<double>(joints.size()) &&
              joint == std::floor(joint)))
            throw Error(
                {"vertex " + std::to_string(i / kPerSet) + " names joint " + number_text(joint),
                 where, "expected a whole number below " + std::to_string(joints.size())});
        sum[i / kPerSet] += weights[i] * joints[static_cast<std::size_t>(joint)];
        weight[i / kPerSet] += weights[i];
    }
}

} // namespace

std::vector<glm::dmat4> skin_matrices(const tinygltf::Model &model, const GltfNodes &nodes,
                                      int skin, const tinygltf::Primitive &primitive,
                                      std::size_t vertices, const std::string &where) {
    if (skin < 0 || static_cast<std::size_t>(skin) >= model.skins.size())
        throw Error({"skin " + std::to_string(skin) + " does not exist", where,
                     "expected a skin of the file"});
    const std::vector<glm::dmat4> joints =
        joint_matrices(model, nodes, model.skins[static_cast<std::size_t>(skin)],
                       where + ": skin " + std::to_string(skin));
    std::vector<glm::dmat4> sum(vertices, glm::dmat4(0.0));
    std::vector<double> weight(vertices, 0.0);
    for (int set = 0;; ++set) {
        const std::string joint_name = "JOINTS_" + std::to_string(set);
        const std::string weight_name = "WEIGHTS_" + std::to_string(set);
        const int joint_accessor = find_attribute(primitive, joint_name);
        const int weight_accessor = find_attribute(primitive, weight_name);
        if (joint_accessor < 0 && weight_accessor < 0 && set > 0)
            break;
        add_set(
            joints,
            read_accessor(model, joint_accessor, kPerSet, vertices, where + ": " + joint_name),
            read_accessor(model, weight_accessor, kPerSet, vertices, where + ": " + weight_name),
            sum, weight, where + ": " + joint_name);
    }
    for (std::size_t v = 0; v < vertices; ++v) {
        if (!(weight[v] > 0.0))
            throw Error({"the weights of vertex " + std::to_string(v) + " sum to 0", where,
                         "expected weights that sum to 1"});
        sum[v] /= weight[v];
    }
    return sum;
}

} // namespace tsuya::garment
