#pragma once

// The pieces without kinks of a field's distance, as it is continued outside of the volume: the cells, and the columns
// that continue the cells at the border. For .cpp files.

#include <abut/field/cells.hpp>
#include <abut/field/field_extended.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace abut::detail {

/// The way from the box around the surface to a point; false where there is no surface.
template <int D>
bool way_from_surface(const FieldData<D>& data, const DVec<D>& point, DVec<D>& way) {
    for (int a = 0; a < D; ++a) {
        const auto low = static_cast<double>(data.surface.min[a]), high = static_cast<double>(data.surface.max[a]);
        if (!(low <= high)) return false;
        way[a] = point[a] - std::clamp(point[a], low, high);
    }
    return true;
}

/// The values of a cell at the corners of a box in cells; beyond the volume, of the nearest points of the volume.
template <int D>
std::array<double, cell_corners<D>> values_at_corners(const FieldData<D>& data, const CellValues<D>& values,
                                                      const DVec<D>& low, const DVec<D>& high) {
    std::array<double, cell_corners<D>> result = values.values;
    for (int a = 0; a < D; ++a) {
        const auto cells = static_cast<double>(data.cells[a]);
        const double from = (std::clamp(low[a], 0.0, cells) - values.low[a]) / values.side,
                     until = (std::clamp(high[a], 0.0, cells) - values.low[a]) / values.side;
        const std::size_t bit = std::size_t{1} << a;
        for (std::size_t i = 0; i < cell_corners<D>; ++i) {
            if ((i & bit) != 0) continue;
            const double before = result[i], rise = result[i | bit] - before;
            result[i] = before + from * rise;
            result[i | bit] = before + until * rise;
        }
    }
    return result;
}

/// Outside, F(y, d) = sqrt(|y|^2 + max(d, 0)^2) is convex, and grows with d: its tangent plane at the anchor is nowhere
/// above it. Neither is that of the distance to the box around the surface. Replaces the values of the nearest points
/// by those of the plane. False if all is solid.
template <int D>
bool continue_corners(const FieldData<D>& data, const CellValues<D>& values, const DVec<D>& low, const DVec<D>& high,
                      DistanceBound<D>& bound) {
    const auto side = static_cast<double>(data.cell);
    DVec<D> near, away(0.0), anchor;
    const DVec<D> place = in_cells(data, bound.anchor);
    for (int a = 0; a < D; ++a) {
        const auto cells = static_cast<double>(data.cells[a]);
        const double at = std::clamp(place[a], low[a], high[a]);
        near[a] = std::clamp(at, 0.0, cells);
        away[a] = (at - near[a]) * side;
        anchor[a] = static_cast<double>(data.origin[a]) + side * at;
    }
    const double there = values.at(near), beyond = std::max(there, 0.0);
    bool is_solid = there < 0;
    for (const double value : bound.corners) is_solid = is_solid || value < 0;
    if (is_solid && holds_surface(data)) return false;
    const double here = square_root(length_squared(away) + beyond * beyond);
    DVec<D> from_surface(0.0);
    const double to_surface = way_from_surface(data, anchor, from_surface) ? length(from_surface) : 0;
    const bool is_far = to_surface > here;
    const double steep = is_far || !(here > 0) ? 0 : beyond / here;
    DVec<D> rise(0.0);
    if (is_far)
        rise = from_surface / to_surface;
    else if (here > 0)
        rise = away / here;
    const double constant = is_far ? to_surface : here - steep * there;
    for (std::size_t i = 0; i < cell_corners<D>; ++i) {
        double value = constant + steep * bound.corners[i];
        for (int a = 0; a < D; ++a)
            if (rise[a] != 0) {
                const double own = static_cast<double>(data.origin[a]) + side * (i >> a & 1 ? high[a] : low[a]);
                value += rise[a] * (own - anchor[a]);
            }
        bound.corners[i] = value;
    }
    // How far the tangent plane falls below.
    const double curved = 0.5 / std::max(is_far ? to_surface : here, side);
    for (int a = 0; a < D; ++a) {
        const double aside = std::max(std::abs(side * low[a] + static_cast<double>(data.origin[a]) - anchor[a]),
                                      std::abs(side * high[a] + static_cast<double>(data.origin[a]) - anchor[a]));
        bound.curvature[a] += curved * (1 - rise[a] * rise[a]) * aside * aside;
    }
    return true;
}

