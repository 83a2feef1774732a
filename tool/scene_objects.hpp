#pragma once

// The objects of a scene: its nodes with geometry, over its animation.

#include "objects.hpp"
#include <abut/io/scene.hpp>
#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <glm/ext/matrix_double3x3.hpp>
#include <glm/ext/matrix_double4x4.hpp>

namespace abut::tool {

class SceneObjects final : public Objects<3> {
public:
    /// Refers to the scene.
    explicit SceneObjects(const Scene& scene);

    /// A Problem where a transform takes an object out of the range of floats.
    std::optional<Problem> go_to(double time, ProgressCall progress) override;
    using Objects<3>::go_to;

    void each_stage(double from, double to, FunctionRef<void(const Stage<3>&)> visit) override;

    std::vector<std::string> hidden() const override;
    std::vector<std::string> unfollowed() const override;

    /// What the node's transform does beyond turning and moving is baked into it.
    using Shape = std::variant<Polyhedron, Mesh>;
    const Shape& shape(std::size_t object) const { return nodes_[object].shape; }

    /// The triangles that it is made of, as they stand in the file; objects with the same model share them.
    std::size_t model(std::size_t object) const { return nodes_[object].model; }
    const Welded& surface(std::size_t object) const { return models_[model(object)].surface; }
    /// From there into the world, at the moment that was asked for last.
    const glm::dmat4& matrix(std::size_t object) const { return nodes_[object].matrix; }

private:
    /// Triangles as they stand in the file: of one mesh, shared by all objects that are made of it.
    struct Model {
        Welded surface;
        bool solid = false;  ///< convex, closed and wound outwards
    };
    /// Where an object comes from.
    struct Node {
        std::uint32_t node = 0;
        std::size_t model = 0;
        Shape shape;
        glm::dmat4 matrix{std::numeric_limits<double>::quiet_NaN()};  ///< into the world
        glm::dmat3 baked{0.0};                                        ///< the part of a matrix that is in the shape
    };

    /// The way of all objects between two moments at which nothing begins to move otherwise.
    struct Way;

    std::optional<Pose3> pose_of(std::size_t i, const glm::dmat4& matrix) const;
    std::optional<Motion3> motion_of(std::size_t i, const glm::dmat4& from, const glm::dmat4& to) const;
    int count_pieces(const Way& way);
    bool jumps(std::size_t i, Way& way) const;
    Part part_in(std::size_t i, Way& way, const glm::dmat4& from, const glm::dmat4& to, Motion3& motion);
    std::vector<std::string> paths_where(const std::vector<bool>& is_one) const;
    std::optional<Problem> place(std::size_t i, const glm::dmat4& matrix);
    std::optional<Problem> bake(std::size_t i, const glm::dmat3& linear);

    const Scene& scene_;
    std::vector<Model> models_;
    std::vector<Node> nodes_;           ///< of the object with the same number
    std::vector<double> motion_times_;  ///< between these each node goes on as it began
    bool has_curves_ = false;           ///< some track isn't linear between its keys
    std::vector<bool> was_hidden_, was_unfollowed_;
    std::vector<glm::dmat4> matrices_;
};

}  // namespace abut::tool
