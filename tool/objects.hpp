#pragma once

// The objects of a scene, each a shape in its place at a moment of the animation.

#include "inside.hpp"
#include "progress.hpp"
#include <abut/abut.hpp>
#include <abut/bake/weld.hpp>
#include <abut/io/scene.hpp>

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

/// Triangles as they stand in the file: of one mesh, shared by all objects that are made of it.
struct Model {
    Welded surface;
    bool solid = false;  ///< convex, closed and wound outwards
};

/// A node with geometry. What its node's transform does beyond turning and moving is baked into the shape.
struct Object {
    std::string path;
    std::string name;  ///< the last part of the path
    std::uint32_t node = 0;
    std::size_t model = 0;

    // At the moment that was asked for last:
    bool present = false;  ///< false while its transform flattens it to nothing
    bool moved = false;    ///< other than at the moment before
    bool solid = false;    ///< the shape is a Polyhedron
    bool filled = false;   ///< a Mesh that is closed and wound outwards: things can be swallowed by it
    float radius = 0;      ///< its size
    InsidePoint inside;    ///< in the shape's frame
    std::variant<Polyhedron, Mesh> shape;
    Pose3 pose;
    View<3> placed;
    Aabb3 box = Aabb3::empty();

    glm::dmat4 matrix{std::numeric_limits<double>::quiet_NaN()};  ///< into the world
    glm::dmat3 baked{0.0};                                        ///< the part of a matrix that is in the shape
};

class Objects {
public:
    /// In the order of their paths. Refers to the scene.
    explicit Objects(const Scene& scene);

    /// Takes all objects to a moment, in seconds. A Problem where a transform takes one out of the range of floats.
    /// Progress is told in objects; the first time takes long, as all shapes are built.
    std::optional<Problem> go_to(double time, ProgressCall progress);
    std::optional<Problem> go_to(double time) {
        return go_to(time, [](std::size_t, std::size_t) {});
    }

    std::size_t size() const { return objects_.size(); }
    const Object& operator[](std::size_t i) const { return objects_[i]; }
    const Model& model_of(const Object& object) const { return models_[object.model]; }

    /// Those that were left out at some moment so far.
    std::vector<std::string> hidden() const;

private:
    std::optional<Problem> place(Object& object, const glm::dmat4& matrix);
    std::optional<Problem> bake(Object& object, const glm::dmat3& linear);

    const Scene& scene_;
    std::vector<Model> models_;
    std::vector<Object> objects_;
    std::vector<bool> was_hidden_;
    std::vector<glm::dmat4> matrices_;
};

}  // namespace abut::tool
