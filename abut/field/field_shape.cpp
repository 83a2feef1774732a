// A field as the questions see it: what it is at least in a box, and where a line crosses a distance, told exactly from
// the samples.

#include <abut/field/field.hpp>
#include <abut/field/field_spot.hpp>
#include <abut/math/dvec.hpp>

#include <optional>

namespace abut {
namespace {

/// Boxes of more cells along an axis are to be cut first.
template <int D>
constexpr std::int32_t most_cells = D == 2 ? 16 : 8;

template <int D>
using Cell = glm::vec<D, std::int32_t>;

/// Samples in rows: a volume's, a brick's, or the corners of one block without a brick.
template <int D>
struct SampleGrid {
    Cell<D> low, high;    ///< the first and the last cell of the volume that it holds
    std::uint32_t first;  ///< the sample at its lowest corner
    glm::vec<D, std::uint32_t> stride;
    std::int32_t side = 1;  ///< cells of the volume from sample to sample
    bool coarse = false;
};

template <int D>
double value_of(const FieldData<D>& data, const SampleGrid<D>& grid, std::uint32_t sample) {
    if (grid.coarse) return static_cast<double>(data.coarse[sample]);
    if (data.steps.empty()) return static_cast<double>(data.distance[sample]);
    return static_cast<double>(data.steps[sample]) * static_cast<double>(data.step);
}

/// The last cell of the volume along an axis.
template <int D>
std::int32_t last_cell(const FieldData<D>& data, int axis) {
    return static_cast<std::int32_t>(data.cells[axis]) - 1;
}

/// The grid in which a cell of the volume lies.
template <int D>
SampleGrid<D> grid_of(const FieldData<D>& data, const Cell<D>& cell) {
    const FieldFrame<D>& frame = data.frame;
    SampleGrid<D> result;
    if (data.store == FieldStore::dense) {
        result = {Cell<D>(0), Cell<D>(data.cells) - 1, 0, frame.stride};
        return result;
    }
    constexpr auto side = static_cast<std::int32_t>(brick_cells<D>);
    std::uint32_t block = 0, corner = 0, stride = 1;
    for (int a = 0; a < D; ++a) {
        const auto at = static_cast<std::uint32_t>(cell[a] / side);
        block += at * frame.block_row[a];
        corner += at * frame.corners[a];
        result.low[a] = cell[a] / side * side;
        result.high[a] = result.low[a] + side - 1;
        result.stride[a] = stride;
        stride *= brick_cells<D> + 1;
    }
    const std::uint32_t brick = data.brick[block];
    if (brick != no_brick) {
        result.first = brick * brick_samples<D>;
        return result;
    }
    result.first = corner;
    result.stride = frame.corners;
    result.side = side;
    result.coarse = true;
    return result;
}

/// The distances at the corners of one cell of a grid, which is all of a coarse one.
template <int D>
struct CellValues {
    DVec<D> low;  ///< the lowest corner, in cells of the volume
    double side;
    std::array<double, cell_corners<D>> values;

    /// At a place in cells of the volume.
    double at(const DVec<D>& place) const {
        std::array<double, cell_corners<D>> left = values;
        std::size_t count = left.size();
        for (int a = 0; a < D; ++a) {
            const double share = (place[a] - low[a]) / side;
            count /= 2;
            for (std::size_t i = 0; i < count; ++i) left[i] = left[2 * i] + share * (left[2 * i + 1] - left[2 * i]);
        }
        return left[0];
    }
};

template <int D>
CellValues<D> values_in(const FieldData<D>& data, const SampleGrid<D>& grid, const Cell<D>& cell) {
    CellValues<D> result;
    std::uint32_t first = grid.first;
    for (int a = 0; a < D; ++a) {
        const std::int32_t at = grid.coarse ? 0 : cell[a] - grid.low[a];
        first += static_cast<std::uint32_t>(at) * grid.stride[a];
        result.low[a] = grid.low[a] + at;
    }
    result.side = grid.side;
    for (std::size_t i = 0; i < result.values.size(); ++i) {
        std::uint32_t sample = first;
        for (int a = 0; a < D; ++a)
            if (i >> a & 1) sample += grid.stride[a];
        result.values[i] = value_of(data, grid, sample);
    }
    return result;
}

/// The next of all places in a box of cells, the first axis the fastest; false behind the last.
template <int D>
bool step(Cell<D>& cell, const Cell<D>& low, const Cell<D>& high) {
    for (int a = 0; a < D; ++a) {
        if (++cell[a] <= high[a]) return true;
        cell[a] = low[a];
    }
    return false;
}

template <int D>
class BoundInBox {
public:
    BoundInBox(const FieldData<D>& data, const DVec<D>& low, const DVec<D>& high) : data_(data) {
        const auto cell = static_cast<double>(data.cell);
        for (int a = 0; a < D; ++a) {
            low_[a] = (low[a] - static_cast<double>(data.origin[a])) / cell;
            high_[a] = (high[a] - static_cast<double>(data.origin[a])) / cell;
        }
    }

