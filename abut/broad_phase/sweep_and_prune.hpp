#pragma once

// Boxes sorted by where they begin along an axis: the broad phase for pairs among many that all move.

#include <abut/broad_phase/detail/box_soa.hpp>
#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {
namespace detail {

/// The axes in cyclic order, so that `first` becomes axis 0.
template <int D, class T>
glm::vec<D, T> turned(const glm::vec<D, T>& v, int first) {
    glm::vec<D, T> result;
    for (int i = 0; i < D; ++i) result[i] = v[(first + i) % D];
    return result;
}
template <int D>
Aabb<D> turned(const Aabb<D>& box, int first) {
    return {turned<D>(box.min, first), turned<D>(box.max, first)};
}
/// Undoes `turned`.
template <int D>
Aabb<D> turned_back(const Aabb<D>& box, int first) {
    return turned<D>(box, (D - first) % D);
}

/// Equal parts of an axis between two finite places, at most 2^16; the outermost have no end.
struct Parts {
    std::uint32_t count = 1;
    float low = 0, high = 0;
    float scale = 0;  ///< parts per length

    /// Monotone in x.
    std::uint32_t at(float x) const {
        const float place = (std::clamp(x, low, high) - low) * scale;
        return std::min(static_cast<std::uint32_t>(static_cast<std::int32_t>(place)), count - 1);
    }
};

/// The columns of a box: `more` beyond the first, and the same in `more_rows` further rows of columns. In 2D each row
/// has one column.
struct ColumnSpan {
    std::uint32_t first = 0;
    std::uint16_t more_rows = 0, more = 0;
};

template <int D>
struct SweepPlan {
    int axis = 0;
    std::array<Parts, D - 1> parts;  ///< along the axes that follow

    std::uint32_t row() const { return D == 2 ? 1 : parts[D - 2].count; }
    std::uint32_t columns() const { return parts[0].count * row(); }
    ColumnSpan span(const Aabb<D>& turned_box) const {
        std::uint32_t first[2] = {}, last[2] = {};
        for (std::size_t k = 0; k < D - 1; ++k) {
            first[k] = parts[k].at(turned_box.min[static_cast<int>(k) + 1]);
            last[k] = parts[k].at(turned_box.max[static_cast<int>(k) + 1]);
        }
        return {first[0] * row() + first[1], static_cast<std::uint16_t>(last[0] - first[0]),
                static_cast<std::uint16_t>(last[1] - first[1])};
    }
};

}  // namespace detail

/// A BroadPhase: sweep and prune, in columns (concept.hpp documents each function).
///
/// Sorts the boxes along the axis on which the fewest overlap, and compares each with those that begin before it ends.
/// A sweep along one axis takes n^(5/3) in 3D. Where that is too many comparisons, space is divided into columns along
/// the other axes, and a box is copied into each column that it overlaps; a pair is reported in the first column that
/// has both. Queries descend a tree over the sorted boxes: 16 neighbours have a common box, 16 of these again, and so
/// on.
///
/// `update` sorts anew, by insertion from the last order where that is nearly right. Axis and columns are chosen at the
/// build from a sample of the boxes, and again once the comparisons cost 1.3 times as much as after that. Counts
/// decide, never a clock.
///
/// Christer Ericson, "Real-Time Collision Detection", 2005, section 7.5; David Baraff, "Dynamic Simulation of
/// Non-Penetrating Rigid Bodies", 1992.
///
/// Up to 2^30 items. Memory: at most 71 bytes an item in 3D, 58 in 2D, and some thousand for each structure.
template <int D>
class SweepAndPrune : public detail::BroadPhaseInterface<SweepAndPrune<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return size_; }
    /// The common box of all items; Aabb::empty() without any.
    Aabb<D> bounds() const { return bounds_; }
    /// The chosen axis and columns; for tests and visualization.
    const detail::SweepPlan<D>& plan() const { return plan_; }

private:
    friend detail::BroadPhaseInterface<SweepAndPrune<D>, D>;
    struct Place {
        std::uint32_t key;  ///< the lower bound along the axis, as an integer of the same order
        std::uint32_t item;
    };
    static constexpr std::uint32_t max_columns(std::size_t boxes) { return static_cast<std::uint32_t>(boxes / 16 + 1); }
    static constexpr std::size_t max_copies(std::size_t boxes) { return boxes + boxes / 2; }
    void plan_anew(std::span<const Aabb<D>> boxes);
    void sort(std::span<const Aabb<D>> boxes);
    void place(std::span<const Aabb<D>> boxes);
    template <int axis>
    void place_along(std::span<const Aabb<D>> boxes);
    template <int axis>
    std::size_t count_copies(std::span<const Aabb<D>> boxes);
    void end_column(std::size_t i);
    void build_tree();
    double cost() const;

    bool visit_overlapping_below(std::size_t level, std::size_t first, const Aabb<D>& box,
                                 detail::ItemCall visit) const;
    template <class Reach>
    void visit_within_below(std::size_t level, std::size_t first, Reach& reach, detail::ReachCall visit) const;
    template <class Reach>
    void visit_within(Reach reach, detail::ReachCall visit) const;

    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const SweepAndPrune& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float reach, detail::ReachCall visit) const;

    std::size_t size_ = 0;
    detail::SweepPlan<D> plan_;
    double planned_cost_ = 0;
    Aabb<D> bounds_ = Aabb<D>::empty();
    std::vector<Place> order_, scratch_;     ///< the sorted items, and as much work memory
    std::size_t filled_ = 0;                 ///< the number of items that are not empty
    std::vector<detail::ColumnSpan> spans_;  ///< of each item
    std::vector<std::uint32_t> columns_;     ///< where each column ends in the rows, at a box of NaNs

    // The sorted boxes, column by column, with all axes turned so that the plan's is axis 0.
    std::size_t count_ = 0;
    detail::BoxSoa<D> boxes_;
    std::vector<std::uint32_t> items_;     ///< with copy_bits
    detail::BoxSoa<D> tree_;               ///< common boxes, level by level
    std::array<std::size_t, 9> levels_{};  ///< where each level begins in the tree, and where the last one ends
    std::size_t level_count_ = 0;
};

extern template class SweepAndPrune<2>;
extern template class SweepAndPrune<3>;

}  // namespace abut
