#pragma once

// The objects of a scene: nodes with geometry, animated.

#include "tool/objects/objects.hpp"
#include <abut/io/scene.hpp>
#include <abut/shape/weld.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
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

    /// Returns a Problem if a transform moves an object out of the range of floats.
    std::optional<Problem> go_to(double time, ProgressCall progress) override;
    using Objects<3>::go_to;

    void each_stage(double from, double to, FunctionRef<void(const Stage<3>&)> visit) override;

    std::vector<std::string> hidden() const override;
    std::vector<std::string> discontinuous() const override;

    /// Scale and shear of the node's transform are baked into the shape.
    using Shape = std::variant<Polyhedron, Mesh>;
    const Shape& shape(std::size_t object) const { return *nodes_[object].shape; }

    /// Index of the node in the scene.
    std::uint32_t node(std::size_t object) const { return nodes_[object].node; }

    /// Index of the mesh in the file's coordinates; objects with the same mesh share it.
    std::size_t model(std::size_t object) const { return nodes_[object].model; }
    const Welded& surface(std::size_t object) const { return models_[model(object)].surface; }
    /// Transform from the mesh's coordinates to world space at the current time.
    const glm::dmat4& matrix(std::size_t object) const { return nodes_[object].matrix; }

private:
    /// A mesh in the file's coordinates, shared by all objects that use it.
    struct Model {
        Welded surface;
        bool solid = false;  ///< convex, closed and oriented outwards
    };
    /// The source of an object.
    struct Node {
        std::uint32_t node = 0;
        std::size_t model = 0;
        std::shared_ptr<const Shape> shape;
        glm::dmat4 matrix{std::numeric_limits<double>::quiet_NaN()};  ///< to world space
        glm::dmat3 baked{0.0};                                        ///< linear part that is baked into the shape
    };

    /// The motion of all objects between two times at which no clip or key segment begins.
    struct SmoothInterval;

    std::optional<Pose3> pose_of(std::size_t i, const glm::dmat4& matrix) const;
    std::optional<Motion3> motion_of(std::size_t i, const glm::dmat4& from, const glm::dmat4& to) const;
    int count_stages(const SmoothInterval& interval);
    bool jumps(std::size_t i, SmoothInterval& interval) const;
    StageMotion motion_in_stage(std::size_t i, SmoothInterval& interval, const glm::dmat4& from, const glm::dmat4& to,
                                Motion3& motion);
    std::vector<std::string> paths_where(const std::vector<bool>& selected) const;
    std::optional<Problem> set_transform(std::size_t i, const glm::dmat4& matrix);
    std::optional<Problem> bake(std::size_t i, const glm::dmat3& linear);

    const Scene& scene_;
    std::vector<Model> models_;
    std::vector<Node> nodes_;           ///< same index as the object
    std::vector<double> motion_times_;  ///< key times and starts of clips: motion is smooth between them
    bool has_curves_ = false;           ///< some track is cubic
    std::vector<bool> was_hidden_, was_discontinuous_;
    std::vector<glm::dmat4> matrices_;
};

}  // namespace abut::tool
