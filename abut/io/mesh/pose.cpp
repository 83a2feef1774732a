#include <abut/io/mesh/pose.hpp>

#include <algorithm>
#include <utility>

#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/matrix.hpp>

namespace abut::detail {
namespace {

// The joint that all others are below, if there is one: parents precede their children.
std::uint32_t root_of(const Skin& skin) {
    return *std::min_element(skin.joints.begin(), skin.joints.end());
}

// The points of a skin in world space.
std::vector<glm::dvec3> posed_points(const Geometry& geometry, const Skin& skin,
                                     const std::vector<glm::dmat4>& matrices) {
    std::vector<glm::dmat4> moves;
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        moves.push_back(matrices[skin.joints[i]] * skin.inverse_binds[i]);
    std::vector<glm::dvec3> sums(geometry.points.size(), glm::dvec3(0.0));
    std::vector<double> weights(geometry.points.size(), 0.0);
    for (const Influence& influence : skin.influences) {
        const glm::dvec4 point(glm::dvec3(geometry.points[influence.point]), 1.0);
        sums[influence.point] += influence.weight * glm::dvec3(moves[influence.joint] * point);
        weights[influence.point] += influence.weight;
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = weights[i] > 0 ? sums[i] / weights[i]
                                 : glm::dvec3(matrices[skin.node] * glm::dvec4(glm::dvec3(geometry.points[i]), 1.0));
    return sums;
}

}  // namespace

void pose_skins(Scene& scene, std::span<const Skin> skins) {
    if (skins.empty()) return;
    std::vector<glm::dmat4> matrices;
    world_matrices(scene, key_times(scene).front(), matrices);
    std::uint32_t last = SceneNode::no_parent;
    for (const Skin& skin : skins) {
        Geometry& geometry = scene.geometries[skin.geometry];
        std::uint32_t root = root_of(skin);
        glm::dmat4 to_root = glm::inverse(matrices[root]);
        if (glm::determinant(matrices[root]) == 0) {
            root = SceneNode::no_parent;
            to_root = glm::dmat4(1.0);
        }
        const std::vector<glm::dvec3> points = posed_points(geometry, skin, matrices);
        for (std::size_t i = 0; i < points.size(); ++i)
            geometry.points[i] = Vec3(glm::dvec3(to_root * glm::dvec4(points[i], 1.0)));
        geometry.normals.clear();
        std::erase(scene.nodes[skin.node].geometries, skin.geometry);
        // One node for all parts of a mesh.
        if (skin.node != last) {
            SceneNode node;
            node.name = scene.nodes[skin.node].name;
            node.parent = root;
            if (root != SceneNode::no_parent) scene.nodes[root].is_body = true;
            scene.nodes.push_back(std::move(node));
            last = skin.node;
        }
        scene.nodes.back().geometries.push_back(skin.geometry);
    }
}

}  // namespace abut::detail
