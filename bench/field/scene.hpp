#pragma once

// A closed mesh to bake fields of, and points near its surface.

#include "../../test/oracle/random.hpp"
#include <abut/bake/field.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::bench {

/// A bumpy ball of 87,024 triangles in a cube of 1.1 times its longest side.
struct FieldScene {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    Vec3 corner{};   ///< minimum corner of the cube
    float side = 0;  ///< edge of the cube

    float cell(std::uint32_t cells) const { return side / static_cast<float>(cells); }
    /// Options for a field of exactly this many cells along each axis.
    FieldOptions<3> options(std::uint32_t cells) const;
};
using SharedFieldScene = std::shared_ptr<const FieldScene>;

SharedFieldScene field_scene();

/// Points up to `reach` from the surface, in random order.
std::vector<Vec3> places_near(const FieldScene& scene, float reach, std::size_t count, oracle::Random& random);

/// The lattice samples closest to these points, for a field of this many cells.
std::vector<Vec3> samples_at(const FieldScene& scene, std::uint32_t cells, std::span<const Vec3> places);

/// Clamped to [-1, 1] cells: beyond that some fields store less than others.
inline double near_in_cells(double distance, float cell) {
    const double cells = distance / static_cast<double>(cell);
    return cells < -1 ? -1 : cells > 1 ? 1 : cells;
}

}  // namespace abut::bench
