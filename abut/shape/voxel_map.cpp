#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/detail/cell_grid.hpp>
#include <abut/shape/voxel_map.hpp>

#include <string>
#include <vector>

namespace abut {

using namespace detail;

struct VoxelMap::Data {
    std::vector<std::uint64_t> bits;
    CellGrid<3> grid;
    std::uint32_t size = 0;

    bool operator()(std::uint32_t index) const { return (bits[index / 64] >> index % 64 & 1) != 0; }

    template <class Reach>
    void each_within(const Reach& reach, PartReachVisitor<3> visit) const {
        grid.each_within(reach, *this,
                         [&](const Aabb3& box, std::uint32_t index) { return visit(convex(box), index); });
    }
};

Result<VoxelMap> VoxelMap::build(std::span<const std::uint64_t> bits, const glm::uvec3& count, const Vec3& cell) {
    detail::enter_library();
    constexpr std::uint64_t max_voxels = std::uint64_t{1} << 31;
    std::uint64_t size = 1;
    for (int axis = 0; axis < 3; ++axis) {
        if (count[axis] == 0) return Problem{ProblemCode::empty_input, "a voxel map needs voxels", 0};
        size *= count[axis];
        if (size > max_voxels)
            return Problem{ProblemCode::too_large, "a voxel map has at most 2^31 voxels", max_voxels};
    }
    if (bits.size() != (size + 63) / 64)
        return Problem{ProblemCode::bad_argument,
                       std::to_string(size) + " voxels take " + std::to_string((size + 63) / 64) +
                           " words of 64 bits, and there are " + std::to_string(bits.size()),
                       0};
    auto data = std::make_shared<Data>();
    data->grid.count = count;
    data->grid.cell = cell;
    if (!(cell.x > 0 && cell.y > 0 && cell.z > 0 && is_finite(data->grid.box_of(glm::uvec3(0u), count).max)))
        return Problem{ProblemCode::bad_argument, "the cells' sizes must be above zero, and their places finite", 0};
    data->bits.assign(bits.begin(), bits.end());
    if (size % 64 != 0) data->bits.back() &= (std::uint64_t{1} << size % 64) - 1;
    data->size = static_cast<std::uint32_t>(size);
    data->grid.build(*data);
    return VoxelMap(std::move(data));
}

Result<VoxelMap> VoxelMap::build(std::span<const std::uint64_t> bits, const glm::uvec3& count, float cell) {
    return build(bits, count, Vec3(cell));
}

void VoxelMap::set(std::uint32_t index, bool solid) {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    if (index >= size() || at(index) == solid) return;
    if (data_.use_count() > 1) data_ = std::make_shared<Data>(*data_);
    data_->bits[index / 64] ^= std::uint64_t{1} << index % 64;
    data_->grid.update(index, *data_);
    changed_.add(box(index));
}

bool VoxelMap::at(std::uint32_t index) const {
    ABUT_ASSERT(index < size());
    return index < size() && (*data_)(index);
}

std::uint32_t VoxelMap::index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const glm::uvec3& of = data_->grid.count;
    ABUT_ASSERT(x < of.x && y < of.y && z < of.z);
    return x < of.x && y < of.y && z < of.z ? data_->grid.index({x, y, z}) : size();
}

std::span<const std::uint64_t> VoxelMap::bits() const {
    return data_->bits;
}
glm::uvec3 VoxelMap::count() const {
    return data_->grid.count;
}
Vec3 VoxelMap::cell() const {
    detail::enter_library();
    return data_->grid.cell;
}
std::uint32_t VoxelMap::size() const {
    return data_->size;
}

Aabb3 VoxelMap::box(std::uint32_t index) const {
    detail::enter_library();
    ABUT_ASSERT(index < size());
    return data_->grid.box_of(data_->grid.place_of(index));
}

std::uint32_t VoxelMap::neighbour(std::uint32_t voxel, std::uint32_t side) const {
    ABUT_ASSERT(voxel < size() && side < 6);
    return data_->grid.neighbour(voxel, side, *data_);
}

Aabb3 bounds(const VoxelMap& map) {
    detail::enter_library();
    return map.data_->grid.bounds();
}

Aabb3 take_changed(VoxelMap& map) {
    return map.changed_.take();
}

void each_part(const VoxelMap& map, const Aabb3& box, PartVisitor<3> visit) {
    detail::enter_library();
    map.data_->grid.each_overlapping(
        box, *map.data_, [&](const Aabb3& of_voxel, std::uint32_t index) { return visit(convex(of_voxel), index); });
}

void each_part_along(const VoxelMap& map, const MovingBox<3>& box, PartReachVisitor<3> visit) {
    detail::enter_library();
    map.data_->each_within(RayReach<3>::of_box(box), visit);
}

void each_part_near(const VoxelMap& map, const Aabb3& box, PartReachVisitor<3> visit) {
    detail::enter_library();
    constexpr float any = std::numeric_limits<float>::infinity();
    map.data_->each_within(BoxReach<3>(box, any), visit);
}

}  // namespace abut
