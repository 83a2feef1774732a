#pragma once

// Voxel map: level geometry in 3D on a regular grid.

#include <abut/math/result.hpp>
#include <abut/shape/detail/changed_box.hpp>
#include <abut/shape/view/view.hpp>

#include <cstdint>
#include <memory>
#include <span>

#include <glm/vec3.hpp>

namespace abut {

/// The union of its solid voxels, each of which is a box. Voxel (x, y, z) is part x + nx * (y + ny * z) of a map of nx
/// by ny by nz voxels, and covers (x, y, z) to (x + 1, y + 1, z + 1), times the cell size. Copies share the data until
/// one of them changes. Memory: about half a byte a voxel, one bit of which says whether it is solid.
class VoxelMap {
public:
    /// Takes a bit for each voxel, by its part number: bit i % 64 of word i / 64; those beyond the last voxel are
    /// ignored. Returns a Problem if there are no voxels, more than 2^31 of them, or another number of words, or if
    /// `cell` isn't positive or makes a coordinate infinite.
    static Result<VoxelMap> build(std::span<const std::uint64_t> bits, const glm::uvec3& count, const Vec3& cell);
    static Result<VoxelMap> build(std::span<const std::uint64_t> bits, const glm::uvec3& count, float cell);

    /// Makes a voxel solid or empty. All answers are those of a map that is built with it. It takes about a
    /// microsecond, and the time of a copy if another map shares the data. In a World: World::edit_shape.
    void set(std::uint32_t index, bool solid);
    void set(std::uint32_t x, std::uint32_t y, std::uint32_t z, bool solid) { set(index(x, y, z), solid); }

    /// Whether a voxel is solid.
    bool at(std::uint32_t index) const;
    bool at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const { return at(index(x, y, z)); }
    /// The part number of a voxel.
    std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;

    std::span<const std::uint64_t> bits() const;  ///< those beyond the last voxel are zero
    glm::uvec3 count() const;                     ///< of voxels along each axis
    Vec3 cell() const;

    std::uint32_t size() const;            ///< number of voxels, including empty ones
    Aabb3 box(std::uint32_t index) const;  ///< the box of a voxel

    /// The adjacent solid voxel across side 2 * axis (high end) or 2 * axis + 1 (low end); no_neighbour if it is empty
    /// or outside.
    std::uint32_t neighbour(std::uint32_t voxel, std::uint32_t side) const;

private:
    struct Data;
    explicit VoxelMap(std::shared_ptr<Data> data) : data_(std::move(data)) {}

    friend Aabb3 bounds(const VoxelMap& map);
    friend Aabb3 take_changed(VoxelMap& map);
    friend void each_part(const VoxelMap& map, const Aabb3& box, detail::PartVisitor<3> visit);
    friend void each_part_along(const VoxelMap& map, const MovingBox<3>& box, detail::PartReachVisitor<3> visit);
    friend void each_part_near(const VoxelMap& map, const Aabb3& box, detail::PartReachVisitor<3> visit);

    std::shared_ptr<Data> data_;  // of this map alone before it changes
    detail::ChangedBox<3> changed_;
};

/// The box around all solid voxels; empty if there are none.
Aabb3 bounds(const VoxelMap& map);

/// The box outside of which no answer has changed since the last call, for World::edit_shape.
Aabb3 take_changed(VoxelMap& map);

/// Visits the solid voxels whose boxes overlap `box`; the visitor returns false to stop.
void each_part(const VoxelMap& map, const Aabb3& box, detail::PartVisitor<3> visit);

/// Visits the solid voxels that the moving box overlaps, roughly front to back. The visitor returns the new, shorter
/// reach.
void each_part_along(const VoxelMap& map, const MovingBox<3>& box, detail::PartReachVisitor<3> visit);

/// Visits the solid voxels, roughly nearest first by the distance to `box`. The visitor returns the new, shorter reach.
void each_part_near(const VoxelMap& map, const Aabb3& box, detail::PartReachVisitor<3> visit);

inline std::uint32_t part_neighbour(const VoxelMap& map, std::uint32_t part, std::uint32_t side) {
    return map.neighbour(part, side);
}

namespace detail {

template <>
inline constexpr CompositeKind composite_kind<VoxelMap> = CompositeKind::voxel_map;

}  // namespace detail

}  // namespace abut