    DistanceKnown run(DistanceBound<D>& bound) {
        Cell<D> low, high;
        std::int64_t cells = 1;
        bool is_small = true;
        for (int a = 0; a < D; ++a) {
            const std::int32_t last = last_cell(data_, a);
            if (!(low_[a] >= 0 && high_[a] <= last + 1)) return DistanceKnown::nothing;
            low[a] = std::min(static_cast<std::int32_t>(low_[a]), last);
            high[a] = std::max(std::min(static_cast<std::int32_t>(std::ceil(high_[a])) - 1, last), low[a]);
            if (high[a] - low[a] >= most_cells<D>) return DistanceKnown::in_smaller_boxes;
            cells *= high[a] - low[a] + 1;
            is_small = is_small && high[a] - low[a] <= 1;
        }
        center_ = (low_ + high_) * 0.5;
        find_gradient();
        least_ = above_plane_ = std::numeric_limits<double>::infinity();
        // Grid by grid.
        Cell<D> at = low;
        const std::int32_t side =
            data_.store == FieldStore::dense ? 1 << 30 : static_cast<std::int32_t>(brick_cells<D>);
        Cell<D> first, last;
        for (int a = 0; a < D; ++a) {
            first[a] = low[a] / side;
            last[a] = high[a] / side;
        }
        at = first;
        do {
            Cell<D> in = at;
            for (int a = 0; a < D; ++a) in[a] = std::max(at[a] * side, low[a]);
            const SampleGrid<D> grid = grid_of(data_, in);
            if (grid.coarse || is_small)
                look_at_cells(grid, low, high);
            else
                look_at_samples(grid, low, high);
        } while (step(at, first, last));
        bound.value = above_plane_;
        bound.least = least_;
        bound.gradient = gradient_ / static_cast<double>(data_.cell);
        return DistanceKnown::bound;
    }

private:
    /// For each cell in lengths of a cell, from side to side of the box.
    void find_gradient() {
        for (int a = 0; a < D; ++a) {
            DVec<D> from = center_, to = center_;
            const double reach = std::max(0.5 * (high_[a] - low_[a]), 0.05);
            from[a] = std::max(center_[a] - reach, 0.0);
            to[a] = std::min(center_[a] + reach, static_cast<double>(data_.cells[a]));
            gradient_[a] = (at(to) - at(from)) / (to[a] - from[a]);
        }
    }
    double at(const DVec<D>& place) const {
        Cell<D> cell;
        for (int a = 0; a < D; ++a) cell[a] = std::min(static_cast<std::int32_t>(place[a]), last_cell(data_, a));
        return values_in(data_, grid_of(data_, cell), cell).at(place);
    }

    /// Within a cell, along each axis it is linear: what it is over a plane is least at a corner of what is in the box.
    void look_at_cells(const SampleGrid<D>& grid, const Cell<D>& low, const Cell<D>& high) {
        Cell<D> first, last;
        for (int a = 0; a < D; ++a) {
            first[a] = grid.coarse ? grid.low[a] : std::max(low[a], grid.low[a]);
            last[a] = grid.coarse ? grid.low[a] : std::min(high[a], grid.high[a]);
        }
        Cell<D> cell = first;
        do {
            const CellValues<D> values = values_in(data_, grid, cell);
            for (std::size_t i = 0; i < cell_corners<D>; ++i) {
                DVec<D> place;
                for (int a = 0; a < D; ++a)
                    place[a] =
                        i >> a & 1 ? std::min(values.low[a] + values.side, high_[a]) : std::max(values.low[a], low_[a]);
                const double value = values.at(place);
                least_ = std::min(least_, value);
                above_plane_ = std::min(above_plane_, value - dot(gradient_, place - center_));
            }
        } while (step(cell, first, last));
    }

    void look_at_samples(const SampleGrid<D>& grid, const Cell<D>& low, const Cell<D>& high) {
        Cell<D> first, last;
        for (int a = 0; a < D; ++a) {
            first[a] = std::max(low[a], grid.low[a]);
            last[a] = std::min(high[a], grid.high[a]) + 1;
        }
        Cell<D> row = first;
        Cell<D> row_last = last;
        row_last[0] = first[0];
        do {
            std::uint32_t sample = grid.first;
            DVec<D> place;
            for (int a = 0; a < D; ++a) {
                sample += static_cast<std::uint32_t>(row[a] - grid.low[a]) * grid.stride[a];
                place[a] = row[a];
            }
            double plane = dot(gradient_, place - center_);
            for (std::int32_t i = first[0]; i <= last[0]; ++i, ++sample, plane += gradient_[0]) {
                const double value = value_of(data_, grid, sample);
                least_ = std::min(least_, value);
                above_plane_ = std::min(above_plane_, value - plane);
            }
        } while (step(row, first, row_last));
    }

