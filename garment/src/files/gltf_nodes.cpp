#include "files/gltf_nodes.h"

#include <algorithm>

#include <glm/gtc/quaternion.hpp>

#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

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

std::size_t node_index(const tinygltf::Model &model, int node, const std::string &name) {
    if (node < 0 || static_cast<std::size_t>(node) >= model.nodes.size())
        throw Error({"the node does not exist", name + ": node " + std::to_string(node),
                     "expected a node of the file"});
    return static_cast<std::size_t>(node);
}

/// Walks down from a node, parents first. Nodes that were walked before have two parents.
class Walk {
  public:
    Walk(const tinygltf::Model &model, const std::string &name)
        : model_(model), name_(name), seen_(model.nodes.size(), false),
          world_(model.nodes.size(), glm::dmat4(1.0)) {}

    /// The nodes of the tree, in the order of the file.
    std::vector<std::size_t> down(int root) {
        std::vector<std::size_t> order;
        std::vector<std::pair<int, glm::dmat4>> open{{root, glm::dmat4(1.0)}};
        while (!open.empty()) {
            const auto [number, parent] = open.back();
            open.pop_back();
            const std::size_t node = node_index(model_, number, name_);
            if (seen_[node])
                throw Error({"the node has two parents", name_ + ": node " + std::to_string(node),
                             "expected a tree"});
            seen_[node] = true;
            order.push_back(node);
            world_[node] = parent * local_transform(model_.nodes[node]);
            const std::vector<int> &children = model_.nodes[node].children;
            for (auto it = children.rbegin(); it != children.rend(); ++it)
                open.emplace_back(*it, world_[node]);
        }
        return order;
    }

    std::vector<glm::dmat4> take() { return std::move(world_); }

  private:
    const tinygltf::Model &model_;
    const std::string &name_;
    std::vector<bool> seen_;
    std::vector<glm::dmat4> world_;
};

} // namespace

GltfNodes place_nodes(const tinygltf::Model &model, const std::string &name) {
    std::vector<bool> is_child(model.nodes.size(), false);
    for (const tinygltf::Node &node : model.nodes)
        for (const int child : node.children)
            is_child[node_index(model, child, name)] = true;
    const auto number = static_cast<std::size_t>(std::max(0, model.defaultScene));
    const bool has_scene = number < model.scenes.size();
    GltfNodes nodes;
    Walk walk(model, name);
    const auto show = [&](int root) {
        const std::vector<std::size_t> tree = walk.down(root);
        nodes.shown.insert(nodes.shown.end(), tree.begin(), tree.end());
    };
    if (has_scene)
        for (const int root : model.scenes[number].nodes)
            show(root);
    std::vector<bool> in_scene(model.nodes.size(), false);
    for (const std::size_t node : nodes.shown)
        in_scene[node] = true;
    for (std::size_t n = 0; n < model.nodes.size(); ++n) {
        if (is_child[n] || in_scene[n])
            continue;
        if (has_scene)
            walk.down(static_cast<int>(n));
        else
            show(static_cast<int>(n));
    }
    nodes.world = walk.take();
    return nodes;
}

} // namespace tsuya::garment
