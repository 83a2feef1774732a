#pragma once

// OpenVDB's signed distance fields: baked on one thread, sampled through an accessor.

#include <abut/math/vec.hpp>

#include <cstddef>
#include <memory>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

enum class OpenvdbDistances {
    tidied,    ///< as it makes them where nothing else is said: what crosses itself is cut away, and all is smoothed
    measured,  ///< as they come from the triangles
};

class OpenvdbField {
public:
    /// With voxels from `origin` on, and so many of them kept on each side of the surface.
    OpenvdbField(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, const Vec3& origin, float cell,
                 float band, OpenvdbDistances distances);

    /// At each point, interpolated between the eight voxels around it.
    void distance(std::span<const Vec3> points, std::span<double> out) const;

    std::size_t bytes() const;

private:
    struct Grid;
    std::shared_ptr<const Grid> grid_;
};

}  // namespace abut::bench
