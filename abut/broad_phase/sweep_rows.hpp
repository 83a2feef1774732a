#pragma once

// Boxes in the order of a sweep, and common boxes of neighbours for the queries. Not for users.

#include <abut/broad_phase/detail/box_soa.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// An item has a bit for each axis along which a box began before the column that this copy is in.
inline constexpr std::uint32_t copy_bits = 3u << 30;

/// Columns of boxes, one after the other, with a box of NaNs behind each. Every 16 boxes have a common box of those
/// that begin in their column, every 16 of these have one, and so on.
template <int D>
class SweepRows {
public:
    /// Room for so many boxes, those of NaNs among them.
    void reserve(std::size_t count);
    void set_item(std::size_t i, std::uint32_t item) { items_[i] = item; }
    void set_box(std::size_t i, const Aabb<D>& box) { boxes_.set(i, box); }
    void end_column(std::size_t i) {
        set_item(i, ~0u);
        set_box(i, nan_box<D>());
    }
    /// When the first `count` are set.
    void make_blocks(std::size_t count);

    std::size_t count() const { return count_; }
    BoxSoaView<D> boxes() const { return boxes_.view(); }
    const std::uint32_t* items() const { return items_.data(); }
    Aabb<D> bounds() const;

    /// Every item whose box overlaps this one, which is not empty. False where the visitor has had enough.
    bool visit_overlapping(const Aabb<D>& box, ItemCall visit) const;
    /// Every item within reach, roughly the nearest first.
    void visit_within(RayReach<D> reach, ReachCall visit) const;
    void visit_within(BoxReach<D> reach, ReachCall visit) const;

private:
    std::size_t count_ = 0;
    BoxSoa<D> boxes_;
    std::vector<std::uint32_t> items_;
    BoxSoa<D> blocks_;                     // level by level
    std::array<std::size_t, 9> levels_{};  // where each begins, and where the last ends: it has 16 blocks, or fewer
    std::size_t level_count_ = 0;
};

extern template class SweepRows<2>;
extern template class SweepRows<3>;

}  // namespace abut
