// A field as a DistanceFunction: its distance extended beyond the volume, and exact crossings of a line with a level of
// the distance, cell by cell.

#include <abut/field/cells.hpp>
#include <abut/field/field.hpp>
#include <abut/field/field_extended.hpp>
#include <abut/math/simd/square_root.hpp>

#include <optional>

namespace abut {

using namespace detail;

namespace {

/// The first root region in (0, 1] of a cubic given at 0, 1/3, 2/3 and 1: the first place where it is at most 0.
std::optional<double> first_at_most_zero(const std::array<double, 4>& at) {
    const double c0 = at[0], c1 = 0.5 * (-11 * at[0] + 18 * at[1] - 9 * at[2] + 2 * at[3]),
                 c2 = 4.5 * (2 * at[0] - 5 * at[1] + 4 * at[2] - at[3]),
                 c3 = 4.5 * (-at[0] + 3 * at[1] - 3 * at[2] + at[3]);
    const auto value = [&](double s) { return ((c3 * s + c2) * s + c1) * s + c0; };
    // The cubic's extrema split the interval into monotone parts.
    std::array<double, 4> ends{0, 1, 1, 1};
    std::size_t count = 1;
    const double a = 3 * c3, b = 2 * c2, root = b * b - 4 * a * c1;
    if (root > 0) {
        const double q = -0.5 * (b + (b < 0 ? -square_root(root) : square_root(root)));
        double first = q != 0 ? c1 / q : 2, second = a != 0 ? q / a : 2;
        if (second < first) std::swap(first, second);
        for (const double extremum : {first, second})
            if (extremum > 0 && extremum < 1) ends[count++] = extremum;
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

/// Searches a line for the first place that leaves a range of distances: cell by cell near the ends of the range, and
/// in steps of the distance elsewhere (sphere tracing).
template <int D>
class LineSearch {
public:
    LineSearch(const FieldData<D>& data, const DVec<D>& origin, const DVec<D>& direction, double reach,
               const DistanceRange& range)
        : data_(data), reach_(reach), range_(range), own_origin_(origin), own_direction_(direction) {
        const auto cell = static_cast<double>(data_.cell);
        for (int a = 0; a < D; ++a) {
            origin_[a] = (origin[a] - static_cast<double>(data_.origin[a])) / cell;
            direction_[a] = direction[a] / cell;
        }
        speed_ = length(direction);
    }

    DistanceCrossing run() {
        if (!(speed_ > 0)) return {};
        std::int64_t max_steps = 256;
        for (int a = 0; a < D; ++a) max_steps += 4 * (static_cast<std::int64_t>(data_.cells[a]));
        const auto cell = static_cast<double>(data_.cell);
        const double max_slope = square_root(static_cast<double>(D));
        double along = 0;
        for (std::int64_t i = 0; i < max_steps; ++i) {
            const DVec<D> place = origin_ + direction_ * along;
            if (!is_in_volume(place)) {
                DVec<D> gradient;
                const double here = extended_distance(data_, own_origin_ + own_direction_ * along, gradient);
                if (here <= range_.low || here >= range_.high) return {along, true, here <= range_.low};
                const double margin = std::min(here - range_.low, range_.high - here);
                along = std::min(along + std::max(margin, 0.25 * cell) / speed_, enters_volume(along));
            } else {
                Cell<D> at;
                for (int a = 0; a < D; ++a) at[a] = cell_at(place[a], direction_[a], last_cell(data_, a));
                const CellValues<D> values = values_in(data_, grid_of(data_, at), at);
                const double here = values.at(place), margin = std::min(here - range_.low, range_.high - here);
                const double leap = margin / (max_slope * cell);
                if (leap > 2) {
                    along += margin / (max_slope * speed_);
                } else {
                    const double exit = std::min(leaves_cell(values, along), reach_);
                    if (const auto found = in_cell(values, along, exit)) return *found;
                    // Rounding may find the same cell again.
                    along = std::max(exit, along + 1e-9 * cell / speed_);
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
            // A point on the border that moves outwards is outside.
            const double high = static_cast<double>(data_.cells[a]);
            result = result && (place[a] > 0 || (place[a] == 0 && direction_[a] >= 0)) &&
                     (place[a] < high || (place[a] == high && direction_[a] <= 0));
        }
        return result;
    }
    /// The parameter at which a line from outside enters the volume; infinite if it misses.
    double enters_volume(double along) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double enter = along, leave = infinity;
        for (int a = 0; a < D; ++a) {
            const double high = static_cast<double>(data_.cells[a]);
            if (direction_[a] == 0) {
                if (origin_[a] < 0 || origin_[a] > high) return infinity;
                continue;
            }
            const double to_low = -origin_[a] / direction_[a], to_high = (high - origin_[a]) / direction_[a];
            enter = std::max(enter, std::min(to_low, to_high));
            leave = std::min(leave, std::max(to_low, to_high));
        }
        if (!(enter < leave)) return infinity;
        // The offset puts the point safely inside.
        return enter > along ? enter + 1e-9 * static_cast<double>(data_.cell) / speed_ : infinity;
    }
    static std::int32_t cell_at(double place, double direction, std::int32_t last) {
        auto cell = static_cast<std::int32_t>(place);
        if (direction < 0 && static_cast<double>(cell) == place) --cell;
        return std::clamp(cell, 0, last);
    }
    double leaves_cell(const CellValues<D>& values, double along) const {
        double result = std::numeric_limits<double>::infinity();
        for (int a = 0; a < D; ++a) {
            if (direction_[a] == 0) continue;
            const double side = direction_[a] > 0 ? values.low[a] + values.side : values.low[a];
            result = std::min(result, (side - origin_[a]) / direction_[a]);
        }
        return std::max(result, along);
    }
    std::optional<DistanceCrossing> in_cell(const CellValues<D>& values, double from, double to) const {
        const auto [lowest, highest] = std::minmax_element(values.values.begin(), values.values.end());
        if (*lowest > range_.low && *highest < range_.high) return std::nullopt;
        std::array<double, 4> at;
        for (int i = 0; i < 4; ++i)
            at[static_cast<std::size_t>(i)] = values.at(origin_ + direction_ * (from + (to - from) * i / 3.0));
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
        return DistanceCrossing{from + (to - from) * (is_low ? *low : *high), true, is_low};
    }

    const FieldData<D>& data_;
    double reach_;
    DistanceRange range_;
    DVec<D> own_origin_, own_direction_;  ///< in units of length
    DVec<D> origin_, direction_;          ///< in cells
    double speed_ = 0;
};

/// The look-up in the volume, and `extended_distance` beyond it.
template <int D>
float extended_distance_at(const void* object, const Vec<D>& point) {
    const auto& field = *static_cast<const Field<D>*>(object);
    if (!is_finite<D>(point) || contains(volume_of(field.data()), point)) return field.distance(point);
    DVec<D> gradient;
    return static_cast<float>(extended_distance(field.data(), DVec<D>(point), gradient));
}
template <int D>
FieldSample<D> extended_sample_at(const void* object, const Vec<D>& point) {
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
    result.distance = extended_distance_at<D>;
    result.sample = extended_sample_at<D>;
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
        return LineSearch<D>(static_cast<const Field<D>*>(object)->data(), origin, direction, reach, range).run();
    };
    return result;
}

template DistanceFunction<2> view(const Field<2>&);
template DistanceFunction<3> view(const Field<3>&);

}  // namespace abut
