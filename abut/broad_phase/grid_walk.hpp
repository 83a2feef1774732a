#pragma once

// Which cells of a Grid a ray crosses, and which lie around a box. For .cpp files: all in double.

#include <abut/broad_phase/grid_cells.hpp>
#include <abut/broad_phase/reach.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut {

template <int D>
using GridCell = std::array<std::uint32_t, D>;

/// A coordinate for GridCells::step, which takes all that lie so far out alike.
inline float to_float(double number) {
    return static_cast<float>(std::clamp(number, -3e38, 3e38));
}

/// Where the cells of a grid begin and end. A box was put into its cells by floats; what lies within `doubt` of a
/// border may be on either side of it.
template <int D>
class GridBorders {
public:
    static constexpr double endless = std::numeric_limits<double>::infinity();

    explicit GridBorders(const GridCells<D>& cells)
        : edge_(static_cast<double>(GridWords<D>::steps) / static_cast<double>(cells.scale)) {
        for (std::size_t i = 0; i < D; ++i) {
            last_[i] = cells.count[i] - 1;
            origin_[i] = static_cast<double>(cells.origin[i]);
            most_[i] = std::abs(origin_[i]) + std::abs(border(i, cells.count[i]));
        }
    }

    double edge() const { return edge_; }
    double border(std::size_t axis, std::uint32_t cell) const { return origin_[axis] + cell * edge_; }

    /// Of a cell: those at the border of the block have no end there.
    double low(std::size_t axis, std::uint32_t cell) const { return cell == 0 ? -endless : border(axis, cell); }
    double high(std::size_t axis, std::uint32_t cell) const {
        return cell == last_[axis] ? endless : border(axis, cell + 1);
    }
    std::uint32_t last(std::size_t axis) const { return last_[axis]; }

    /// More than all roundings of this coordinate, of the borders, and of the steps between them.
    double doubt(std::size_t axis, double coordinate) const { return 1e-5 * (std::abs(coordinate) + most_[axis]); }

private:
    double edge_;
    std::array<double, D> origin_{}, most_{};
    std::array<std::uint32_t, D> last_{};
};

/// The cells that a ray crosses, with a little more than those: whatever a ray touches, the cell where it comes in is
/// among them.
template <int D>
class RayCells {
public:
    /// Between two distances along the ray.
    struct Span {
        double from, to;
    };

    RayCells(const GridCells<D>& cells, const RayReach<D>& reach)
        : cells_(cells), borders_(cells), origin_(reach.low()), way_(reach.direction()), inverse_(reach.inverse()) {
        for (std::size_t i = 0; i < D; ++i) {
            doubt_[i] = borders_.doubt(i, origin_[static_cast<int>(i)]);
            std::size_t place = i;
            for (; place > 0 && speed(order_[place - 1]) < speed(i); --place) order_[place] = order_[place - 1];
            order_[place] = i;
        }
    }

    const GridBorders<D>& borders() const { return borders_; }
    double origin(std::size_t axis) const { return origin_[static_cast<int>(axis)]; }
    double inverse(std::size_t axis) const { return inverse_[static_cast<int>(axis)]; }
    double doubt(std::size_t axis) const { return doubt_[axis]; }
    bool goes_up(std::size_t axis) const { return way_[static_cast<int>(axis)] > 0; }
    /// Not so slow that it stays where it is.
    bool moves_along(std::size_t axis) const { return speed(axis) > 1e-6 * speed(order_[0]); }

    /// Between which coordinates the ray is on that span, no less.
    Span coordinates(std::size_t axis, const Span& span) const {
        const double way = way_[static_cast<int>(axis)], start = origin(axis), doubt = doubt_[axis];
        // Nothing times an endless way is nothing.
        if (way == 0) return {start - doubt, start + doubt};
        const double at_from = start + way * span.from, at_to = start + way * span.to;
        const double blur_from = doubt + blur * std::abs(way) * span.from;
        const double blur_to = doubt + blur * std::abs(way) * span.to;
        return way > 0 ? Span{at_from - blur_from, at_to + blur_to} : Span{at_to - blur_to, at_from + blur_from};
    }

    /// Of the cells of a box that the ray touches, the one where it comes in.
    GridCell<D> entry(const CellRange<D>& range, double distance) const {
        GridCell<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const double way = way_[static_cast<int>(i)];
            result[i] =
                std::clamp(cell_at(i, way == 0 ? origin(i) : origin(i) + way * distance), range.low[i], range.high[i]);
        }
        return result;
    }

    /// Calls visit(cell, span) for the cells within reach, those in front first, until one says false: each cell once,
    /// and at least for the span that the ray is in it.
    template <class Visit>
    void each(const RayReach<D>& reach, Visit visit) const {
        GridCell<D> cell{};
        walk(0, cell, {0, reach.reach()}, reach, visit);
    }

