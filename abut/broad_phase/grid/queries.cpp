// Queries among the cells of a Grid. SIMD tests the quantised bounds of sixteen boxes together, conservatively; the
// boxes themselves decide, in double. Each item is reported once without marks: the box and the query determine the one
// cell that reports it. Highway compiles this file once for each SIMD target and dispatches at run time.

#include <abut/broad_phase/grid/queries.hpp>
#include <abut/broad_phase/grid/traversal.hpp>

#include <algorithm>
#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/grid/queries.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, 16>;
using Numbers = hn::RebindToSigned<Lanes>;
using Floats = hn::RebindToFloat<Lanes>;
constexpr Lanes d;
constexpr Numbers di;
constexpr Floats df;
constexpr std::size_t lanes = hn::MaxLanes(d);
constexpr std::uint32_t page_size = GridStore::page_size;

/// Removes the lowest set bit and returns its lane.
inline std::uint32_t next_lane(std::uint32_t& bits) {
    const auto result = static_cast<std::uint32_t>(std::countr_zero(bits));
    bits &= bits - 1;
    return result;
}

inline std::uint32_t bits_of(hn::Mask<Lanes> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, mask, bytes);
    return static_cast<std::uint32_t>(bytes[0]) | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// Consecutive records of a page in SIMD vectors.
struct RecordLanes {
    hn::Vec<Lanes> low, high;

    explicit RecordLanes(const GridRecord* records) {
        hn::Vec<Lanes> unused;
        hn::LoadInterleaved3(d, &records->low, low, high, unused);
    }

    /// The records whose quantised bounds overlap those of a box; never unused records.
    template <int D>
    hn::Mask<Lanes> overlap(const PackedBox<D>& box) const {
        const auto guards = hn::Set(d, PackedBounds<D>::guards);
        const auto differences = hn::And(hn::Sub(high, hn::Set(d, box.low)), hn::Sub(hn::Set(d, box.high), low));
        return hn::Eq(hn::And(differences, guards), guards);
    }

    /// The fields of an axis, as floats.
    template <int D>
    static hn::Vec<Floats> field(hn::Vec<Lanes> words, std::size_t axis) {
        const int i = static_cast<int>(axis);
        const auto steps = hn::And(hn::ShiftRightSame(words, PackedBounds<D>::field_shift[axis]),
                                   hn::Set(d, PackedBounds<D>::max_field(i)));
        return hn::ConvertTo(df, hn::BitCast(di, steps));
    }
};

/// The length of one unit of a field along an axis.
template <int D>
double field_length(const GridBorders<D>& borders, std::size_t axis) {
    return borders.edge() / (PackedBounds<D>::max_field(static_cast<int>(axis)) + 1);
}

/// A float that is not less than the number; infinity for numbers from 1e37 on, whose squares would overflow.
inline float limit_as_float(double number) {
    return number < 1e37 ? static_cast<float>(number) * (1 + 1e-5f) + 1e-37f : std::numeric_limits<float>::infinity();
}

/// The part of a ray in one cell.
template <int D>
class RayInCell {
public:
    using Span = typename RayCells<D>::Span;

    RayInCell(const RayCells<D>& ray, const GridCells<D>& cells, const GridCell<D>& cell, const Span& span)
        : bounds_(quantised(ray, cells, cell, span), cell), from_(span.from), to_(span.to) {
        for (std::size_t i = 0; i < D; ++i) {
            moves_[i] = ray.moves_along(i);
            if (!moves_[i]) continue;
            const double inverse = ray.inverse(i), step = field_length(ray.borders(), i) * inverse;
            const double begin = (ray.borders().border(i, cell[i]) - ray.origin(i)) * inverse - from_;
            const double edge = ray.borders().edge() * std::abs(inverse);
            const double tolerance = ray.tolerance(i) * std::abs(inverse) + 1e-6 * (std::abs(begin) + edge) +
                                     1e-11 * (from_ + std::min(to_, 1e300));
            is_ascending_[i] = ray.is_ascending(i);
            step_[i] = to_float(step);
            in_[i] = to_float((is_ascending_[i] ? begin : begin + step) - tolerance);
            out_[i] = to_float((is_ascending_[i] ? begin + step : begin) + tolerance);
        }
    }

    /// An upper bound of the length of the ray from its entry into the cell to the reach.
    float limit(const RayReach<D>& reach) const { return limit_as_float(std::min(to_, reach.reach()) - from_); }

