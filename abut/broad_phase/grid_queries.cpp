// Queries among the cells of a Grid. Sixteen boxes of a cell are looked at together, by the steps in their words: what
// these may let in, the box itself decides, in double. No item is told twice, though nothing is marked: each is told in
// one of its cells, which its box and the query determine.
// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs.

#include <abut/broad_phase/grid_queries.hpp>
#include <abut/broad_phase/grid_walk.hpp>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/grid_queries.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, 16>;
using Numbers = hn::RebindToSigned<Lanes>;
using Floats = hn::RebindToFloat<Lanes>;
constexpr Lanes d;
constexpr Numbers di;
constexpr Floats df;
constexpr std::size_t lanes = hn::MaxLanes(d);
constexpr std::uint32_t page_size = GridStore::page_size;

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

/// Some records of a page.
struct Words {
    hn::Vec<Lanes> low, high;

    explicit Words(const GridRecord* records) {
        hn::Vec<Lanes> unused;
        hn::LoadInterleaved3(d, &records->low, low, high, unused);
    }

    /// Those that meet a box by the steps of both; never the places of a page that hold no box.
    template <int D>
    hn::Mask<Lanes> meet(const WordsInCell<D>& box) const {
        const auto guards = hn::Set(d, GridWords<D>::guards);
        const auto stay = hn::And(hn::Sub(high, hn::Set(d, box.low)), hn::Sub(hn::Set(d, box.high), low));
        return hn::Eq(hn::And(stay, guards), guards);
    }

    /// The steps along an axis, as numbers of fields.
    template <int D>
    static hn::Vec<Floats> field(hn::Vec<Lanes> words, std::size_t axis) {
        const int i = static_cast<int>(axis);
        const auto steps =
            hn::And(hn::ShiftRightSame(words, GridWords<D>::field_shift[axis]), hn::Set(d, GridWords<D>::most(i)));
        return hn::ConvertTo(df, hn::BitCast(di, steps));
    }
};

/// The length of a field along an axis.
template <int D>
double field_length(const GridBorders<D>& borders, std::size_t axis) {
    return borders.edge() / (GridWords<D>::most(static_cast<int>(axis)) + 1);
}

/// Rounded upwards; not so near the largest float that a square of less could be beyond it.
inline float not_less(double number) {
    return number < 1e37 ? static_cast<float>(number) * (1 + 1e-5f) + 1e-37f : std::numeric_limits<float>::infinity();
}

/// A ray on its way through one cell.
template <int D>
class RayInCell {
public:
    using Span = typename RayCells<D>::Span;

    RayInCell(const RayCells<D>& ray, const GridCells<D>& cells, const GridCell<D>& cell, const Span& span)
        : words_(steps(ray, cells, cell, span), cell), from_(span.from), to_(span.to) {
        for (std::size_t i = 0; i < D; ++i) {
            moves_[i] = ray.moves_along(i);
            if (!moves_[i]) continue;
            const double inverse = ray.inverse(i), step = field_length(ray.borders(), i) * inverse;
            const double begin = (ray.borders().border(i, cell[i]) - ray.origin(i)) * inverse - from_;
            const double edge = ray.borders().edge() * std::abs(inverse);
            const double slack = ray.doubt(i) * std::abs(inverse) + 1e-6 * (std::abs(begin) + edge) +
                                 1e-11 * (from_ + std::min(to_, 1e300));
            up_[i] = ray.goes_up(i);
            step_[i] = to_float(step);
            in_[i] = to_float((up_[i] ? begin : begin + step) - slack);
            out_[i] = to_float((up_[i] ? begin + step : begin) + slack);
        }
    }

    /// How far it goes from where it comes in, no less.
    float length(const RayReach<D>& reach) const { return not_less(std::min(to_, reach.reach()) - from_); }

