#pragma once

// A hierarchical hash grid: the textbook structure for boxes of very different sizes that all move.

#include <abut/broad_phase/detail/interface.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A BroadPhase: a hierarchical hash grid (concept.hpp documents each function).
///
/// Each level is a uniform grid whose cells have four times the edge of those one level below. A box is stored once, on
/// the finest level whose cells are larger than the box, in the cell that contains its lower corner. It therefore
/// reaches at most one cell further on each axis, and a query on a level tests the cells that it overlaps and the ones
/// before them. If these are more than the boxes of the level, the query tests all of these boxes instead. Pairs are
/// found upwards: each box queries its own level and the coarser ones. The cells of a level are the buckets of a hash
/// table.
///
/// `build` and `update` sort all boxes by their bucket: O(n). A pair search tests O(levels) cells a box. Rays and
/// nearest queries search regions that double in size.
///
/// Christer Ericson, "Real-Time Collision Detection", 2005, section 7.2.
///
/// Up to 2^31 items. Memory: 92 to 96 bytes an item in 3D, 68 to 72 in 2D.
template <int D>
class LayeredGrid : public detail::BroadPhaseInterface<LayeredGrid<D>, D> {
public:
    void build(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);
    void update(std::span<const Aabb<D>> boxes, Executor* executor = nullptr);

    std::size_t size() const { return size_; }
    /// The common box of all items; Aabb::empty() without any.
    Aabb<D> bounds() const { return bounds_; }

private:
    friend detail::BroadPhaseInterface<LayeredGrid<D>, D>;
    using Cell = std::array<std::int32_t, D>;
    struct Entry {
        Aabb<D> box;
        Cell cell;
        std::uint32_t level;
        std::uint32_t item;
    };
    struct Level {
        std::uint32_t level = 0;
        std::uint32_t count = 0;         ///< the number of boxes
        std::uint32_t first_bucket = 0;  ///< there are bit_ceil(count) buckets
    };

    static std::uint32_t bucket_of(const Level& level, const Cell& cell);
    template <class Visit>
    bool visit_level(const Level& level, const Aabb<D>& box, const Visit& visit) const;
    double common_edge() const;

    void visit_pairs(detail::PairsCall visit, Executor* executor) const;
    void visit_pairs(const LayeredGrid& other, detail::PairsCall visit) const;
    void visit_boxes(detail::BoxCall<D> visit) const;
    void visit_overlapping(const Aabb<D>& box, detail::ItemCall visit) const;
    void visit_along(const MovingBox<D>& box, detail::ReachCall visit) const;
    void visit_near(const Aabb<D>& box, float max_distance, detail::ReachCall visit) const;

    std::size_t size_ = 0;
    std::vector<Entry> entries_;               ///< the boxes that are not empty, bucket by bucket
    std::vector<Entry> unsorted_;              ///< the same in the order of the items
    std::vector<std::uint32_t> bucket_begin_;  ///< the first entry of each bucket; at the end, the number of entries
    std::vector<Level> levels_;                ///< those that hold boxes, the finest first
    Aabb<D> bounds_ = Aabb<D>::empty();
};

extern template class LayeredGrid<2>;
extern template class LayeredGrid<3>;

}  // namespace abut
