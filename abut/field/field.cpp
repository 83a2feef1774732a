#include <abut/field/check.hpp>
#include <abut/field/field.hpp>
#include <abut/field/look_up/batch.hpp>
#include <abut/field/look_up/look_up.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <cmath>
#include <limits>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// The strides of a grid whose first axis is the fastest.
template <int D>
glm::vec<D, std::uint32_t> strides(const glm::vec<D, std::uint32_t>& counts) {
    glm::vec<D, std::uint32_t> result(1);
    for (int a = 1; a < D; ++a) result[a] = result[a - 1] * counts[a - 1];
    return result;
}

template <int D>
FieldFrame<D> frame_of(const FieldData<D>& data) {
    FieldFrame<D> result;
    result.inverse = static_cast<float>(1 / static_cast<double>(data.cell));
    result.stride = strides<D>(data.cells + 1u);
    result.block_row = strides<D>(data.cells / brick_cells<D>);
    result.corners = strides<D>(data.cells / brick_cells<D> + 1u);
    for (int a = 0; a < D; ++a) {
        const auto lane = static_cast<std::size_t>(a);
        result.low[lane] = data.origin[a];
        result.high[lane] = static_cast<float>(static_cast<double>(data.origin[a]) +
                                               static_cast<double>(data.cell) * static_cast<double>(data.cells[a]));
        result.end[lane] = static_cast<float>(data.cells[a]);
        result.last[lane] = static_cast<float>(data.cells[a] - 1);
    }
    return result;
}

}  // namespace

template <int D>
Field<D>::Field(FieldData<D> data) {
    if (data.steps.empty()) data.step = 0;
    if (data.lookup == FieldLookup::gradient)
        for (const Vec<D>& gradient : data.gradient) data.direction.push_back(packed(gradient));
    data.gradient = {};
    data.frame = frame_of(data);
    ABUT_ASSERT(!fault_of(data));
    data_ = std::make_shared<const FieldData<D>>(std::move(data));
}

template <int D>
float Field<D>::distance(const Vec<D>& point) const {
    detail::enter_library();
    const FieldData<D>& data = *data_;
    return look_up_distance(data, point);
}

template <int D>
FieldSample<D> Field<D>::sample(const Vec<D>& point) const {
    detail::enter_library();
    const FieldData<D>& data = *data_;
    return look_up_sample(data, point);
}

template <int D>
void Field<D>::distance(std::span<const Vec<D>> points, std::span<float> out) const {
    detail::enter_library();
    ABUT_ASSERT(points.size() == out.size());
    look_up_all(*data_, points, out);
}

template <int D>
void Field<D>::sample(std::span<const Vec<D>> points, std::span<FieldSample<D>> out) const {
    detail::enter_library();
    ABUT_ASSERT(points.size() == out.size());
    look_up_all(*data_, points, out);
}

template <int D>
Aabb<D> Field<D>::volume() const {
    detail::enter_library();
    return volume_of(*data_);
}

template <int D>
std::size_t Field<D>::bytes() const {
    const auto size = [](const auto& numbers) { return numbers.size() * sizeof(numbers[0]); };
    const FieldData<D>& data = *data_;
    return size(data.brick) + size(data.coarse) + size(data.distance) + size(data.steps) + size(data.direction) +
           size(data.closest);
}

template <int D>
Aabb<D> bounds(const Field<D>& field) {
    detail::enter_library();
    const FieldData<D>& data = field.data();
    Aabb<D> result = data.surface;
    // Nothing outside the volume is solid, unless everything is. The linear interpolation of exact distances keeps the
    // solid in any box that contains it, because the distance from a side of the box is linear.
    const Aabb<D> volume = volume_of(data);
    for (int a = 0; a < D; ++a) {
        const float size = std::max(std::abs(volume.min[a]), std::abs(volume.max[a]));
        // With gradients the interpolation has an error of a fraction of a cell.
        const float around = data.lookup == FieldLookup::gradient ? data.cell : 0;
        const float tolerance = 0.5f * data.step + 0x1p-20f * size + around;
        result.min[a] = std::max(result.min[a] - tolerance, volume.min[a]);
        result.max[a] = std::min(result.max[a] + tolerance, volume.max[a]);
        if (!(result.min[a] <= result.max[a])) return Aabb<D>::empty();
    }
    return result;
}

template Field<2>::Field(FieldData<2>);
template Field<3>::Field(FieldData<3>);
template float Field<2>::distance(const Vec2&) const;
template float Field<3>::distance(const Vec3&) const;
template FieldSample<2> Field<2>::sample(const Vec2&) const;
template FieldSample<3> Field<3>::sample(const Vec3&) const;
template void Field<2>::distance(std::span<const Vec2>, std::span<float>) const;
template void Field<3>::distance(std::span<const Vec3>, std::span<float>) const;
template void Field<2>::sample(std::span<const Vec2>, std::span<FieldSample<2>>) const;
template void Field<3>::sample(std::span<const Vec3>, std::span<FieldSample<3>>) const;
template Aabb<2> Field<2>::volume() const;
template Aabb<3> Field<3>::volume() const;
template std::size_t Field<2>::bytes() const;
template std::size_t Field<3>::bytes() const;
template Aabb<2> bounds(const Field<2>&);
template Aabb<3> bounds(const Field<3>&);

}  // namespace abut