    const FieldData<D>& data_;
    DVec<D> low_, high_, center_, gradient_;  ///< in cells
    double least_ = 0, above_plane_ = 0;
};

/// The first place in (0, 1] at which a cubic, given at 0, 1/3, 2/3 and 1, is at most 0.
std::optional<double> first_at_most_zero(const std::array<double, 4>& at) {
    const double c0 = at[0], c1 = 0.5 * (-11 * at[0] + 18 * at[1] - 9 * at[2] + 2 * at[3]),
                 c2 = 4.5 * (2 * at[0] - 5 * at[1] + 4 * at[2] - at[3]),
                 c3 = 4.5 * (-at[0] + 3 * at[1] - 3 * at[2] + at[3]);
    const auto value = [&](double s) { return ((c3 * s + c2) * s + c1) * s + c0; };
    // Where it turns round.
    std::array<double, 4> ends{0, 1, 1, 1};
    std::size_t count = 1;
    const double a = 3 * c3, b = 2 * c2, root = b * b - 4 * a * c1;
    if (root > 0) {
        const double q = -0.5 * (b + (b < 0 ? -std::sqrt(root) : std::sqrt(root)));
        double first = q != 0 ? c1 / q : 2, second = a != 0 ? q / a : 2;
        if (second < first) std::swap(first, second);
        for (const double turn : {first, second})
            if (turn > 0 && turn < 1) ends[count++] = turn;
    }
    ends[count++] = 1;
    for (std::size_t i = 1; i < count; ++i) {
        double before = ends[i - 1], after = ends[i];
        if (!(value(after) <= 0)) continue;
        if (value(before) <= 0) return before;
        for (int halving = 0; halving < 60; ++halving) {
            const double middle = 0.5 * (before + after);
            if (!(middle > before && middle < after)) break;
            (value(middle) <= 0 ? after : before) = middle;
        }
        return after;
    }
    return std::nullopt;
}

/// Along a line, from cell to cell where the distance is near one of the two, and by it where it isn't.
template <int D>
class Crossing {
public:
    Crossing(const Field<D>& field, const DVec<D>& origin, const DVec<D>& direction, double reach,
             const DistanceRange& range)
        : field_(field), data_(field.data()), reach_(reach), range_(range), own_origin_(origin), own_way_(direction) {
        const auto cell = static_cast<double>(data_.cell);
        for (int a = 0; a < D; ++a) {
            origin_[a] = (origin[a] - static_cast<double>(data_.origin[a])) / cell;
            way_[a] = direction[a] / cell;
        }
        speed_ = length(direction);
    }