    /// Which of these the ray may touch before `length`, and where it comes in at the earliest.
    std::uint32_t operator()(const Words& records, float length, float* measures) const {
        const auto met = records.meet<D>(words_);
        auto enters = hn::Zero(df), leaves = hn::Set(df, length);
        for (std::size_t i = 0; i < D; ++i) {
            if (!moves_[i]) continue;
            const auto low = Words::field<D>(records.low, i), high = Words::field<D>(records.high, i);
            const auto near = up_[i] ? low : high, far = up_[i] ? high : low;
            // What ends where the cell ends may go on, in the next cell or beyond the block.
            const float most = static_cast<float>(GridWords<D>::most(static_cast<int>(i)));
            const auto near_end = hn::Set(df, up_[i] ? 0.0f : most), far_end = hn::Set(df, up_[i] ? most : 0.0f);
            const auto step = hn::Set(df, step_[i]);
            const auto in = hn::Add(hn::Mul(near, step), hn::Set(df, in_[i]));
            const auto out = hn::Add(hn::Mul(far, step), hn::Set(df, out_[i]));
            enters = hn::IfThenElse(hn::Eq(near, near_end), enters, hn::Max(enters, in));
            leaves = hn::IfThenElse(hn::Eq(far, far_end), leaves, hn::Min(leaves, out));
        }
        hn::StoreU(enters, df, measures);
        return bits_of(hn::And(met, hn::RebindMask(d, hn::Le(enters, leaves))));
    }

private:
    /// Of the box around the way through the cell.
    static GridSteps<D> steps(const RayCells<D>& ray, const GridCells<D>& cells, const GridCell<D>& cell,
                              const Span& span) {
        GridSteps<D> result;
        for (std::size_t i = 0; i < D; ++i) {
            const Span place = ray.coordinates(i, span);
            const double base = ray.borders().border(i, cell[i]), scale = static_cast<double>(cells.scale);
            const auto step = [&](double coordinate) {
                const double steps = std::clamp((coordinate - base) * scale, 0.0, GridWords<D>::steps - 1.0);
                return (cell[i] << GridWords<D>::step_bits) + static_cast<std::uint32_t>(steps);
            };
            result.low[i] = step(place.from);
            result.high[i] = step(place.to);
        }
        return result;
    }

    WordsInCell<D> words_;
    double from_, to_;
    bool moves_[D], up_[D]{};
    float step_[D]{}, in_[D]{}, out_[D]{};  ///< distances along the ray from where it comes into the cell
};

/// A box as seen from a cell, for distances.
template <int D>
class BoxByCell {
public:
    BoxByCell(const BoxCells<D>& box, const GridCell<D>& cell) {
        for (std::size_t i = 0; i < D; ++i) {
            const GridBorders<D>& borders = box.borders();
            const double length = field_length(borders, i), base = borders.border(i, cell[i]);
            step_[i] = to_float(length);
            above_[i] = to_float(base - box.high(i) - box.doubt(i));
            below_[i] = to_float(box.low(i) - base - length - box.doubt(i));
            least_[i] = cell[i] == 0 ? 0.0f : -1.0f;
            const auto most = static_cast<float>(GridWords<D>::most(static_cast<int>(i)));
            most_[i] = cell[i] == borders.last(i) ? most : most + 1;
        }
    }

    static float length(const BoxReach<D>& reach) { return not_less(reach.most()); }

    /// Which of these may be nearer than the root of `most`, and how far away they are at least, squared. The places of
    /// a page that hold no box may be among them.
    std::uint32_t operator()(const Words& records, float most, float* measures) const {
        auto sum = hn::Zero(df);
        for (std::size_t i = 0; i < D; ++i) {
            const auto low = Words::field<D>(records.low, i), high = Words::field<D>(records.high, i);
            const auto step = hn::Set(df, step_[i]);
            const auto above = hn::Add(hn::Mul(low, step), hn::Set(df, above_[i]));
            const auto below = hn::Sub(hn::Set(df, below_[i]), hn::Mul(high, step));
            // What ends where the block ends may go on beyond.
            const auto gap = hn::Max(hn::IfThenElseZero(hn::Gt(low, hn::Set(df, least_[i])), above),
                                     hn::IfThenElseZero(hn::Lt(high, hn::Set(df, most_[i])), below));
            const auto positive = hn::Max(gap, hn::Zero(df));
            sum = hn::Add(sum, hn::Mul(positive, positive));
        }
        hn::StoreU(sum, df, measures);
        return bits_of(hn::RebindMask(d, hn::Le(sum, hn::Set(df, most))));
    }

private:
    float step_[D], above_[D], below_[D];
    float least_[D], most_[D];  ///< fields that tell where a box begins are more, those that tell where it ends less
};

