#pragma once

// The cells of a grid of which some are occupied: what a TileMap and a VoxelMap share. For .cpp files.

#include <abut/math/simd/square_root.hpp>
#include <abut/shape/detail/grid_hierarchy.hpp>
#include <abut/shape/view/parts.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {

/// The range of cells in a block that are occupied, from `first` to the one before `end`.
template <int D>
struct OccupiedRange {
    CellPlace<D> first{0xffffffffu}, end{0u};

    bool any() const { return first[0] < end[0]; }
};
template <int D>
OccupiedRange<D> merged(const OccupiedRange<D>& a, const OccupiedRange<D>& b) {
    return {glm::min(a.first, b.first), glm::max(a.end, b.end)};
}

/// Shrinks a box to the part that the path of a ray or of a moving box may touch. Returns false if it can't tell.
template <int D>
bool clip(const RayReach<D>& reach, DVec<D>& low, DVec<D>& high) {
    double from = 0, to = reach.reach();
    for (int i = 0; i < D; ++i) {
        if (reach.direction()[i] == 0) continue;
        const double at_low = (low[i] - reach.high()[i]) * reach.inverse()[i],
                     at_high = (high[i] - reach.low()[i]) * reach.inverse()[i];
        from = std::max(from, std::min(at_low, at_high));
        to = std::min(to, std::max(at_low, at_high));
    }
    if (!(std::isfinite(from) && std::isfinite(to))) return false;
    for (int i = 0; i < D; ++i) {
        const double a = reach.direction()[i] * from, b = reach.direction()[i] * to;
        const double rounding =
            1e-14 * (std::abs(reach.low()[i]) + std::abs(reach.high()[i]) + std::abs(a) + std::abs(b));
        low[i] = std::max(low[i], reach.low()[i] + std::min(a, b) - rounding);
        high[i] = std::min(high[i], reach.high()[i] + std::max(a, b) + rounding);
    }
    return true;
}
/// The same with the part that is near a box.
template <int D>
bool clip(const BoxReach<D>& reach, DVec<D>& low, DVec<D>& high) {
    const double distance = square_root(reach.max_measure());
    if (!std::isfinite(distance)) return false;
    for (int i = 0; i < D; ++i) {
        low[i] = std::max(low[i], static_cast<double>(reach.box().min[i]) - distance);
        high[i] = std::min(high[i], static_cast<double>(reach.box().max[i]) + distance);
    }
    return true;
}

/// The index of a cell is that of its place, row by row. `is_occupied(index)` is a callable that tells of a cell.
template <int D>
class CellGrid {
public:
    using Place = CellPlace<D>;

    Place count{};  ///< of cells along each axis
    Vec<D> cell{};  ///< the size of a cell

    template <class IsOccupied>
    void build(const IsOccupied& is_occupied) {
        blocks_.build(count, [&](const Place& place) { return range_of(place, is_occupied); });
    }
    /// To be called after a cell has changed.
    template <class IsOccupied>
    void update(std::uint32_t index, const IsOccupied& is_occupied) {
        const Place place = place_of(index);
        blocks_.update(place, place + 1u, [&](const Place& changed) { return range_of(changed, is_occupied); });
    }

    Place place_of(std::uint32_t index) const {
        Place result;
        for (int axis = 0; axis < D; ++axis) {
            result[axis] = index % count[axis];
            index /= count[axis];
        }
        return result;
    }
    std::uint32_t index(const Place& place) const { return static_cast<std::uint32_t>(index_of<D>(place, count)); }

    Aabb<D> box_of(const Place& first, const Place& end) const { return {Vec<D>(first) * cell, Vec<D>(end) * cell}; }
    Aabb<D> box_of(const Place& place) const { return box_of(place, place + 1u); }
    /// The box around all occupied cells; empty if there are none.
    Aabb<D> bounds() const { return box_of(blocks_.all()); }

