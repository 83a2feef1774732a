// Rays through a Grid, and what is near: cells layer by layer. No item is told twice, though nothing is marked: it is
// told in the first layer that has a cell of it, and there in the first of these cells.

#include <abut/broad_phase/grid.hpp>
#include <abut/broad_phase/reach.hpp>

#include <cmath>
#include <optional>
#include <utility>

namespace abut {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// Of a coordinate and of where a cell begins, both as large as that, more than all roundings between them.
constexpr double rounding = 1e-5;

/// Where cells begin along an axis.
template <int D>
double border(const GridCells<D>& cells, std::size_t axis, std::uint32_t cell) {
    return static_cast<double>(cells.origin[axis]) +
           cell * (static_cast<double>(GridWords<D>::steps) / static_cast<double>(cells.scale));
}

/// Of all borders of cells, and of another coordinate.
template <int D>
double doubt_of(const GridCells<D>& cells, std::size_t axis, double coordinate) {
    return rounding *
           (std::abs(coordinate) + std::abs(border(cells, axis, 0)) + std::abs(border(cells, axis, cells.count[axis])));
}

/// Visits, in one cell, the items whose first cell among `these` it is, and none that has a cell among `before`.
template <int D, class Visit>
bool each_new_item(const GridCells<D>& cells, const GridStore& store, const std::vector<Aabb<D>>& boxes,
                   const std::array<std::uint32_t, D>& cell, const CellRange<D>& these,
                   const std::optional<CellRange<D>>& before, Visit visit) {
    return store.each_page(cells.index(cell), [&](std::uint32_t first, std::uint32_t count) {
        for (std::uint32_t k = first; k < first + count; ++k) {
            const std::uint32_t item = store.records[k].item;
            const bool go_on = visit(item, [&] {
                const CellRange<D> range = cells.range(boxes[item]);
                return first_cell(these, range) == cell && !(before && overlaps(*before, range));
            });
            if (!go_on) return false;
        }
        return true;
    });
}

/// The cells that a ray may touch, one layer across its main axis after the other.
template <int D>
class RayLayers {
public:
    RayLayers(const GridCells<D>& cells, const Ray<D>& ray) : cells_(cells), origin_(ray.origin), way_(ray.direction) {
        double most = 0;
        for (std::size_t i = 0; i < D; ++i) {
            const double speed = std::abs(way_[static_cast<int>(i)]);
            doubt_[i] = doubt_of(cells, i, origin_[static_cast<int>(i)]);
            if (cells.count[i] == 1 || !(speed > most)) continue;
            most = speed;
            axis_ = i;
            count_ = cells.count[i];
        }
    }

    std::uint32_t count() const { return count_; }

    /// Of layer k on the way, between which distances along the ray it is in there, no less.
    std::pair<double, double> span(std::uint32_t k) const {
        if (count_ == 1) return {0, endless};
        const int axis = static_cast<int>(axis_);
        const std::uint32_t cell = layer(k);
        const double low = cell == 0 ? -endless : border(cells_, axis_, cell) - doubt_[axis_];
        const double high = cell + 1 == count_ ? endless : border(cells_, axis_, cell + 1) + doubt_[axis_];
        const double a = (low - origin_[axis]) / way_[axis], b = (high - origin_[axis]) / way_[axis];
        return {std::max(std::min(a, b), 0.0), std::max(a, b)};
    }

    /// The cells of layer k that the ray may touch between two distances.
    CellRange<D> range(std::uint32_t k, double from, double to) const {
        CellRange<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            if (i == axis_ && count_ > 1) {
                result.low[i] = result.high[i] = layer(k);
                continue;
            }
            const double a = at(i, from), b = at(i, to);
            const auto cell = [&](double x) {
                return cells_.step(static_cast<float>(x), i) >> GridWords<D>::step_bits;
            };
            result.low[i] = cell(std::min(a, b) - doubt_[i]);
            result.high[i] = cell(std::max(a, b) + doubt_[i]);
        }
        return result;
    }

private:
    std::uint32_t layer(std::uint32_t k) const { return way_[static_cast<int>(axis_)] > 0 ? k : count_ - 1 - k; }

    /// Nothing times an endless way is nothing.
    double at(std::size_t axis, double distance) const {
        const int i = static_cast<int>(axis);
        return way_[i] == 0 ? origin_[i] : origin_[i] + way_[i] * distance;
    }

