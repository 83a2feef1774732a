#pragma once

// Positions of items in double: what a world far from the origin needs beside the poses of its items.

#include <abut/math/aabb.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/shape/view/view.hpp>
#include <abut/world/options.hpp>

#include <cstdint>
#include <vector>

namespace abut::detail {

/// A query's filter, and the position that the query and its answer are relative to: 0 if positions are floats.
template <int D>
struct QueryAt {
    QueryAt(const Filter& its_filter) : filter(its_filter) {}
    QueryAt(const Filter& its_filter, const DVec<D>& position) : filter(its_filter), origin(position) {}

    const Filter& filter;
    DVec<D> origin{0.0};
};

/// The positions of a LargeWorld, by slot, where the poses of the items are at 0; nothing in a World. Positions are
/// subtracted before anything else, so that no answer depends on where the origin is.
template <int D>
class DoublePositions {
public:
    bool are_used() const { return are_used_; }
    /// Whether an item is so far from the origin of the boxes that another origin may be nearer to most items.
    bool are_far() const { return are_far_; }
    const DVec<D>& of(std::uint32_t slot) const { return of_slot_[slot]; }
    /// What an item's contacts and all that is tested with it are relative to.
    DVec<D> frame(std::uint32_t slot) const { return are_used_ ? of_slot_[slot] : DVec<D>(0.0); }

    /// The first one becomes the origin of the boxes.
    void set(std::uint32_t slot, const DVec<D>& position);
    /// Keeps the present position as that of the last update, which gets the next index.
    void keep_previous(std::uint32_t slot) { previous_.push_back(of_slot_[slot]); }
    void keep_previous(const DVec<D>& position) { previous_.push_back(position); }
    const DVec<D>& previous(std::uint32_t index) const { return previous_[index]; }
    void clear_previous() { previous_.clear(); }

    // Boxes, and moving boxes, with a margin for rounding.

    /// The box of an item about the origin, from that about its position; empty if the position is not finite.
    Aabb<D> item_box(std::uint32_t slot, const Aabb<D>& about_item);
    const DVec<D>& origin() const { return origin_; }
    Aabb<D> about_origin(const Aabb<D>& box, const DVec<D>& position) const {
        return moved_outwards(box, position - origin_);
    }
    MovingBox<D> about_origin(const MovingBox<D>& box, const DVec<D>& position) const;
    static Aabb<D> moved_outwards(const Aabb<D>& box, const DVec<D>& offset);
    /// Whether boxes about the origin overlap by more than their rounding.
    static bool surely_overlap(const Aabb<D>& a, const Aabb<D>& b);
    /// Moves the origin into the middle of the items in use. All boxes are then to be set again.
    void move_origin(FunctionRef<bool(std::uint32_t)> is_in_use);

private:
    std::vector<DVec<D>> of_slot_, previous_;
    DVec<D> origin_{0.0};
    double near_ = 0;  // the largest coordinate about the origin that isn't far
    bool are_used_ = false, are_far_ = false;
};

/// Where a view is, for `set_offset`: of a half-space the offset of its plane.
template <int D>
DVec<D> offset_of(const View<D>& view);
/// Moves a view from `own`, where it was, by an offset.
template <int D>
void set_offset(View<D>& view, const DVec<D>& own, const DVec<D>& offset);

extern template class DoublePositions<2>;
extern template class DoublePositions<3>;

}  // namespace abut::detail
