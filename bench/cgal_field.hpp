#pragma once

// Whether points are inside of a closed mesh: CGAL's Side_of_triangle_mesh, with exact predicates.

#include <abut/math/vec.hpp>

#include <memory>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

class CgalSolid {
public:
    CgalSolid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    /// 1 inside, 0 outside or on the surface. Makes the tree that it looks in each time.
    void inside(std::span<const Vec3> points, std::span<double> out) const;

private:
    struct Mesh;
    std::shared_ptr<const Mesh> mesh_;
};

}  // namespace abut::bench
