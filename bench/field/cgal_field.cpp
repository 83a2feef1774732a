#include "cgal_field.hpp"

#include <cstddef>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

namespace abut::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

}  // namespace

struct CgalSolid::Mesh {
    CGAL::Surface_mesh<Kernel::Point_3> surface;
};

CgalSolid::CgalSolid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    const auto mesh = std::make_shared<Mesh>();
    using Index = CGAL::SM_Vertex_index;
    for (const Vec3& p : points) mesh->surface.add_vertex({p.x, p.y, p.z});
    for (const glm::uvec3& t : triangles) mesh->surface.add_face(Index(t.x), Index(t.y), Index(t.z));
    mesh_ = mesh;
}

void CgalSolid::inside(std::span<const Vec3> points, std::span<double> out) const {
    const CGAL::Side_of_triangle_mesh<CGAL::Surface_mesh<Kernel::Point_3>, Kernel> side(mesh_->surface);
    for (std::size_t i = 0; i < points.size(); ++i)
        out[i] = side(Kernel::Point_3(points[i].x, points[i].y, points[i].z)) == CGAL::ON_BOUNDED_SIDE ? 1 : 0;
}

}  // namespace abut::bench