    /// The occupied cell across side 2 * axis (high end) or 2 * axis + 1 (low end); no_neighbour if there is none.
    template <class IsOccupied>
    std::uint32_t neighbour(std::uint32_t index, std::uint32_t side, const IsOccupied& is_occupied) const {
        const int axis = static_cast<int>(side / 2);
        Place place = place_of(index);
        const bool low = side % 2 == 1;
        if (low ? place[axis] == 0 : place[axis] + 1 == count[axis]) return no_neighbour;
        place[axis] = low ? place[axis] - 1 : place[axis] + 1;
        const std::uint32_t beyond = this->index(place);
        return is_occupied(beyond) ? beyond : no_neighbour;
    }

    /// Calls visit(box, index) for the occupied cells within reach; it returns the new reach.
    template <class Reach, class IsOccupied, class Visit>
    void each_within(Reach reach, const IsOccupied& is_occupied, Visit&& visit) const {
        const auto box_of_block = [&](std::uint32_t level, const Place& place) {
            return box_of(level == 0 ? range_of(place, is_occupied) : blocks_.at(level, place));
        };
        blocks_.traverse(
            reach, box_of_block, [&](const Place& place) { reach.shrink(visit(box_of(place), index(place))); },
            [&](std::uint32_t level, Place& first, Place& end) { narrow(reach, level, first, end); });
    }

    /// Calls visit(box, index) for the occupied cells whose boxes overlap `box`, until it returns false.
    template <class IsOccupied, class Visit>
    void each_overlapping(const Aabb<D>& box, const IsOccupied& is_occupied, Visit&& visit) const {
        const Aabb<D> query = usable(box);
        if (is_empty(query) || !overlaps(query, bounds())) return;
        const CellRange<D> cells(query, cell, blocks_.all().end);
        if (cells.size() > static_cast<double>(max_direct_cells)) {
            constexpr float on = std::numeric_limits<float>::infinity();
            each_within(BoxReach<D>(query, 0), is_occupied,
                        [&](const Aabb<D>& of_cell, std::uint32_t i) { return visit(of_cell, i) ? on : -on; });
            return;
        }
        each_place<D>(glm::max(cells.begin, blocks_.all().first), cells.end, [&](const Place& place) {
            const std::uint32_t i = index(place);
            if (!is_occupied(i)) return true;
            const Aabb<D> of_cell = box_of(place);
            return !overlaps(query, of_cell) || visit(of_cell, i);
        });
    }

private:
    /// Leaves out blocks beside the path of a ray or a moving box, or too far from a box. The coordinates of blocks are
    /// floats, and rounded by less than the padding.
    template <class Reach>
    void narrow(const Reach& reach, std::uint32_t level, Place& first, Place& end) const {
        const double blocks = blocks_.width(level);
        DVec<D> size, low, high;
        for (int axis = 0; axis < D; ++axis) {
            size[axis] = static_cast<double>(cell[axis]) * blocks;
            low[axis] = first[axis] * size[axis];
            high[axis] = end[axis] * size[axis];
        }
        if (!clip(reach, low, high)) return;
        for (int axis = 0; axis < D; ++axis) {
            const double padding = 1e-6 * (1 + end[axis]);
            const double from = low[axis] / size[axis] - padding, to = high[axis] / size[axis] + padding;
            if (from > first[axis]) first[axis] = static_cast<std::uint32_t>(std::min<double>(from, end[axis]));
            if (to < end[axis]) end[axis] = to < first[axis] ? first[axis] : static_cast<std::uint32_t>(to) + 1;
        }
    }

    template <class IsOccupied>
    OccupiedRange<D> range_of(const Place& place, const IsOccupied& is_occupied) const {
        return is_occupied(index(place)) ? OccupiedRange<D>{place, place + 1u} : OccupiedRange<D>();
    }
    Aabb<D> box_of(const OccupiedRange<D>& range) const {
        return range.any() ? box_of(range.first, range.end) : Aabb<D>::empty();
    }

    GridHierarchy<OccupiedRange<D>, D> blocks_;
};

}  // namespace abut::detail
