#pragma once

// Scenes of a few objects, made in memory.

#include "../io/gltf_builder.hpp"
#include <abut/io/scene.hpp>

#include <string>
#include <utility>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>

namespace abut::test {

/// Adds a mesh and a node for it; returns the node.
inline std::uint32_t add_object(Scene& scene, const std::string& name, Triangles triangles,
                                const glm::dmat4& local = glm::dmat4(1.0)) {
    SceneNode node;
    node.name = name;
    node.local = local;
    node.geometries = {static_cast<std::uint32_t>(scene.geometries.size())};
    scene.geometries.push_back({name, std::move(triangles.points), std::move(triangles.triangles)});
    scene.nodes.push_back(std::move(node));
    return static_cast<std::uint32_t>(scene.nodes.size() - 1);
}

/// A box with edges of length 1 around a place.
inline std::uint32_t add_unit_box(Scene& scene, const std::string& name, const glm::dvec3& at) {
    return add_object(scene, name, box_triangles({0.5f, 0.5f, 0.5f}), glm::translate(glm::dmat4(1.0), at));
}

/// Moves a node along x, from second to second.
inline void add_slide(Scene& scene, std::uint32_t node, const std::vector<double>& xs) {
    Animation animation;
    animation.motions.resize(1);
    animation.motions[0].node = node;
    for (const double x : xs) {
        KeyTrack<glm::dvec3>& track = animation.motions[0].translation;
        track.times.push_back(static_cast<double>(track.times.size()));
        track.values.emplace_back(x, scene.nodes[node].local[3][1], scene.nodes[node].local[3][2]);
    }
    animation.length = static_cast<double>(xs.size() - 1);
    scene.animations.push_back(std::move(animation));
    schedule(scene);
}

inline Triangles inside_out(Triangles triangles) {
    for (glm::uvec3& t : triangles.triangles) std::swap(t.y, t.z);
    return triangles;
}

/// A closed body that isn't convex: an L of three cubes with edges of length `edge`, the corner one around the origin.
inline Triangles corner_triangles(float edge) {
    // The outline of the L in the x-y-plane, counter-clockwise from the reentrant corner; extruded along z.
    const float h = 0.5f * edge;
    const std::vector<Vec2> outline{{h, h}, {h, 3 * h}, {-h, 3 * h}, {-h, -h}, {3 * h, -h}, {3 * h, h}};
    Triangles result;
    for (const float z : {-h, h})
        for (const Vec2& p : outline) result.points.emplace_back(p.x, p.y, z);
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (std::uint32_t i = 1; i + 1 < count; ++i) {
        result.triangles.emplace_back(0, i + 1, i);
        result.triangles.emplace_back(count, count + i, count + i + 1);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        result.triangles.emplace_back(i, next, count + next);
        result.triangles.emplace_back(i, count + next, count + i);
    }
    return result;
}

/// A body at a place: a box with edges of length 1, or an L.
inline std::uint32_t add_body(Scene& scene, const std::string& name, const glm::dvec3& at, bool is_box, float edge) {
    return is_box ? add_unit_box(scene, name, at)
                  : add_object(scene, name, corner_triangles(edge), glm::translate(glm::dmat4(1.0), at));
}

}  // namespace abut::test