/// Bounds a box of a single piece, in cells, by the values at its corners. False if it is solid and outside.
template <int D>
bool piece_corners(const FieldData<D>& data, const CellValues<D>& values, const DVec<D>& low, const DVec<D>& high,
                   bool is_outside, DistanceBound<D>& bound) {
    bound.corners = values_at_corners(data, values, low, high);
    if (is_outside && !continue_corners(data, values, low, high, bound)) return false;
    bound.is_smooth = true;
    bound.lower_bound = *std::min_element(bound.corners.begin(), bound.corners.end());
    return true;
}

/// Divides a box, in cells, into its pieces, and visits those that may matter to `wanted`. False if they are too many,
/// or in several bricks, or only one.
template <int D>
bool each_smooth_piece(const FieldData<D>& data, const DVec<D>& low, const DVec<D>& high,
                       const DistanceBound<D>& wanted) {
    constexpr int max_pieces = DistanceBound<D>::max_pieces;
    // Limited before it is rounded: a shape may be 1e21 cells wide.
    const auto cell_at = [&](double place, int a) {
        return static_cast<std::int32_t>(std::min(std::max(0.0, place), static_cast<double>(last_cell(data, a))));
    };
    Cell<D> first, last;
    for (int a = 0; a < D; ++a) {
        first[a] = cell_at(low[a], a);
        last[a] = std::max(cell_at(std::ceil(high[a]) - 1, a), first[a]);
        if (last[a] - first[a] >= max_pieces) return false;
        constexpr auto brick = static_cast<std::int32_t>(brick_cells<D>);
        if (data.store != FieldStore::dense && first[a] / brick != last[a] / brick) return false;
    }
    const SampleGrid<D> grid = grid_of(data, first);
    std::array<std::array<double, max_pieces + 3>, static_cast<std::size_t>(D)> sides;
    Cell<D> count(0);
    std::int32_t pieces = 1;
    for (int a = 0; a < D; ++a) {
        auto& side = sides[static_cast<std::size_t>(a)];
        std::size_t n = 0;
        side[0] = low[a];
        const auto add = [&](double at) {
            if (at > side[n] && at < high[a]) side[++n] = at;
        };
        add(0);
        if (!grid.coarse)
            for (std::int32_t cell = first[a] + 1; cell <= last[a]; ++cell) add(cell);
        add(static_cast<double>(data.cells[a]));
        side[++n] = high[a];
        count[a] = static_cast<std::int32_t>(n);
        pieces *= count[a];
        if (pieces > max_pieces) return false;
    }
    if (pieces == 1) return false;
    const auto cell_side = static_cast<double>(data.cell);
    const auto at_place = [&](const DVec<D>& place) { return DVec<D>(data.origin) + place * cell_side; };
    // The heights of the corners of a cell over the requested plane, from its lowest corner.
    std::array<double, cell_corners<D>> plane{};
    for (std::size_t i = 0; i < plane.size(); ++i)
        for (int a = 0; a < D; ++a)
            if ((i >> a & 1) != 0) plane[i] += wanted.requested_gradient[a] * cell_side * grid.side;
    Cell<D> index(0);
    do {
        DVec<D> from, until;
        Cell<D> cell;
        bool is_outside = false;
        for (int a = 0; a < D; ++a) {
            const auto& side = sides[static_cast<std::size_t>(a)];
            from[a] = side[static_cast<std::size_t>(index[a])];
            until[a] = side[static_cast<std::size_t>(index[a]) + 1];
            is_outside = is_outside || from[a] < 0 || until[a] > static_cast<double>(data.cells[a]);
            cell[a] = cell_at(from[a], a);
        }
        const CellValues<D> values = values_in(data, grid, cell);
        double lowest = std::numeric_limits<double>::infinity(), above = lowest;
        for (std::size_t i = 0; i < plane.size(); ++i) {
            lowest = std::min(lowest, values.values[i]);
            above = std::min(above, values.values[i] - plane[i]);
        }
        const double limit = wanted.sufficient;
        const double in_set = wanted.requested_support - dot(wanted.requested_gradient, at_place(values.low));
        if (!is_outside && (lowest > limit || above + in_set > limit)) continue;
        DistanceBound<D> piece;
        piece.anchor = wanted.anchor;
        if (piece_corners(data, values, from, until, is_outside, piece) && piece.lower_bound > limit) continue;
        (*wanted.visit_piece)(at_place(from), at_place(until), piece);
    } while (next_cell(index, Cell<D>(0), count - 1));
    return true;
}

}  // namespace abut::detail
