#include <abut/field/cells.hpp>
#include <abut/field/field_extended.hpp>
#include <abut/field/smooth_pieces.hpp>
#include <abut/math/simd/square_root.hpp>

#include <limits>

namespace abut::detail {
namespace {

/// A box with more samples is to be cut first.
constexpr std::int64_t most_samples = 1500;
/// A box with no more is bounded by them at once, without a first bound by the slope.
constexpr std::int64_t few_samples = 64;

/// A box is cut at the border of the volume before it is cut between cells.
constexpr double border_first = 1e6;

/// The distance, and where wanted its gradient.
template <int D>
double distance_and(const FieldData<D>& data, const DVec<D>& point, DVec<D>* gradient) {
    const auto cell = static_cast<double>(data.cell);
    const DVec<D> place = in_cells(data, point);
    DVec<D> near, away;
    bool is_within = true;
    for (int a = 0; a < D; ++a) {
        near[a] = std::clamp(place[a], 0.0, static_cast<double>(data.cells[a]));
        away[a] = (place[a] - near[a]) * cell;
        is_within = is_within && away[a] == 0;
    }
    const CellValues<D> values = values_around(data, near);
    const double there = values.at(near);
    if (gradient != nullptr) *gradient = values.gradient(near) / cell;
    if (is_within) return there;
    // Solid as far as is known; else the volume cuts the solid, which ends with it.
    const bool is_solid = there < 0 && holds_surface(data);
    const double sign = is_solid ? -1 : 1, beyond = std::max(sign * there, 0.0);
    double result = square_root(length_squared(away) + beyond * beyond);
    if (gradient != nullptr)
        for (int a = 0; a < D; ++a)
            (*gradient)[a] = away[a] != 0 ? away[a] / result : sign * (*gradient)[a] * (beyond / result);
    DVec<D> from_surface(0.0);
    if (way_from_surface(data, point, from_surface)) {
        const double to_surface = length(from_surface);
        if (to_surface > result) {
            result = to_surface;
            if (gradient != nullptr) *gradient = from_surface / to_surface;
        }
    }
    if (gradient != nullptr) *gradient *= sign;
    return result * sign;
}

/// The least of a linear function with this gradient, in a box about the origin.
template <int D>
double least_in_box(const DVec<D>& gradient, const DVec<D>& half) {
    double result = 0;
    for (int a = 0; a < D; ++a) result -= std::abs(gradient[a]) * half[a];
    return result;
}

/// What samples are above two planes through a point, and above nothing.
template <int D>
struct AbovePlanes {
    DVec<D> center, own, wanted;  ///< the point and both gradients, in cells
    double least = std::numeric_limits<double>::infinity(), above_own = least, above_wanted = least;

    void add(double value, const DVec<D>& place) {
        const DVec<D> way = place - center;
        least = std::min(least, value);
        above_own = std::min(above_own, value - dot(own, way));
        above_wanted = std::min(above_wanted, value - dot(wanted, way));
    }
};

template <int D>
class BoundInBox {
public:
    BoundInBox(const FieldData<D>& data, const DVec<D>& low, const DVec<D>& high)
        : data_(data),
          cell_(static_cast<double>(data.cell)),
          low_(in_cells(data, low)),
          high_(in_cells(data, high)),
          center_((low + high) * 0.5),
          half_((high - low) * 0.5) {}