    /// The bits of the records that the ray may touch before `limit`, with lower bounds of the distances of entry.
    std::uint32_t operator()(const RecordLanes& records, float limit, float* measures) const {
        const auto overlap = records.overlap<D>(bounds_);
        auto enters = hn::Zero(df), leaves = hn::Set(df, limit);
        for (std::size_t i = 0; i < D; ++i) {
            if (!moves_[i]) continue;
            const auto low = RecordLanes::field<D>(records.low, i), high = RecordLanes::field<D>(records.high, i);
            const auto near = is_ascending_[i] ? low : high, far = is_ascending_[i] ? high : low;
            // A bound at the border of the cell may be clamped: the box may extend into the next cell or beyond the
            // region.
            const float max_field = static_cast<float>(PackedBounds<D>::max_field(static_cast<int>(i)));
            const auto near_end = hn::Set(df, is_ascending_[i] ? 0.0f : max_field),
                       far_end = hn::Set(df, is_ascending_[i] ? max_field : 0.0f);
            const auto step = hn::Set(df, step_[i]);
            const auto in = hn::Add(hn::Mul(near, step), hn::Set(df, in_[i]));
            const auto out = hn::Add(hn::Mul(far, step), hn::Set(df, out_[i]));
            enters = hn::IfThenElse(hn::Eq(near, near_end), enters, hn::Max(enters, in));
            leaves = hn::IfThenElse(hn::Eq(far, far_end), leaves, hn::Min(leaves, out));
        }
        hn::StoreU(enters, df, measures);
        return bits_of(hn::And(overlap, hn::RebindMask(d, hn::Le(enters, leaves))));
    }

private:
    /// The quantised bounding box of the ray within the cell.
    static QuantisedBox<D> quantised(const RayCells<D>& ray, const GridCells<D>& cells, const GridCell<D>& cell,
                                     const Span& span) {
        QuantisedBox<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const Span interval = ray.coordinates(i, span);
            const double base = ray.borders().border(i, cell[i]), scale = static_cast<double>(cells.scale);
            const auto step = [&](double coordinate) {
                const double steps = std::clamp((coordinate - base) * scale, 0.0, PackedBounds<D>::steps - 1.0);
                return (cell[i] << PackedBounds<D>::step_bits) + static_cast<std::uint32_t>(steps);
            };
            result.low[i] = step(interval.from);
            result.high[i] = step(interval.to);
        }
        return result;
    }

    PackedBox<D> bounds_;
    double from_, to_;
    bool moves_[D], is_ascending_[D]{};
    float step_[D]{}, in_[D]{}, out_[D]{};  ///< distances along the ray from its entry into the cell
};

/// The distances of a query box from the records of one cell.
template <int D>
class BoxFromCell {
public:
    BoxFromCell(const BoxCells<D>& box, const GridCell<D>& cell) {
        for (std::size_t i = 0; i < D; ++i) {
            const GridBorders<D>& borders = box.borders();
            const double length = field_length(borders, i), base = borders.border(i, cell[i]);
            step_[i] = to_float(length);
            above_[i] = to_float(base - box.high(i) - box.tolerance(i));
            below_[i] = to_float(box.low(i) - base - length - box.tolerance(i));
            min_low_[i] = cell[i] == 0 ? 0.0f : -1.0f;
            const auto max_field = static_cast<float>(PackedBounds<D>::max_field(static_cast<int>(i)));
            max_high_[i] = cell[i] == borders.last(i) ? max_field : max_field + 1;
        }
    }

    static float limit(const BoxReach<D>& reach) { return limit_as_float(reach.max_measure()); }

    /// The bits of the records whose squared distances may be within `limit`, with lower bounds of these. Unused
    /// records may be among them.
    std::uint32_t operator()(const RecordLanes& records, float limit, float* measures) const {
        auto sum = hn::Zero(df);
        for (std::size_t i = 0; i < D; ++i) {
            const auto low = RecordLanes::field<D>(records.low, i), high = RecordLanes::field<D>(records.high, i);
            const auto step = hn::Set(df, step_[i]);
            const auto above = hn::Add(hn::Mul(low, step), hn::Set(df, above_[i]));
            const auto below = hn::Sub(hn::Set(df, below_[i]), hn::Mul(high, step));
            // A bound at the border of the region may be clamped: the box may extend beyond it.
            const auto gap = hn::Max(hn::IfThenElseZero(hn::Gt(low, hn::Set(df, min_low_[i])), above),
                                     hn::IfThenElseZero(hn::Lt(high, hn::Set(df, max_high_[i])), below));
            const auto positive = hn::Max(gap, hn::Zero(df));
            sum = hn::Add(sum, hn::Mul(positive, positive));
        }
        hn::StoreU(sum, df, measures);
        return bits_of(hn::RebindMask(d, hn::Le(sum, hn::Set(df, limit))));
    }

private:
    float step_[D], above_[D], below_[D];
    float min_low_[D], max_high_[D];  ///< fields are exact bounds if above min_low_, or below max_high_; else clamped
};

