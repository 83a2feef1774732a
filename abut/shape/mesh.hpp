#pragma once

// Triangle mesh: level geometry in 3D, any triangles in any order.

#include <abut/math/result.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view.hpp>

#include <memory>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// The union of its triangles, each of zero thickness and the same from both sides; part i is triangle i of the input.
/// Only `contains` takes a closed mesh as solid. Immutable: copies share the data, so one mesh at many poses costs one
/// tree. Memory: the input, 12 bytes a triangle for its neighbours, and 34 to 39 for the tree where neighbours have
/// corners at the same positions, about 90 where none have.
class Mesh {
public:
    /// Any number of triangles but zero, also flat, doubled or crossing ones. A Problem where a coordinate is not
    /// finite or an index is out of range: it says which point or triangle.
    static Result<Mesh> build(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    std::span<const Vec3> points() const;
    std::span<const glm::uvec3> triangles() const;
    Triangle3 triangle(std::uint32_t index) const;

    /// Whether the triangles bound a volume: each edge is shared by equally many triangles in both directions, points
    /// at the same position counted as one.
    bool closed() const;

    /// The triangle that shares the edge from a corner to the next, points at the same position counted as one;
    /// no_neighbour at the border, and where another triangle's edge only lies along it; many_neighbours where more
    /// than two share it. Whether the two go round it in opposite ways, as those of a surface do, is not looked at.
    std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t edge) const;

private:
    struct Data;
    explicit Mesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

    friend Aabb3 bounds(const Mesh& mesh);
    friend void each_part(const Mesh& mesh, const Aabb3& box,
                          FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_along(const Mesh& mesh, const MovingBox<3>& box,
                                FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_near(const Mesh& mesh, const Aabb3& box,
                               FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    friend const MeshTree& triangle_tree(const Mesh& mesh);
    friend bool solid_contains(const Mesh& mesh, const Vec3& point);

    std::shared_ptr<const Data> data_;
};

Aabb3 bounds(const Mesh& mesh);

/// Visits the triangles whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Mesh& mesh, const Aabb3& box, FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles whose boxes the moving box meets, roughly in the order in which it does; the visitor returns
/// the new, shorter reach.
void each_part_along(const Mesh& mesh, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles, roughly those first whose boxes are nearest to `box`; the visitor returns the new, shorter
/// reach.
void each_part_near(const Mesh& mesh, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// For rays; not for users.
const MeshTree& triangle_tree(const Mesh& mesh);

/// Whether a closed mesh goes round the point; false for one that isn't closed. Points of the surface itself are told
/// by the triangles.
bool solid_contains(const Mesh& mesh, const Vec3& point);

inline std::uint32_t part_neighbour(const Mesh& mesh, std::uint32_t part, std::uint32_t side) {
    return mesh.neighbour(part, side);
}

}  // namespace abut
