#pragma once

// The surface of a solid as triangles, in its own frame: that of a closed mesh or of a convex polytope. For .cpp files.

#include <abut/shape/mesh/surface.hpp>
#include <abut/shape/view/view.hpp>

#include <array>

namespace abut::detail {

/// Whether the shape is the solid of a closed mesh, and whether it is a box or a polyhedron, without a ball around it.
bool is_solid_mesh(const View<3>& shape);
bool is_solid_polytope(const View<3>& shape);

/// A solid mesh as its triangles alone; any other shape as it is.
View<3> surface_view(const View<3>& shape);

/// Refers to the mesh or the polytope. Triangles are counter-clockwise seen from outside, unless the mesh is inward.
class SolidSurface {
public:
    explicit SolidSurface(const MeshSurface& mesh) : mesh_(&mesh) {}
    explicit SolidSurface(const Convex<3>& polytope);

    std::uint32_t triangle_count() const { return count_of_triangles(); }
    std::array<std::uint32_t, 3> triangle(std::uint32_t index) const;
    Vec3 position(std::uint32_t point) const;
    std::uint32_t point_count() const;
    /// Like that of a mesh.
    std::uint32_t neighbour(std::uint32_t triangle, std::uint32_t side) const;
    /// Whether `each_triangle` goes down a tree. Otherwise it tests all triangles.
    bool has_tree() const { return mesh_ != nullptr; }
    /// Visits at least the triangles whose boxes overlap the box; false stops.
    void each_triangle(const Aabb3& box, FunctionRef<bool(std::uint32_t triangle)> visit) const;

    std::span<const std::uint32_t> components() const;
    bool is_inward() const { return mesh_ != nullptr && mesh_->inward; }
    Aabb3 box() const;

private:
    /// A triangle of the fan of a face.
    struct FanTriangle {
        std::uint32_t face, number;
    };

    std::uint32_t count_of_triangles() const;
    FanTriangle fan_triangle(std::uint32_t index) const;
    std::uint32_t triangle_across(std::uint32_t from, std::uint32_t to) const;

    const MeshSurface* mesh_ = nullptr;
    const Facets* facets_ = nullptr;  ///< of a polyhedron
    const Vec3* points_ = nullptr;    ///< of a polyhedron
    std::uint32_t point_count_ = 8;
    Vec3 half_{0};  ///< of a box
};

}  // namespace abut::detail
