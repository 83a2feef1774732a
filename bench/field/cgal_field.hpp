#pragma once

// Point-in-mesh tests with CGAL's Side_of_triangle_mesh and exact predicates.

#include <abut/math/vec.hpp>

#include <memory>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

class CgalSolid {
public:
    CgalSolid(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    /// 1 inside, 0 outside or on the surface. Builds its tree in each call.
    void inside(std::span<const Vec3> points, std::span<double> out) const;

private:
    struct Mesh;
    std::shared_ptr<const Mesh> mesh_;
};

}  // namespace abut::bench