/// Visits the items of a cell that are within reach and whose cell(range, measure) it is. False: the visitor has had
/// enough.
template <int D, class Reach, class InCell, class CellOf>
bool visit_cell(const GridItems<D>& items, const GridCell<D>& cell, Reach& reach, const InCell& query, CellOf cell_of,
                ReachCall visit) {
    float most = query.length(reach), measures[page_size];
    return items.store.each_page(items.cells.index(cell), [&](std::uint32_t first, std::uint32_t count) {
        const GridRecord* records = items.store.records.data() + first;
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < page_size; i += lanes) bits |= query(Words(records + i), most, measures + i) << i;
        bits &= (1u << count) - 1;
        while (bits != 0) {
            const std::uint32_t lane = next_lane(bits), item = records[lane].item;
            double measure = 0;
            if (measures[lane] > most || !reach.measure(items.boxes[item], measure)) continue;
            if (cell_of(items.cells.range(items.boxes[item]), measure) != cell) continue;
            reach.shrink(visit(item));
            if (reach.over()) return false;
            most = query.length(reach);
        }
        return true;
    });
}

template <int D>
void within(const GridItems<D>& items, RayReach<D> reach, ReachCall visit) {
    const RayCells<D> ray(items.cells, reach);
    ray.each(reach, [&](const GridCell<D>& cell, const typename RayCells<D>::Span& span) {
        if (items.store.is_empty(items.cells.index(cell))) return true;
        const RayInCell<D> query(ray, items.cells, cell, span);
        const auto cell_of = [&](const CellRange<D>& range, double enters) { return ray.entry(range, enters); };
        return visit_cell<D>(items, cell, reach, query, cell_of, visit);
    });
}

template <int D>
void within(const GridItems<D>& items, BoxReach<D> reach, ReachCall visit) {
    const BoxCells<D> box(items.cells, reach.box());
    box.each(reach, [&](const GridCell<D>& cell) {
        if (items.store.is_empty(items.cells.index(cell))) return true;
        const auto cell_of = [&](const CellRange<D>& range, double) { return box.nearest(range); };
        return visit_cell<D>(items, cell, reach, BoxByCell<D>(box, cell), cell_of, visit);
    });
}

template <int D>
void overlapping(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit) {
    const GridSteps<D> steps = items.cells.steps(box);
    each_cell<D>(items.cells.range(steps), [&](const GridCell<D>& cell) {
        // The flags of guests see to it that an item is told in the first cell that it shares with the box.
        const WordsInCell<D> own(steps, cell);
        return items.store.each_page(items.cells.index(cell), [&](std::uint32_t first, std::uint32_t) {
            const GridRecord* records = items.store.records.data() + first;
            std::uint32_t bits = 0;
            for (std::size_t i = 0; i < page_size; i += lanes)
                bits |= bits_of(Words(records + i).template meet<D>(own)) << i;
            while (bits != 0) {
                const GridRecord& record = records[next_lane(bits)];
                if (!GridWords<D>::surely_meet(own.low, own.high, record.low, record.high) &&
                    !overlaps(items.boxes[record.item], box))
                    continue;
                if (!visit(record.item)) return false;
            }
            return true;
        });
    });
}

// Names that a table of functions can be made of.
#define ABUT_FOR_DIMENSION(D)                                                              \
    void overlapping_##D(const GridItems<D>& items, const Aabb<D>& box, ItemCall visit) {  \
        overlapping(items, box, visit);                                                    \
    }                                                                                      \
    void along_##D(const GridItems<D>& items, const RayReach<D>& reach, ReachCall visit) { \
        within(items, reach, visit);                                                       \
    }                                                                                      \
    void near_##D(const GridItems<D>& items, const BoxReach<D>& reach, ReachCall visit) {  \
        within(items, reach, visit);                                                       \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

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

}  // namespace abut
#endif
