#pragma once

// Triangle mesh: level geometry in 3D, any triangles in any order.

#include <abut/math/point_span.hpp>
#include <abut/math/result.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view/view.hpp>

#include <cstddef>
#include <memory>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// The union of its triangles, each of zero thickness and two-sided. Part i is triangle i of the input. Only `contains`
/// treats a closed mesh as solid; `solid(mesh)` is solid in every query. Immutable: copies share the data, so one mesh
/// at many poses needs one tree. Memory: the input, 12 bytes a triangle for adjacency, and 34 to 39 bytes a triangle
/// for the tree if neighbours share corner positions, else about 90.
class Mesh {
public:
    /// Takes one or more triangles; degenerate, duplicate and intersecting ones are allowed. Returns a Problem if a
    /// coordinate is not finite or an index is out of range; it names the point or triangle.
    static Result<Mesh> build(const PointSpan<3>& points, std::span<const glm::uvec3> triangles);

    std::span<const Vec3> points() const;
    std::span<const glm::uvec3> triangles() const;
    Triangle3 triangle(std::uint32_t index) const;

    /// True if the mesh is watertight: each edge is used equally often in both directions. Points at the same position
    /// count as one.
    bool closed() const;

    /// The adjacent triangle across the edge from corner `edge` to the next; points at the same position count as one.
    /// It is no_neighbour at a boundary edge and at a T-junction, and many_neighbours at a non-manifold edge. The
    /// orientation of the two triangles isn't compared.
    std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t edge) const;

private:
    explicit Mesh(std::shared_ptr<const detail::MeshSurface> data) : data_(std::move(data)) {}

    friend Aabb3 bounds(const Mesh& mesh);
    friend void each_part(const Mesh& mesh, const Aabb3& box,
                          FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_along(const Mesh& mesh, const MovingBox<3>& box,
                                FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    friend void each_part_near(const Mesh& mesh, const Aabb3& box,
                               FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);
    /// The tree of the mesh, for ray casts; found by argument-dependent lookup alone.
    friend const detail::MeshTree& triangle_tree(const Mesh& mesh);
    /// All data of the mesh, for queries of solids.
    friend const detail::MeshSurface& mesh_surface(const Mesh& mesh);
    friend bool solid_contains(const Mesh& mesh, const Vec3& point);
    friend Result<Mesh> load_mesh(std::span<const std::byte> bytes);

    std::shared_ptr<const detail::MeshSurface> data_;
};

Aabb3 bounds(const Mesh& mesh);

/// Visits the triangles whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const Mesh& mesh, const Aabb3& box, FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles whose boxes the moving box overlaps, roughly front to back. The visitor returns the new,
/// shorter reach.
void each_part_along(const Mesh& mesh, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// Visits the triangles, roughly nearest first by the distance of their boxes to `box`. The visitor returns the new,
/// shorter reach.
void each_part_near(const Mesh& mesh, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit);

/// True if a closed mesh winds around the point; false for a mesh that isn't closed. Points on the surface itself are
/// left to the tests of its triangles.
bool solid_contains(const Mesh& mesh, const Vec3& point);

inline std::uint32_t part_neighbour(const Mesh& mesh, std::uint32_t part, std::uint32_t side) {
    return mesh.neighbour(part, side);
}

namespace detail {

template <>
inline constexpr CompositeKind composite_kind<Mesh> = CompositeKind::mesh;

}  // namespace detail

}  // namespace abut
