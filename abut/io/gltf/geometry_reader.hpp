#pragma once

// Reads the meshes and colliders of a glTF document as geometries of a scene.

#include <abut/io/gltf/accessors.hpp>
#include <abut/io/gltf/document.hpp>
#include <abut/io/mesh/pose.hpp>
#include <abut/io/scene.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace abut::gltf {

/// How the points of a geometry follow the joints of a skin: four joints and weights per point.
struct PointJoints {
    std::vector<std::uint32_t> joints;
    std::vector<double> weights;
};

class GeometryReader {
public:
    /// Refers to the document and the scene, to which it adds geometries and warnings.
    GeometryReader(const Document& document, detail::ReferencedFiles files, bool with_normals, Scene& scene)
        : document_(document), data_(document, std::move(files)), with_normals_(with_normals), scene_(scene) {}

    /// The geometries of a mesh, one per primitive of triangles, with these weights of its morph targets. Nodes share
    /// them.
    Result<std::vector<std::uint32_t>> mesh(std::uint32_t mesh, const std::vector<double>& weights);

    /// The same, as new geometries, and how their points follow joints.
    Result<std::vector<std::pair<std::uint32_t, PointJoints>>> skinned_mesh(std::uint32_t mesh,
                                                                            const std::vector<double>& weights);

    /// The geometries that a node collides by.
    Result<std::vector<std::uint32_t>> collider(std::uint32_t collider, std::uint32_t node);

    AccessorReader& data() { return data_; }
    void warn_once(const std::string& warning);

private:
    struct ReadPrimitive {
        Geometry geometry;
        PointJoints joints;
    };

    Result<std::vector<Vec3>> vectors(std::uint32_t accessor);
    Result<std::vector<ReadPrimitive>> primitives(std::uint32_t mesh, const std::vector<double>& weights,
                                                  bool with_joints);
    Result<ReadPrimitive> primitive(const Primitive& from, std::string name, bool with_joints);
    std::optional<Problem> draco_primitive(const Primitive& from, bool with_joints, ReadPrimitive& to);
    std::optional<Problem> morph(const Primitive& from, const std::vector<double>& weights, Geometry& geometry);
    std::optional<Problem> add_meshes_below(std::uint32_t node, const glm::dmat4& matrix, std::vector<Geometry>& to);
    Result<std::vector<Geometry>> collider_meshes(const Collider& collider);
    std::uint32_t add(Geometry geometry);

    const Document& document_;
    AccessorReader data_;
    bool with_normals_;
    Scene& scene_;
    std::size_t points_ = 0;  ///< of all primitives that were read, each time
    std::map<std::pair<std::uint32_t, std::vector<double>>, std::vector<std::uint32_t>> geometries_of_mesh_;
};

/// The transform of a node to its parent.
glm::dmat4 local_matrix(const Node& node);

}  // namespace abut::gltf