    DistanceBoundStatus run(DistanceBound<D>& bound) {
        if (find_piece(bound)) return DistanceBoundStatus::valid;
        if (bound.visit_piece != nullptr && each_smooth_piece(data_, low_, high_, bound))
            return DistanceBoundStatus::divided;
        if (bound.only_cut && bound.cut_axis >= 0) return DistanceBoundStatus::box_too_large;
        bool is_within = true, is_beyond = false;
        std::int64_t samples = 1;
        DVec<D> first, last;
        for (int a = 0; a < D; ++a) {
            const auto cells = static_cast<double>(data_.cells[a]);
            is_within = is_within && low_[a] >= 0 && high_[a] <= cells;
            is_beyond = is_beyond || low_[a] >= cells || high_[a] <= 0;
            first[a] = std::clamp(low_[a], 0.0, cells);
            last[a] = std::clamp(high_[a], 0.0, cells);
            samples *= static_cast<std::int64_t>(std::ceil(last[a]) - std::floor(first[a])) + 1;
        }
        if ((bound.needs_gradient || samples > few_samples) && (is_within || is_beyond || holds_surface(data_))) {
            const double here = distance_at(center_);
            // Between finer and coarser samples there may be a step, of less than a cell.
            const double step = data_.store == FieldStore::dense ? 0 : cell_;
            bound.lower_bound = here - static_cast<double>(extended_slope(data_)) * length(half_) - step;
            if (bound.lower_bound > bound.sufficient) {
                bound.value = bound.lower_bound;
                bound.gradient = DVec<D>(0.0);
                bound.requested_value = bound.lower_bound + least_in_box(bound.requested_gradient, half_);
                return DistanceBoundStatus::valid;
            }
        }
        if (samples > most_samples) return DistanceBoundStatus::box_too_large;
        wanted_ = bound.requested_gradient;
        needs_gradient_ = bound.needs_gradient;
        if (needs_gradient_)
            find_gradient();
        else
            own_ = wanted_;
        if (is_within) {
            const AbovePlanes<D> above = above_samples(low_, high_, in_cells(data_, center_), own_, wanted_);
            least_ = above.least;
            above_own_ = above.above_own;
            above_wanted_ = above.above_wanted;
        } else {
            look_at_regions(low_, high_, 0, false);
        }
        bound.value = above_own_;
        bound.gradient = own_;
        bound.requested_value = above_wanted_;
        bound.lower_bound = std::max(bound.lower_bound, least_);
        return DistanceBoundStatus::valid;
    }

private:
    /// Cells of the volume as integers, in spite of rounding.
    static double snapped(double place) {
        const double nearest = std::floor(place + 0.5);
        return std::abs(place - nearest) <= 1e-9 ? nearest : place;
    }

    /// Whether the box is in one cell, or beside one outside of the volume; else where it is best cut.
    bool find_piece(DistanceBound<D>& bound) {
        DVec<D> low, high;
        Cell<D> cell;
        std::array<bool, static_cast<std::size_t>(D)> is_out{};
        bool is_outside = false;
        double widest = 0;
        const DVec<D> place = in_cells(data_, bound.anchor);
        const auto cut_at = [&](int a, double at, double wide) {
            if (!(wide > widest)) return;
            widest = wide;
            bound.cut_axis = a;
            bound.cut = static_cast<double>(data_.origin[a]) + cell_ * at;
        };
        for (int a = 0; a < D; ++a) {
            low[a] = snapped(low_[a]);
            high[a] = snapped(high_[a]);
            const auto cells = static_cast<double>(data_.cells[a]);
            if (low[a] < 0 && high[a] > 0) cut_at(a, 0, border_first * (high[a] - low[a]));
            if (low[a] < cells && high[a] > cells) cut_at(a, cells, border_first * (high[a] - low[a]));
            is_out[static_cast<std::size_t>(a)] = low[a] < 0 || high[a] > cells;
            is_outside = is_outside || is_out[static_cast<std::size_t>(a)];
            const double near = std::clamp(low[a], 0.0, cells);
            cell[a] = std::min(static_cast<std::int32_t>(near), last_cell(data_, a));
        }
        const bool has_bricks = data_.store != FieldStore::dense;
        const auto cut_across = [&](double side) {
            for (int a = 0; a < D; ++a) {
                if (is_out[static_cast<std::size_t>(a)]) continue;
                const double from = std::floor(low[a] / side) * side;
                if (high[a] <= from + side) continue;
                const double middle = 0.5 * (low[a] + high[a]), before = std::floor(place[a] / side) * side;
                double best = std::floor(middle / side + 0.5) * side;
                if (!(best > low[a] && best < high[a])) best = from + side;
                if (before > low[a] && before < high[a]) best = before;
                if (before + side > low[a] && before + side < high[a] &&
                    (!(before > low[a]) || std::abs(before + side - middle) < std::abs(before - middle)))
                    best = before + side;
                cut_at(a, best, high[a] - low[a]);
            }
        };
        if (has_bricks) cut_across(static_cast<double>(brick_cells<D>));
        if (widest > 0) return false;
        const SampleGrid<D> grid = grid_of(data_, cell);
        if (!grid.coarse) cut_across(1);
        if (widest > 0) return false;
        const CellValues<D> values = values_in(data_, grid, cell);
        if (!piece_corners(data_, values, low_, high_, is_outside, bound)) return false;
        finish_corners(bound);
        return true;
    }

