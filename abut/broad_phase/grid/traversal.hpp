#pragma once

// The cells of a Grid that a ray crosses, and the rings of cells around a box. For .cpp files. All arithmetic is in
// double.

#include <abut/broad_phase/grid/cells.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/simd/square_root.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace abut::detail {

template <int D>
using GridCell = std::array<std::uint32_t, D>;

/// Converts a coordinate for GridCells::step. Clamping doesn't change its result.
inline float to_float(double number) {
    return static_cast<float>(std::clamp(number, -3e38, 3e38));
}

/// The borders between the cells of a grid. Boxes were assigned to cells in float: a coordinate within `tolerance` of a
/// border may be on either side of it.
template <int D>
class GridBorders {
public:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    explicit GridBorders(const GridCells<D>& cells)
        : edge_(static_cast<double>(PackedBounds<D>::steps) / static_cast<double>(cells.scale)) {
        for (std::size_t i = 0; i < D; ++i) {
            last_[i] = cells.count[i] - 1;
            origin_[i] = static_cast<double>(cells.origin[i]);
            max_magnitude_[i] = std::abs(origin_[i]) + std::abs(border(i, cells.count[i]));
        }
    }

    double edge() const { return edge_; }
    double border(std::size_t axis, std::uint32_t cell) const { return origin_[axis] + cell * edge_; }

    /// The bounds of a cell; the cells at the border of the region extend to infinity.
    double low(std::size_t axis, std::uint32_t cell) const { return cell == 0 ? -infinity : border(axis, cell); }
    double high(std::size_t axis, std::uint32_t cell) const {
        return cell == last_[axis] ? infinity : border(axis, cell + 1);
    }
    std::uint32_t last(std::size_t axis) const { return last_[axis]; }

    /// Exceeds the rounding errors of this coordinate, of the borders, and of the quantisation.
    double tolerance(std::size_t axis, double coordinate) const {
        return 1e-5 * (std::abs(coordinate) + max_magnitude_[axis]);
    }

private:
    double edge_;
    std::array<double, D> origin_{}, max_magnitude_{};
    std::array<std::uint32_t, D> last_{};
};

/// The cells that a ray crosses, conservatively. For every box that the ray touches, they include the cell in which the
/// ray enters it.
template <int D>
class RayCells {
public:
    /// An interval of distances along the ray, or of coordinates.
    struct Span {
        double from, to;
    };

    RayCells(const GridCells<D>& cells, const RayReach<D>& reach)
        : cells_(cells),
          borders_(cells),
          origin_(reach.low()),
          direction_(reach.direction()),
          inverse_(reach.inverse()) {
        for (std::size_t i = 0; i < D; ++i) {
            tolerance_[i] = borders_.tolerance(i, origin_[static_cast<int>(i)]);
            std::size_t position = i;
            for (; position > 0 && speed(order_[position - 1]) < speed(i); --position)
                order_[position] = order_[position - 1];
            order_[position] = i;
        }
    }

    const GridBorders<D>& borders() const { return borders_; }
    double origin(std::size_t axis) const { return origin_[static_cast<int>(axis)]; }
    double inverse(std::size_t axis) const { return inverse_[static_cast<int>(axis)]; }
    double tolerance(std::size_t axis) const { return tolerance_[axis]; }
    bool is_ascending(std::size_t axis) const { return direction_[static_cast<int>(axis)] > 0; }
    /// False if the component along the axis is negligible.
    bool moves_along(std::size_t axis) const { return speed(axis) > 1e-6 * speed(order_[0]); }

    /// An interval that contains the coordinates of the ray on that span.
    Span coordinates(std::size_t axis, const Span& span) const {
        const double direction = direction_[static_cast<int>(axis)], start = origin(axis), tolerance = tolerance_[axis];
        // The product below would be NaN for an infinite span.
        if (direction == 0) return {start - tolerance, start + tolerance};
        const double at_from = start + direction * span.from, at_to = start + direction * span.to;
        const double error_from = tolerance + relative_error * std::abs(direction) * span.from;
        const double error_to = tolerance + relative_error * std::abs(direction) * span.to;
        return direction > 0 ? Span{at_from - error_from, at_to + error_to}
                             : Span{at_to - error_to, at_from + error_from};
    }

    /// The cell, among those of a box, in which the ray enters the box at this distance.
    GridCell<D> entry(const CellRange<D>& range, double distance) const {
        GridCell<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const double direction = direction_[static_cast<int>(i)];
            result[i] = std::clamp(cell_at(i, direction == 0 ? origin(i) : origin(i) + direction * distance),
                                   range.low[i], range.high[i]);
        }
        return result;
    }

    /// Calls visit(cell, span) for the cells within reach, front to back, until the visitor returns false. It visits
    /// each cell once; the span contains the interval of the ray in the cell.
    template <class Visit>
    void each(const RayReach<D>& reach, Visit visit) const {
        GridCell<D> cell{};
        traverse(0, cell, {0, reach.reach()}, reach, visit);
    }