    const GridCells<D>& cells_;
    DVec<D> origin_, way_;
    std::array<double, D> doubt_{};
    std::size_t axis_ = 0;     ///< across which the layers lie
    std::uint32_t count_ = 1;  ///< 1: a layer of all cells
};

/// A range with so many more cells on each side, as far as there are any.
template <int D>
CellRange<D> grown(const GridCells<D>& cells, const CellRange<D>& range, std::uint32_t more) {
    CellRange<D> result;
    for (std::size_t i = 0; i < D; ++i) {
        result.low[i] = range.low[i] - std::min(range.low[i], more);
        result.high[i] = range.high[i] + std::min(cells.count[i] - 1 - range.high[i], more);
    }
    return result;
}

/// Visits the cells of `outer` that aren't in `inner`, which lies in it.
template <int D, class Visit>
bool each_cell_around(const CellRange<D>& inner, const CellRange<D>& outer, Visit visit) {
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

/// No box that touches no cell of the range is nearer to the query. Endless where the range is all there is.
template <int D>
double least_distance_beyond(const GridCells<D>& cells, const CellRange<D>& range, const Aabb<D>& query) {
    double result = endless;
    for (std::size_t i = 0; i < D; ++i) {
        const int axis = static_cast<int>(i);
        const double low = static_cast<double>(query.min[axis]), high = static_cast<double>(query.max[axis]);
        if (range.low[i] > 0) result = std::min(result, low - border(cells, i, range.low[i]) - doubt_of(cells, i, low));
        if (range.high[i] + 1 < cells.count[i])
            result = std::min(result, border(cells, i, range.high[i] + 1) - high - doubt_of(cells, i, high));
    }
    return std::max(result, 0.0);
}

}  // namespace

template <int D>
void Grid<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    RayReach<D> reach(ray);
    double enters = 0;
    const auto tell = [&](std::uint32_t item) {
        reach.shrink(visit(item));
        return !reach.over();
    };
    if (size() == 0 || reach.over()) return;
    for (const std::uint32_t item : large_)
        if (reach.measure(boxes_[item], enters) && !tell(item)) return;
    const RayLayers<D> layers(cells_, ray);
    std::optional<CellRange<D>> before;
    for (std::uint32_t k = 0; k < layers.count(); ++k) {
        const auto [from, to] = layers.span(k);
        if (to < 0) continue;
        if (!reach.within(from)) return;
        const CellRange<D> range = layers.range(k, from, std::min(to, reach.reach()));
        const bool more = each_cell<D>(range, [&](const std::array<std::uint32_t, D>& cell) {
            return each_new_item<D>(cells_, store_, boxes_, cell, range, before, [&](std::uint32_t item, auto is_new) {
                return !reach.measure(boxes_[item], enters) || !is_new() || tell(item);
            });
        });
        if (!more) return;
        before = range;
    }
}

template <int D>
void Grid<D>::visit_near(const Aabb<D>& box, float reach_at_first, ReachCall visit) const {
    BoxReach<D> reach(box, reach_at_first);
    double square = 0;
    const auto tell = [&](std::uint32_t item) {
        reach.shrink(visit(item));
        return !reach.over();
    };
    if (size() == 0 || reach.over()) return;
    for (const std::uint32_t item : large_)
        if (reach.measure(boxes_[item], square) && !tell(item)) return;
    const CellRange<D> own = cells_.range(box);
    std::optional<CellRange<D>> before;
    for (std::uint32_t more = 0;; ++more) {
        const CellRange<D> range = grown(cells_, own, more);
        const auto look = [&](const std::array<std::uint32_t, D>& cell) {
            return each_new_item<D>(cells_, store_, boxes_, cell, range, before, [&](std::uint32_t item, auto is_new) {
                return !reach.measure(boxes_[item], square) || !is_new() || tell(item);
            });
        };
        if (!(before ? each_cell_around<D>(*before, range, look) : each_cell<D>(range, look))) return;
        const double beyond = least_distance_beyond(cells_, range, box);
        if (beyond == endless || !reach.within(beyond * beyond)) return;
        before = range;
    }
}

template void Grid<2>::visit_along(const Ray<2>&, ReachCall) const;
template void Grid<3>::visit_along(const Ray<3>&, ReachCall) const;
template void Grid<2>::visit_near(const Aabb<2>&, float, ReachCall) const;
template void Grid<3>::visit_near(const Aabb<3>&, float, ReachCall) const;

}  // namespace abut