    /// What is linear along each axis is least over any plane at a corner.
    void finish_corners(DistanceBound<D>& bound) const {
        const DVec<D>& half = half_;
        const auto& corners = bound.corners;
        if (!bound.needs_gradient) return;
        for (int a = 0; a < D; ++a) {
            const std::size_t bit = std::size_t{1} << a;
            double rise = 0;
            for (std::size_t i = 0; i < cell_corners<D>; ++i) rise += (i & bit) != 0 ? corners[i] : -corners[i];
            bound.gradient[a] = half[a] > 0 ? rise / (static_cast<double>(cell_corners<D>) * half[a]) : 0;
        }
        bound.value = bound.requested_value = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < cell_corners<D>; ++i) {
            double own = corners[i], wanted = own;
            for (int a = 0; a < D; ++a) {
                const double way = i >> a & 1 ? half[a] : -half[a];
                own -= bound.gradient[a] * way;
                wanted -= bound.requested_gradient[a] * way;
            }
            bound.value = std::min(bound.value, own);
            bound.requested_value = std::min(bound.requested_value, wanted);
        }
    }

    double distance_at(const DVec<D>& point) const { return distance_and<D>(data_, point, nullptr); }

    /// From side to side of the box.
    void find_gradient() {
        for (int a = 0; a < D; ++a) {
            const double reach = std::max(half_[a], 0.05 * cell_);
            const DVec<D> aside = axis<D>(a, reach);
            const double after = distance_at(center_ + aside), before = distance_at(center_ - aside);
            own_[a] = (after - before) / (2 * reach);
        }
    }

    /// Cuts the box where the volume ends, axis by axis.
    void look_at_regions(const DVec<D>& low, const DVec<D>& high, int a, bool is_outside) {
        if (a == D) {
            if (is_outside) return look_outside(low, high);
            const AbovePlanes<D> above = above_samples(low, high, in_cells(data_, center_), own_, wanted_);
            return keep(above.least, above.above_own, above.above_wanted);
        }
        const auto cells = static_cast<double>(data_.cells[a]);
        const auto look_at = [&](double from, double until, bool is_out) {
            DVec<D> region_low = low, region_high = high;
            region_low[a] = from;
            region_high[a] = until;
            look_at_regions(region_low, region_high, a + 1, is_outside || is_out);
        };
        if (low[a] < 0) look_at(low[a], std::min(high[a], 0.0), true);
        if (low[a] <= cells && high[a] >= 0) look_at(std::max(low[a], 0.0), std::min(high[a], cells), false);
        if (high[a] > cells) look_at(std::max(low[a], cells), high[a], true);
    }

    void keep(double least, double above_own, double above_wanted) {
        least_ = std::min(least_, least);
        above_own_ = std::min(above_own_, above_own);
        above_wanted_ = std::min(above_wanted_, above_wanted);
    }