/// Visits the items within reach for which this cell is cell_of(range, measure), the cell that reports them. Returns
/// false if the search ends.
template <int D, class Reach, class InCell, class CellOf>
bool visit_cell(const GridItems<D>& items, const GridCell<D>& cell, Reach& reach, const InCell& query, CellOf cell_of,
                ReachCall visit) {
    float limit = query.limit(reach), measures[page_size];
    return items.store.each_page(items.cells.index(cell), [&](std::uint32_t first, std::uint32_t count) {
        const GridRecord* records = items.store.records.data() + first;
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < page_size; i += lanes)
            bits |= query(RecordLanes(records + i), limit, measures + i) << i;
        bits &= (1u << count) - 1;
        while (bits != 0) {
            const std::uint32_t lane = next_lane(bits), item = records[lane].item;
            double measure = 0;
            if (measures[lane] > limit || !reach.measure(items.boxes[item], measure)) continue;
            if (cell_of(items.cells.range(items.boxes[item]), measure) != cell) continue;
            reach.shrink(visit(item));
            if (reach.is_exhausted()) return false;
            limit = query.limit(reach);
        }
        return true;
    });
}

template <int D>
void visit_within(const GridItems<D>& items, RayReach<D> reach, ReachCall visit) {
    const RayCells<D> ray(items.cells, reach);
    ray.each(reach, [&](const GridCell<D>& cell, const typename RayCells<D>::Span& span) {
        if (items.store.is_empty(items.cells.index(cell))) return true;
        const RayInCell<D> query(ray, items.cells, cell, span);
        const auto cell_of = [&](const CellRange<D>& range, double enters) { return ray.entry(range, enters); };
        return visit_cell<D>(items, cell, reach, query, cell_of, visit);
    });
}

template <int D>
void visit_within(const GridItems<D>& items, BoxReach<D> reach, ReachCall visit) {
    const BoxCells<D> box(items.cells, reach.box());
    box.each(reach, [&](const GridCell<D>& cell) {
        if (items.store.is_empty(items.cells.index(cell))) return true;
        const auto cell_of = [&](const CellRange<D>& range, double) { return box.nearest(range); };
        return visit_cell<D>(items, cell, reach, BoxFromCell<D>(box, cell), cell_of, visit);
    });
}

template <int D>
void overlapping(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit) {
    const QuantisedBox<D> quantised = items.cells.quantised(box);
    each_cell<D>(items.cells.range(quantised), [&](const GridCell<D>& cell) {
        // The flags of copies ensure that only the first cell in common reports an item.
        const PackedBox<D> bounds(quantised, cell);
        return items.store.each_page(items.cells.index(cell), [&](std::uint32_t first, std::uint32_t count) {
            const GridRecord* records = items.store.records.data() + first;
            std::uint32_t bits = 0;
            for (std::size_t i = 0; i < page_size; i += lanes)
                bits |= bits_of(RecordLanes(records + i).template overlap<D>(bounds)) << i;
            bits &= (1u << count) - 1;
            while (bits != 0) {
                const GridRecord& record = records[next_lane(bits)];
                if (!PackedBounds<D>::surely_overlap(bounds.low, bounds.high, record.low, record.high) &&
                    !overlaps(items.boxes[record.item], box))
                    continue;
                if (!visit(record.item)) return false;
            }
            return true;
        });
    });
}

// Functions without templates, as HWY_EXPORT needs.
#define ABUT_FOR_DIMENSION(D)                                                              \
    void overlapping_##D(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit) {  \
        overlapping(items, box, visit);                                                    \
    }                                                                                      \
    void along_##D(const GridItems<D>& items, const RayReach<D>& reach, ReachCall visit) { \
        visit_within(items, reach, visit);                                                 \
    }                                                                                      \
    void near_##D(const GridItems<D>& items, const BoxReach<D>& reach, ReachCall visit) {  \
        visit_within(items, reach, visit);                                                 \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

#define ABUT_FOR_DIMENSION(D)                                                                \
    HWY_EXPORT(overlapping_##D);                                                             \
    HWY_EXPORT(along_##D);                                                                   \
    HWY_EXPORT(near_##D);                                                                    \
    template <>                                                                              \
    void find_overlapping(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit) {   \
        HWY_DYNAMIC_DISPATCH(overlapping_##D)(items, box, visit);                            \
    }                                                                                        \
    template <>                                                                              \
    void find_within(const GridItems<D>& items, const RayReach<D>& reach, ReachCall visit) { \
        HWY_DYNAMIC_DISPATCH(along_##D)(items, reach, visit);                                \
    }                                                                                        \
    template <>                                                                              \
    void find_within(const GridItems<D>& items, const BoxReach<D>& reach, ReachCall visit) { \
        HWY_DYNAMIC_DISPATCH(near_##D)(items, reach, visit);                                 \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::detail
#endif
