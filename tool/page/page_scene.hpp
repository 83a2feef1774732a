#pragma once

// Scenes and levels as the report page shows them.

#include "tool/check/finding.hpp"
#include "tool/objects/level_view.hpp"
#include "tool/objects/scene_objects.hpp"
#include "tool/page/page_mesh.hpp"
#include <abut/io/scene.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace abut::tool {

/// Objects, shapes and motions for the page. Shapes are in coordinates of their own.
template <int D>
class PageScene {
public:
    PageScene() = default;
    virtual ~PageScene() = default;
    PageScene(const PageScene&) = delete;
    PageScene& operator=(const PageScene&) = delete;

    /// Times of frames, in seconds; one if nothing moves.
    virtual const std::vector<double>& times() const = 0;
    virtual std::size_t size() const = 0;
    virtual const std::string& path(std::size_t object) const = 0;
    virtual std::size_t count_facets(std::size_t object) const = 0;
    virtual Facets<D> shape(std::size_t object) const = 0;
    /// True if the facets enclose an area of a level.
    virtual bool is_filled(std::size_t object) const = 0;

    /// Moves all objects to a time.
    virtual void go_to(double time) = 0;
    /// The object's coordinates to the world, column by column.
    virtual std::vector<float> pose(std::size_t object) const = 0;
    /// A point of the world in the object's coordinates; nothing if the object is scaled to nothing.
    virtual std::optional<Vec<D>> local(std::size_t object, const Vec<D>& point) const = 0;
    /// The box in the world.
    virtual Aabb<D> box(std::size_t object) const = 0;
};

/// Refers to all arguments.
class PageScene3 final : public PageScene<3> {
public:
    PageScene3(const Scene& scene, const SceneObjects& objects, const std::vector<double>& times);

    const std::vector<double>& times() const override { return times_; }
    std::size_t size() const override { return objects_.size(); }
    const std::string& path(std::size_t object) const override { return objects_[object].path; }
    std::size_t count_facets(std::size_t object) const override { return objects_.surface(object).triangles.size(); }
    Facets<3> shape(std::size_t object) const override;
    bool is_filled(std::size_t) const override { return false; }
    void go_to(double time) override { world_matrices(scene_, time, matrices_); }
    std::vector<float> pose(std::size_t object) const override;
    std::optional<Vec3> local(std::size_t object, const Vec3& point) const override;
    Aabb3 box(std::size_t object) const override;

private:
    const glm::dmat4& matrix(std::size_t object) const { return matrices_[nodes_[object]]; }

    const Scene& scene_;
    const SceneObjects& objects_;
    const std::vector<double>& times_;
    std::vector<std::size_t> nodes_;  ///< of the objects
    std::vector<glm::dmat4> matrices_;
};

/// Refers to all arguments.
class PageScene2 final : public PageScene<2> {
public:
    PageScene2(const LevelView<2>& level, const std::vector<double>& times) : level_(level), times_(times) {}

    const std::vector<double>& times() const override { return times_; }
    std::size_t size() const override { return level_.objects.size(); }
    const std::string& path(std::size_t object) const override { return level_.objects[object].path; }
    std::size_t count_facets(std::size_t object) const override { return level_.objects[object].surface.facets.size(); }
    Facets<2> shape(std::size_t object) const override {
        const Surface<2>& surface = level_.objects[object].surface;
        return {surface.points, surface.facets};
    }
    bool is_filled(std::size_t object) const override { return level_.objects[object].filled; }
    void go_to(double) override {}
    std::vector<float> pose(std::size_t) const override { return {}; }
    std::optional<Vec2> local(std::size_t, const Vec2& point) const override { return point; }
    Aabb2 box(std::size_t object) const override { return level_.objects[object].box; }

private:
    const LevelView<2>& level_;
    const std::vector<double>& times_;
};

/// The members "objects", "objects_left_out" and "samples" of the page's data; `parties` receives the numbers of each
/// finding's objects among them: those whose path is that of the finding's object, or below it. About 150,000
/// triangles and 10,000 objects are there at most, those nearest to the findings.
template <int D>
Json scene_json(PageScene<D>& scene, std::span<const Finding> findings,
                std::vector<std::vector<std::vector<std::uint32_t>>>& parties);

}  // namespace abut::tool
