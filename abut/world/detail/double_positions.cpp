#include <abut/broad_phase/boxes.hpp>
#include <abut/math/dvec.hpp>
#include <abut/world/detail/double_positions.hpp>

namespace abut::detail {
namespace {

/// Boxes are rounded to at most 1e-3 up to here.
constexpr double always_near = 8192;

template <int D>
bool is_finite(const DVec<D>& position) {
    return std::isfinite(length_squared(position));
}

}  // namespace

template <int D>
void DoublePositions<D>::set(std::uint32_t slot, const DVec<D>& position) {
    if (slot >= of_slot_.size()) {
        if (!are_used_) origin_ = is_finite(position) ? position : DVec<D>(0.0);
        are_used_ = true;
        near_ = std::max(near_, always_near);
        of_slot_.resize(slot + 1, DVec<D>(0.0));
    }
    of_slot_[slot] = position;
}

template <int D>
Aabb<D> DoublePositions<D>::item_box(std::uint32_t slot, const Aabb<D>& about_item) {
    if (!is_finite(of_slot_[slot])) return Aabb<D>::empty();
    const DVec<D> offset = of_slot_[slot] - origin_;
    are_far_ = are_far_ || largest(offset) > near_;
    return moved_outwards(about_item, offset);
}

/// Each side moves out by more than the rounding to float.
template <int D>
Aabb<D> DoublePositions<D>::moved_outwards(const Aabb<D>& box, const DVec<D>& offset) {
    constexpr double relative = 0x1p-23, least = 0x1p-149;
    if (is_empty(box)) return box;  // its sides are infinite
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        const double min = static_cast<double>(box.min[i]) + offset[i],
                     max = static_cast<double>(box.max[i]) + offset[i];
        result.min[i] = static_cast<float>(min - (relative * std::abs(min) + least));
        result.max[i] = static_cast<float>(max + (relative * std::abs(max) + least));
    }
    return result;
}

template <int D>
bool DoublePositions<D>::surely_overlap(const Aabb<D>& a, const Aabb<D>& b) {
    constexpr float rounding = 0x1p-20f;
    bool result = true;
    for (int i = 0; i < D; ++i) {
        const float largest = std::max(std::max(std::abs(a.min[i]), std::abs(a.max[i])),
                                       std::max(std::abs(b.min[i]), std::abs(b.max[i])));
        result = result && std::min(a.max[i], b.max[i]) - std::max(a.min[i], b.min[i]) > rounding * largest;
    }
    return result;
}

template <int D>
MovingBox<D> DoublePositions<D>::about_origin(const MovingBox<D>& box, const DVec<D>& position) const {
    constexpr double rounding = 0x1p-50;
    MovingBox<D> result = box;
    const DVec<D> offset = position - origin_;
    result.center += offset;
    result.half += DVec<D>(rounding * (largest(box.center) + largest(offset)));
    return result;
}

/// From then on an item is far if it is twice as far from the origin as any item now: so origins are few.
template <int D>
void DoublePositions<D>::move_origin(FunctionRef<bool(std::uint32_t)> is_in_use) {
    are_far_ = false;
    DVec<D> low(std::numeric_limits<double>::infinity()), high(-low);
    for (std::uint32_t slot = 0; slot < of_slot_.size(); ++slot) {
        if (!is_finite(of_slot_[slot]) || !is_in_use(slot)) continue;
        low = glm::min(low, of_slot_[slot]);
        high = glm::max(high, of_slot_[slot]);
    }
    if (!(low.x <= high.x)) return;
    origin_ = low + (high - low) * 0.5;
    near_ = std::max(always_near, largest(high - low));
}

template <int D>
DVec<D> offset_of(const View<D>& view) {
    return std::visit(
        [](const auto& placed) {
            if constexpr (requires { placed.place; })
                return placed.place.offset;
            else
                return DVec<D>(placed.offset);
        },
        view);
}

template <int D>
void set_offset(View<D>& view, const DVec<D>& own, const DVec<D>& offset) {
    std::visit(
        [&](auto& placed) {
            if constexpr (requires { placed.place; })
                placed.place.offset = own + offset;
            else
                placed.offset = own[0] + dot(placed.normal, offset);
        },
        view);
}

template class DoublePositions<2>;
template class DoublePositions<3>;
template DVec<2> offset_of(const View<2>&);
template DVec<3> offset_of(const View<3>&);
template void set_offset(View<2>&, const DVec<2>&, const DVec<2>&);
template void set_offset(View<3>&, const DVec<3>&, const DVec<3>&);

}  // namespace abut::detail
