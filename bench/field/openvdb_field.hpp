#pragma once

// OpenVDB's signed distance fields: baked on one thread, sampled through an accessor.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <memory>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

enum class OpenvdbDistances {
    cleaned,   ///< default options: self-intersections are removed, and the field is smoothed
    measured,  ///< unmodified distances to the triangles
};

class OpenvdbField {
public:
    /// Bakes with voxels from `origin` on and this half width of the band.
    OpenvdbField(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const Vec3& origin, float cell,
                 float band, OpenvdbDistances distances);

    /// Trilinear interpolation at each point.
    void distance(std::span<const Vec3> points, std::span<double> out) const;

    std::size_t bytes() const;

private:
    struct Grid;
    std::shared_ptr<const Grid> grid_;
};

}  // namespace abut::bench