    DistanceCrossing run() {
        if (!(speed_ > 0)) return {};
        std::int64_t most_steps = 256;
        for (int a = 0; a < D; ++a) most_steps += 4 * (static_cast<std::int64_t>(data_.cells[a]));
        const auto cell = static_cast<double>(data_.cell);
        const double steep = std::sqrt(static_cast<double>(D));
        double along = 0;
        for (std::int64_t i = 0; i < most_steps; ++i) {
            const DVec<D> place = origin_ + way_ * along;
            if (!is_in_volume(place)) {
                const auto here = static_cast<double>(field_.distance(to_float(own_origin_ + own_way_ * along)));
                if (here <= range_.low || here >= range_.high) return {along, true, here <= range_.low};
                const double room = std::min(here - range_.low, range_.high - here);
                along = std::min(along + std::max(room, 0.25 * cell) / speed_, enters_volume(along));
            } else {
                Cell<D> at;
                for (int a = 0; a < D; ++a) at[a] = cell_at(place[a], way_[a], last_cell(data_, a));
                const CellValues<D> values = values_in(data_, grid_of(data_, at), at);
                const double here = values.at(place), room = std::min(here - range_.low, range_.high - here);
                const double leap = room / (steep * cell);
                if (leap > 2) {
                    along += room / (steep * speed_);
                } else {
                    const double leaves = std::min(leaves_cell(values, along), reach_);
                    if (const auto found = in_cell(values, along, leaves)) return *found;
                    // What rounding takes for the same cell again.
                    along = std::max(leaves, along + 1e-9 * cell / speed_);
                }
            }
            if (along >= reach_) return {};
        }
        return {};
    }

private:
    bool is_in_volume(const DVec<D>& place) const {
        bool result = true;
        for (int a = 0; a < D; ++a) {
            // What is on its border and goes out is outside.
            const double high = static_cast<double>(data_.cells[a]);
            result = result && (place[a] > 0 || (place[a] == 0 && way_[a] >= 0)) &&
                     (place[a] < high || (place[a] == high && way_[a] <= 0));
        }
        return result;
    }
    /// From outside; infinite where it doesn't.
    double enters_volume(double along) const {
        constexpr double never = std::numeric_limits<double>::infinity();
        double enter = along, leave = never;
        for (int a = 0; a < D; ++a) {
            const double high = static_cast<double>(data_.cells[a]);
            if (way_[a] == 0) {
                if (origin_[a] < 0 || origin_[a] > high) return never;
                continue;
            }
            const double to_low = -origin_[a] / way_[a], to_high = (high - origin_[a]) / way_[a];
            enter = std::max(enter, std::min(to_low, to_high));
            leave = std::min(leave, std::max(to_low, to_high));
        }
        if (!(enter < leave)) return never;
        // Surely within.
        return enter > along ? enter + 1e-9 * static_cast<double>(data_.cell) / speed_ : never;
    }
    static std::int32_t cell_at(double place, double way, std::int32_t last) {
        auto cell = static_cast<std::int32_t>(place);
        if (way < 0 && static_cast<double>(cell) == place) --cell;
        return std::clamp(cell, 0, last);
    }
    double leaves_cell(const CellValues<D>& values, double along) const {
        double result = std::numeric_limits<double>::infinity();
        for (int a = 0; a < D; ++a) {
            if (way_[a] == 0) continue;
            const double side = way_[a] > 0 ? values.low[a] + values.side : values.low[a];
            result = std::min(result, (side - origin_[a]) / way_[a]);
        }
        return std::max(result, along);
    }
    std::optional<DistanceCrossing> in_cell(const CellValues<D>& values, double from, double until) const {
        const auto [least, most] = std::minmax_element(values.values.begin(), values.values.end());
        if (*least > range_.low && *most < range_.high) return std::nullopt;
        std::array<double, 4> at;
        for (int i = 0; i < 4; ++i)
            at[static_cast<std::size_t>(i)] = values.at(origin_ + way_ * (from + (until - from) * i / 3.0));
        std::array<double, 4> above, below;
        for (std::size_t i = 0; i < 4; ++i) {
            above[i] = at[i] - range_.low;
            below[i] = range_.high - at[i];
        }
        if (above[0] <= 0) return DistanceCrossing{from, true, true};
        if (below[0] <= 0) return DistanceCrossing{from, true, false};
        const auto low = first_at_most_zero(above);
        const auto high = std::isfinite(range_.high) ? first_at_most_zero(below) : std::nullopt;
        if (!low && !high) return std::nullopt;
        const bool is_low = low && (!high || *low <= *high);
        return DistanceCrossing{from + (until - from) * (is_low ? *low : *high), true, is_low};
    }

    const Field<D>& field_;
    const FieldData<D>& data_;
    double reach_;
    DistanceRange range_;
    DVec<D> own_origin_, own_way_;  ///< in lengths
    DVec<D> origin_, way_;          ///< in cells
    double speed_ = 0;
};

}  // namespace

template <int D>
DistanceFunction<D> view(const Field<D>& field) {
    DistanceFunction<D> result;
    const FieldData<D>& data = field.data();
    result.bounds = bounds(field);
    result.object = &field;
    result.distance = [](const void* object, const Vec<D>& point) {
        return static_cast<const Field<D>*>(object)->distance(point);
    };
    result.sample = [](const void* object, const Vec<D>& point) {
        return static_cast<const Field<D>*>(object)->sample(point);
    };
    result.resolution = data.cell;
    if (data.lookup != FieldLookup::linear) return result;
    // Along each axis it grows as samples do, to which half a step may be added.
    result.slope = std::sqrt(static_cast<float>(D)) * (1 + data.step / data.cell);
    result.bound = [](const void* object, const DVec<D>& low, const DVec<D>& high, DistanceBound<D>& bound) {
        return BoundInBox<D>(static_cast<const Field<D>*>(object)->data(), low, high).run(bound);
    };
    result.crossing = [](const void* object, const DVec<D>& origin, const DVec<D>& direction, double reach,
                         const DistanceRange& range) {
        return Crossing<D>(*static_cast<const Field<D>*>(object), origin, direction, reach, range).run();
    };
    return result;
}

template DistanceFunction<2> view(const Field<2>&);
template DistanceFunction<3> view(const Field<3>&);

}  // namespace abut