    /// A region that is outside along some of the axes, and within along the others.
    void look_outside(const DVec<D>& low, const DVec<D>& high) {
        DVec<D> center, half, near_low, near_high;
        std::array<bool, static_cast<std::size_t>(D)> is_out;
        const auto out_along = [&](int a) { return is_out[static_cast<std::size_t>(a)]; };
        for (int a = 0; a < D; ++a) {
            center[a] = static_cast<double>(data_.origin[a]) + cell_ * 0.5 * (low[a] + high[a]);
            half[a] = cell_ * 0.5 * (high[a] - low[a]);
            const auto cells = static_cast<double>(data_.cells[a]);
            near_low[a] = std::clamp(low[a], 0.0, cells);
            near_high[a] = std::clamp(high[a], 0.0, cells);
            is_out[static_cast<std::size_t>(a)] = high[a] <= 0 ? low[a] < 0 : low[a] >= cells && high[a] > cells;
        }
        const double here = distance_at(center);
        if (here < 0) {
            // Solid all around: by the slope alone.
            const double least = here - static_cast<double>(extended_slope(data_)) * length(half);
            keep(least, at_middle(least, own_, center, half), at_middle(least, wanted_, center, half));
            return;
        }
        // sqrt(x^2 + y^2) >= c x + s y, with c^2 + s^2 = 1 so that both are the same in the middle of the region.
        DVec<D> away(0.0), near = (near_low + near_high) * 0.5;
        double nearest = 0;
        for (int a = 0; a < D; ++a) {
            if (!out_along(a)) continue;
            away[a] = center[a] - (static_cast<double>(data_.origin[a]) + cell_ * near[a]);
            nearest += (std::abs(away[a]) - half[a]) * (std::abs(away[a]) - half[a]);
        }
        const double far = length(away), at_near = std::max(values_around(data_, near).at(near), 0.0);
        const double both = square_root(far * far + at_near * at_near);
        const double c = both > 0 ? far / both : 1, s = both > 0 && at_near > 1e-3 * both ? at_near / both : 0;
        const DVec<D> out = far > 0 ? away / far : DVec<D>(0.0);
        // Along the border what is wanted of the whole is wanted of the distances there.
        const auto along_border = [&](const DVec<D>& gradient) {
            DVec<D> result(0.0);
            for (int a = 0; a < D; ++a)
                if (!out_along(a) && s > 0) result[a] = gradient[a] / s;
            return result;
        };
        const AbovePlanes<D> border =
            above_samples(near_low, near_high, near, along_border(own_), along_border(wanted_));
        const double at_least = std::max(border.least, 0.0);
        double least = square_root(nearest + at_least * at_least);
        DVec<D> from_surface(0.0);
        const bool has_surface = way_from_surface(data_, center, from_surface);
        const double to_surface = has_surface ? length(from_surface) : 0;
        if (has_surface) least = std::max(least, distance_of_surface(low, high));
        const auto above = [&](const DVec<D>& gradient, double above_border) {
            double result = at_middle(least, gradient, center, half);
            DVec<D> rest = out * (s > 0 ? c : 1) - gradient;
            double at = far;
            if (s > 0) {
                at = c * far + s * above_border;
                for (int a = 0; a < D; ++a)
                    if (!out_along(a)) rest[a] = 0;
            }
            result = std::max(result, at + least_in_box(rest, half) + dot(gradient, center_ - center));
            if (!(to_surface > 0)) return result;
            return std::max(result, to_surface + least_in_box(from_surface / to_surface - gradient, half) +
                                        dot(gradient, center_ - center));
        };
        keep(least, above(own_, border.above_own), above(wanted_, border.above_wanted));
    }
    /// How high a plane of this gradient may be in the middle of the box, so that it is below a value in a region.
    double at_middle(double value, const DVec<D>& gradient, const DVec<D>& center, const DVec<D>& half) const {
        return value + least_in_box(gradient, half) + dot(gradient, center_ - center);
    }
    double distance_of_surface(const DVec<D>& low, const DVec<D>& high) const {
        double squares = 0;
        for (int a = 0; a < D; ++a) {
            const auto origin = static_cast<double>(data_.origin[a]);
            const double below = static_cast<double>(data_.surface.min[a]) - (origin + cell_ * high[a]),
                         above = origin + cell_ * low[a] - static_cast<double>(data_.surface.max[a]);
            const double gap = std::max({below, above, 0.0});
            squares += gap * gap;
        }
        return square_root(squares);
    }

    /// In a box of the volume, which may be flat, grid by grid; all in cells, gradients in lengths.
    AbovePlanes<D> above_samples(const DVec<D>& low, const DVec<D>& high, const DVec<D>& center, const DVec<D>& own,
                                 const DVec<D>& wanted) const {
        AbovePlanes<D> result{center, own * cell_, wanted * cell_};
        Cell<D> first, last, at;
        bool is_small = true;
        for (int a = 0; a < D; ++a) {
            const std::int32_t most = last_cell(data_, a);
            first[a] = std::min(static_cast<std::int32_t>(low[a]), most);
            last[a] = std::max(std::min(static_cast<std::int32_t>(std::ceil(high[a])) - 1, most), first[a]);
            is_small = is_small && last[a] - first[a] <= 1;
        }
        const std::int32_t side =
            data_.store == FieldStore::dense ? 1 << 30 : static_cast<std::int32_t>(brick_cells<D>);
        const Cell<D> first_grid = first / side, last_grid = last / side;
        at = first_grid;
        do {
            Cell<D> in;
            for (int a = 0; a < D; ++a) in[a] = std::max(at[a] * side, first[a]);
            const SampleGrid<D> grid = grid_of(data_, in);
            if (grid.coarse || (is_small && needs_gradient_))
                look_at_cells(grid, low, high, first, last, result);
            else
                look_at_samples(grid, low, high, result);
        } while (next_cell(at, first_grid, last_grid));
        return result;
    }

