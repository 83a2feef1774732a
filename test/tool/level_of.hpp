#pragma once

// Levels made in memory: 2D levels of polygons, 3D levels of scenes.

#include "scene_of.hpp"
#include "tool/objects/level_view.hpp"
#include <abut/abut.hpp>

#include <cmath>
#include <deque>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {

/// Convex polygons of the plane, as filled objects.
class PlaneLevel {
public:
    /// Counter-clockwise.
    void add(const std::string& name, const std::vector<Vec2>& outline) {
        const Result<Polygon> built = Polygon::build(outline);
        ASSERT_TRUE(built);
        polygons_.push_back(*built);
        tool::ViewedObject<2> object = standing(name, view(polygons_.back()), outline);
        object.filled = true;
        object.convex = true;
        for (std::uint32_t i = 0; i < outline.size(); ++i)
            object.surface.facets.push_back({i, (i + 1) % static_cast<std::uint32_t>(outline.size())});
        level_.objects.push_back(std::move(object));
    }
    void add_box(const std::string& name, Vec2 min, Vec2 max) { add(name, {min, {max.x, min.y}, max, {min.x, max.y}}); }
    /// An open line, free on both sides.
    void add_line(const std::string& name, const std::vector<Vec2>& points) {
        const Result<Chain> built = Chain::build(points, false);
        ASSERT_TRUE(built);
        chains_.push_back(*built);
        tool::ViewedObject<2> object = standing(name, view(chains_.back()), points);
        for (std::uint32_t i = 0; i + 1 < points.size(); ++i) object.surface.facets.push_back({i, i + 1});
        object.surface.two_sided.assign(object.surface.facets.size(), true);
        level_.objects.push_back(std::move(object));
    }
    void add_place(const std::string& path, Vec2 position) { level_.places.push_back({path, path, position, {}}); }

    const tool::LevelView<2>& view_of() const { return level_; }

private:
    template <class Shape>
    tool::ViewedObject<2> standing(const std::string& name, const Shape& shape, const std::vector<Vec2>& points) const {
        tool::ViewedObject<2> object;
        object.path = object.name = name;
        object.model = level_.objects.size();
        object.shape = View<2>(shape);
        object.box = bounds(object.shape);
        object.radius = static_cast<float>(size(object.shape));
        object.surface.points = points;
        return object;
    }

    std::deque<Polygon> polygons_;
    std::deque<Chain> chains_;
    tool::LevelView<2> level_;
};

/// A scene, and all data that its level refers to.
class SpaceLevel {
public:
    explicit SpaceLevel(Scene scene)
        : scene_(std::make_unique<Scene>(std::move(scene))), objects_(std::make_unique<tool::SceneObjects>(*scene_)) {
        EXPECT_FALSE(objects_->go_to(0));
        level_ = tool::level_view(*scene_, *objects_, 0);
    }

    const tool::LevelView<3>& view_of() const { return level_; }

private:
    std::unique_ptr<Scene> scene_;
    std::unique_ptr<tool::SceneObjects> objects_;
    tool::LevelView<3> level_;
};

inline void add_box(Scene& scene, const std::string& name, const glm::dvec3& min, const glm::dvec3& max) {
    const glm::dvec3 half = (max - min) * 0.5;
    add_object(scene, name, box_triangles(Vec3(half)), glm::translate(glm::dmat4(1.0), (min + max) * 0.5));
}

/// A node without geometry.
inline void add_place(Scene& scene, const std::string& name, const glm::dvec3& at) {
    SceneNode node;
    node.name = name;
    node.local = glm::translate(glm::dmat4(1.0), at);
    scene.nodes.push_back(std::move(node));
}

/// An outline in the x-y-plane, counter-clockwise, extruded along z from `low` to `high`: closed, wound outwards.
/// `caps` are the triangles of the outline.
inline Triangles extruded(const std::vector<Vec2>& outline, const std::vector<glm::uvec3>& caps, float low,
                          float high) {
    Triangles result;
    for (const float z : {low, high})
        for (const Vec2& p : outline) result.points.emplace_back(p.x, p.y, z);
    const auto count = static_cast<std::uint32_t>(outline.size());
    for (const glm::uvec3& t : caps) {
        result.triangles.emplace_back(t.x, t.z, t.y);
        result.triangles.emplace_back(count + t.x, count + t.y, count + t.z);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t next = (i + 1) % count;
        result.triangles.emplace_back(i, next, count + next);
        result.triangles.emplace_back(i, count + next, count + i);
    }
    return result;
}

}  // namespace abut::test
