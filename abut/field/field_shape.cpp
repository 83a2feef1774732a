// A field as the questions see it: its distance continued outside of the volume, and where a line crosses a distance,
// from cell to cell.

#include <abut/field/field.hpp>
#include <abut/field/field_cells.hpp>
#include <abut/field/field_extended.hpp>

#include <optional>

namespace abut {
namespace {

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
    Crossing(const FieldData<D>& data, const DVec<D>& origin, const DVec<D>& direction, double reach,
             const DistanceRange& range)
        : data_(data), reach_(reach), range_(range), own_origin_(origin), own_way_(direction) {
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
                DVec<D> gradient;
                const double here = extended_distance(data_, own_origin_ + own_way_ * along, gradient);
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

    const FieldData<D>& data_;
    double reach_;
    DistanceRange range_;
    DVec<D> own_origin_, own_way_;  ///< in lengths
    DVec<D> origin_, way_;          ///< in cells
    double speed_ = 0;
};

/// The look-ups of the volume, and beyond it what `extended_distance` says.
template <int D>
float distance_anywhere(const void* object, const Vec<D>& point) {
    const auto& field = *static_cast<const Field<D>*>(object);
    if (!is_finite<D>(point) || contains(volume_of(field.data()), point)) return field.distance(point);
    DVec<D> gradient;
    return static_cast<float>(extended_distance(field.data(), DVec<D>(point), gradient));
}
template <int D>
FieldSample<D> sample_anywhere(const void* object, const Vec<D>& point) {
    const auto& field = *static_cast<const Field<D>*>(object);
    if (!is_finite<D>(point) || contains(volume_of(field.data()), point)) return field.sample(point);
    DVec<D> gradient;
    const double distance = extended_distance(field.data(), DVec<D>(point), gradient);
    return {static_cast<float>(distance), to_float(normalized(gradient))};
}

}  // namespace

template <int D>
DistanceFunction<D> view(const Field<D>& field) {
    DistanceFunction<D> result;
    const FieldData<D>& data = field.data();
    result.bounds = bounds(field);
    result.object = &field;
    result.distance = distance_anywhere<D>;
    result.sample = sample_anywhere<D>;
    result.resolution = data.cell;
    if (data.lookup != FieldLookup::linear) return result;
    result.slope = extended_slope(data);
    result.gradient = [](const void* object, const DVec<D>& point, DVec<D>& gradient) {
        return extended_distance(static_cast<const Field<D>*>(object)->data(), point, gradient);
    };
    result.bound = [](const void* object, const DVec<D>& low, const DVec<D>& high, DistanceBound<D>& bound) {
        return extended_bound(static_cast<const Field<D>*>(object)->data(), low, high, bound);
    };
    result.crossing = [](const void* object, const DVec<D>& origin, const DVec<D>& direction, double reach,
                         const DistanceRange& range) {
        return Crossing<D>(static_cast<const Field<D>*>(object)->data(), origin, direction, reach, range).run();
    };
    return result;
}

template DistanceFunction<2> view(const Field<2>&);
template DistanceFunction<3> view(const Field<3>&);

}  // namespace abut