    /// Within a cell, along each axis it is linear: what it is over a plane is least at a corner of what is in the box.
    void look_at_cells(const SampleGrid<D>& grid, const DVec<D>& low, const DVec<D>& high, const Cell<D>& low_cell,
                       const Cell<D>& high_cell, AbovePlanes<D>& above) const {
        Cell<D> first, last;
        for (int a = 0; a < D; ++a) {
            first[a] = grid.coarse ? grid.low[a] : std::max(low_cell[a], grid.low[a]);
            last[a] = grid.coarse ? grid.low[a] : std::min(high_cell[a], grid.high[a]);
        }
        Cell<D> cell = first;
        do {
            const CellValues<D> values = values_in(data_, grid, cell);
            for (std::size_t i = 0; i < cell_corners<D>; ++i) {
                DVec<D> place;
                for (int a = 0; a < D; ++a)
                    place[a] =
                        i >> a & 1 ? std::min(values.low[a] + values.side, high[a]) : std::max(values.low[a], low[a]);
                above.add(values.at(place), place);
            }
        } while (next_cell(cell, first, last));
    }

    void look_at_samples(const SampleGrid<D>& grid, const DVec<D>& low, const DVec<D>& high,
                         AbovePlanes<D>& above) const {
        Cell<D> first, last;
        for (int a = 0; a < D; ++a) {
            first[a] = std::max(static_cast<std::int32_t>(low[a]), grid.low[a]);
            last[a] = std::min(static_cast<std::int32_t>(std::ceil(high[a])), grid.high[a] + 1);
        }
        Cell<D> row = first, row_last = last;
        row_last[0] = first[0];
        do {
            std::uint32_t sample = grid.first;
            DVec<D> place;
            for (int a = 0; a < D; ++a) {
                sample += static_cast<std::uint32_t>(row[a] - grid.low[a]) * grid.stride[a];
                place[a] = row[a];
            }
            double own = dot(above.own, place - above.center), wanted = dot(above.wanted, place - above.center);
            for (std::int32_t i = first[0]; i <= last[0]; ++i, ++sample) {
                const double value = value_of(data_, grid, sample);
                above.least = std::min(above.least, value);
                above.above_own = std::min(above.above_own, value - own);
                above.above_wanted = std::min(above.above_wanted, value - wanted);
                own += above.own[0];
                wanted += above.wanted[0];
            }
        } while (next_cell(row, first, row_last));
    }

    const FieldData<D>& data_;
    double cell_;
    DVec<D> low_, high_;     ///< in cells
    DVec<D> center_, half_;  ///< in lengths
    DVec<D> own_, wanted_;   ///< gradients
    bool needs_gradient_ = true;
    double least_ = std::numeric_limits<double>::infinity(), above_own_ = least_, above_wanted_ = least_;
};

}  // namespace

template <int D>
double extended_distance(const FieldData<D>& data, const DVec<D>& point, DVec<D>& gradient) {
    return distance_and(data, point, &gradient);
}

template <int D>
DistanceBoundStatus extended_bound(const FieldData<D>& data, const DVec<D>& low, const DVec<D>& high,
                                   DistanceBound<D>& bound) {
    return BoundInBox<D>(data, low, high).run(bound);
}

template <int D>
float extended_slope(const FieldData<D>& data) {
    return square_root(static_cast<float>(D)) * (1 + data.step / data.cell);
}

template <int D>
bool holds_surface(const FieldData<D>& data) {
    const Aabb<D> volume = volume_of(data);
    for (int a = 0; a < D; ++a)
        if (!(volume.min[a] <= data.surface.min[a] && data.surface.max[a] <= volume.max[a])) return false;
    return true;
}

#define ABUT_INSTANTIATE(D)                                                                          \
    template double extended_distance(const FieldData<D>&, const DVec<D>&, DVec<D>&);                \
    template DistanceBoundStatus extended_bound(const FieldData<D>&, const DVec<D>&, const DVec<D>&, \
                                                DistanceBound<D>&);                                  \
    template float extended_slope(const FieldData<D>&);                                              \
    template bool holds_surface(const FieldData<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