private:
    /// Exceeds the relative rounding error of a distance.
    static constexpr double relative_error = 1e-11;

    double speed(std::size_t axis) const { return std::abs(direction_[static_cast<int>(axis)]); }
    std::uint32_t cell_at(std::size_t axis, double coordinate) const {
        return cells_.step(to_float(coordinate), axis) >> PackedBounds<D>::step_bits;
    }

    /// Visits layers across the axis of the largest component, in these rows across the next axis, and so on.
    template <class Visit>
    bool traverse(std::size_t depth, GridCell<D>& cell, const Span& span, const RayReach<D>& reach,
                  Visit& visit) const {
        if (depth == D) return visit(cell, span);
        const std::size_t axis = order_[depth];
        const Span interval = coordinates(axis, span);
        const std::uint32_t low = cell_at(axis, interval.from), high = cell_at(axis, interval.to);
        for (std::uint32_t k = 0; k <= high - low; ++k) {
            cell[axis] = is_ascending(axis) ? low + k : high - k;
            const Span part = low == high ? span : clipped(span, axis, cell[axis]);
            if (!reach.within(part.from)) break;
            if (part.from <= part.to && !traverse(depth + 1, cell, part, reach, visit)) return false;
        }
        return true;
    }

    Span clipped(const Span& span, std::size_t axis, std::uint32_t cell) const {
        if (direction_[static_cast<int>(axis)] == 0) return span;
        const double low = (borders_.low(axis, cell) - tolerance_[axis] - origin(axis)) * inverse(axis);
        const double high = (borders_.high(axis, cell) + tolerance_[axis] - origin(axis)) * inverse(axis);
        const double from = std::min(low, high), to = std::max(low, high);
        return {std::max(span.from, from - relative_error * std::abs(from)),
                std::min(span.to, to + relative_error * std::abs(to))};
    }

    const GridCells<D>& cells_;
    GridBorders<D> borders_;
    DVec<D> origin_, direction_, inverse_;
    std::array<double, D> tolerance_{};
    std::array<std::size_t, D> order_{};  ///< the axes, by descending component of the direction
};

/// The rings of cells around a box, from the inside out.
template <int D>
class BoxCells {
public:
    BoxCells(const GridCells<D>& cells, const Aabb<D>& box)
        : cells_(cells), borders_(cells), box_(box), own_(cells.range(box)) {
        for (std::size_t i = 0; i < D; ++i)
            tolerance_[i] = std::max(borders_.tolerance(i, low(i)), borders_.tolerance(i, high(i)));
    }

    const GridBorders<D>& borders() const { return borders_; }
    double low(std::size_t axis) const { return static_cast<double>(box_.min[static_cast<int>(axis)]); }
    double high(std::size_t axis) const { return static_cast<double>(box_.max[static_cast<int>(axis)]); }
    double tolerance(std::size_t axis) const { return tolerance_[axis]; }

    /// The nearest cell among those of another box; a unique choice among equals.
    GridCell<D> nearest(const CellRange<D>& range) const {
        GridCell<D> result;
        for (std::size_t i = 0; i < D; ++i) result[i] = std::clamp(own_.low[i], range.low[i], range.high[i]);
        return result;
    }

    /// Calls visit(cell) once for each cell within reach, until the visitor returns false.
    template <class Visit>
    void each(const BoxReach<D>& reach, Visit visit) const {
        const auto visit_cell = [&](const GridCell<D>& cell) {
            return !reach.within(squared_distance(cell)) || visit(cell);
        };
        if (!each_cell<D>(own_, visit_cell)) return;
        for (std::uint32_t ring = 1;; ++ring) {
            const CellRange<D> limit = cells_within(reach);
            const CellRange<D> inner = expanded(limit, ring - 1), outer = expanded(limit, ring);
            if (inner == limit || !each_cell_around(inner, outer, visit_cell)) return;
        }
    }

private:
    double squared_distance(const GridCell<D>& cell) const {
        double result = 0;
        for (std::size_t i = 0; i < D; ++i) {
            // The comparison comes before the subtraction, for both may be infinite.
            const double begin = borders_.low(i, cell[i]), end = borders_.high(i, cell[i]);
            double gap = 0;
            if (begin > high(i)) gap = begin - high(i) - tolerance_[i];
            if (end < low(i)) gap = low(i) - end - tolerance_[i];
            if (gap > 0) result += gap * gap;
        }
        return result;
    }

    CellRange<D> cells_within(const BoxReach<D>& reach) const {
        const double distance = square_root(reach.max_measure());
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const double margin = distance + tolerance_[i] + 1e-6 * distance;
            result.low[i] =
                std::min(own_.low[i], cells_.step(to_float(low(i) - margin), i) >> PackedBounds<D>::step_bits);
            result.high[i] =
                std::max(own_.high[i], cells_.step(to_float(high(i) + margin), i) >> PackedBounds<D>::step_bits);
        }
        return result;
    }

    /// The box's own cells, expanded by so many cells on each side, but not beyond `limit`.
    CellRange<D> expanded(const CellRange<D>& limit, std::uint32_t count) const {
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            result.low[i] = own_.low[i] - std::min(own_.low[i] - limit.low[i], count);
            result.high[i] = own_.high[i] + std::min(limit.high[i] - own_.high[i], count);
        }
        return result;
    }

    /// Visits the cells of `outer` that aren't in `inner`. `outer` contains `inner`.
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
    std::array<double, D> tolerance_{};
};

}  // namespace abut::detail