private:
    /// More than the roundings of a distance, as a part of it.
    static constexpr double blur = 1e-11;

    double speed(std::size_t axis) const { return std::abs(way_[static_cast<int>(axis)]); }
    std::uint32_t cell_at(std::size_t axis, double coordinate) const {
        return cells_.step(to_float(coordinate), axis) >> GridWords<D>::step_bits;
    }

    /// Layers across the axis along which it is fastest, in these the rows across the next, and so on.
    template <class Visit>
    bool walk(std::size_t depth, GridCell<D>& cell, const Span& span, const RayReach<D>& reach, Visit& visit) const {
        if (depth == D) return visit(cell, span);
        const std::size_t axis = order_[depth];
        const Span place = coordinates(axis, span);
        const std::uint32_t low = cell_at(axis, place.from), high = cell_at(axis, place.to);
        for (std::uint32_t k = 0; k <= high - low; ++k) {
            cell[axis] = goes_up(axis) ? low + k : high - k;
            const Span part = low == high ? span : clipped(span, axis, cell[axis]);
            if (!reach.within(part.from)) break;
            if (part.from <= part.to && !walk(depth + 1, cell, part, reach, visit)) return false;
        }
        return true;
    }

    Span clipped(const Span& span, std::size_t axis, std::uint32_t cell) const {
        if (way_[static_cast<int>(axis)] == 0) return span;
        const double low = (borders_.low(axis, cell) - doubt_[axis] - origin(axis)) * inverse(axis);
        const double high = (borders_.high(axis, cell) + doubt_[axis] - origin(axis)) * inverse(axis);
        const double from = std::min(low, high), to = std::max(low, high);
        return {std::max(span.from, from - blur * std::abs(from)), std::min(span.to, to + blur * std::abs(to))};
    }

    const GridCells<D>& cells_;
    GridBorders<D> borders_;
    DVec<D> origin_, way_, inverse_;
    std::array<double, D> doubt_{};
    std::array<std::size_t, D> order_{};  ///< axes, the fastest first
};

/// The cells around a box, ring by ring outwards.
template <int D>
class BoxCells {
public:
    BoxCells(const GridCells<D>& cells, const Aabb<D>& box)
        : cells_(cells), borders_(cells), box_(box), own_(cells.range(box)) {
        for (std::size_t i = 0; i < D; ++i) doubt_[i] = std::max(borders_.doubt(i, low(i)), borders_.doubt(i, high(i)));
    }

    const GridBorders<D>& borders() const { return borders_; }
    double low(std::size_t axis) const { return static_cast<double>(box_.min[static_cast<int>(axis)]); }
    double high(std::size_t axis) const { return static_cast<double>(box_.max[static_cast<int>(axis)]); }
    double doubt(std::size_t axis) const { return doubt_[axis]; }

    /// Of the cells of another box, one that is nearest.
    GridCell<D> nearest(const CellRange<D>& range) const {
        GridCell<D> result;
        for (std::size_t i = 0; i < D; ++i) result[i] = std::clamp(own_.low[i], range.low[i], range.high[i]);
        return result;
    }

    /// Calls visit(cell) for the cells that have something within reach, until one says false. Each cell once.
    template <class Visit>
    void each(const BoxReach<D>& reach, Visit visit) const {
        const auto look = [&](const GridCell<D>& cell) { return !reach.within(squared_distance(cell)) || visit(cell); };
        if (!each_cell<D>(own_, look)) return;
        for (std::uint32_t ring = 1;; ++ring) {
            const CellRange<D> within = cells_within(reach);
            const CellRange<D> inner = grown(within, ring - 1), outer = grown(within, ring);
            if (inner == within || !each_cell_around(inner, outer, look)) return;
        }
    }

private:
    double squared_distance(const GridCell<D>& cell) const {
        double result = 0;
        for (std::size_t i = 0; i < D; ++i) {
            // Compared before they are subtracted: both may be infinite.
            const double begin = borders_.low(i, cell[i]), end = borders_.high(i, cell[i]);
            double gap = 0;
            if (begin > high(i)) gap = begin - high(i) - doubt_[i];
            if (end < low(i)) gap = low(i) - end - doubt_[i];
            if (gap > 0) result += gap * gap;
        }
        return result;
    }

    CellRange<D> cells_within(const BoxReach<D>& reach) const {
        const double far = std::sqrt(reach.most());
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const double more = far + doubt_[i] + 1e-6 * far;
            result.low[i] = std::min(own_.low[i], cells_.step(to_float(low(i) - more), i) >> GridWords<D>::step_bits);
            result.high[i] =
                std::max(own_.high[i], cells_.step(to_float(high(i) + more), i) >> GridWords<D>::step_bits);
        }
        return result;
    }

    /// The box's own cells with so many more on each side, as far as there are any within these.
    CellRange<D> grown(const CellRange<D>& within, std::uint32_t more) const {
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = own_.low[i] - std::min(own_.low[i] - within.low[i], more);
            result.high[i] = own_.high[i] + std::min(within.high[i] - own_.high[i], more);
        }
        return result;
    }

    /// Visits the cells of `outer` that aren't in `inner`, which lies in it.
    template <class Visit>
    static bool each_cell_around(const CellRange<D>& inner, const CellRange<D>& outer, Visit visit) {
        CellRange<D> part = outer;
        for (std::size_t axis = D; axis-- > 0;) {
            if (outer.low[axis] < inner.low[axis]) {
                part.high[axis] = inner.low[axis] - 1;
                if (!each_cell<D>(part, visit)) return false;
                part.high[axis] = outer.high[axis];
            }
            if (outer.high[axis] > inner.high[axis]) {
                part.low[axis] = inner.high[axis] + 1;
                if (!each_cell<D>(part, visit)) return false;
            }
            part.low[axis] = inner.low[axis];
            part.high[axis] = inner.high[axis];
        }
        return true;
    }

    const GridCells<D>& cells_;
    GridBorders<D> borders_;
    Aabb<D> box_;
    CellRange<D> own_;
    std::array<double, D> doubt_{};
};

}  // namespace abut
