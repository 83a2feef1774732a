// Highway compiles this file once for each SIMD target and dispatches at run time. The result doesn't depend on the
// target.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/grid/parallel_parts.hpp>
#include <abut/broad_phase/grid/store.hpp>
#include <abut/math/detail/mutex.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <algorithm>
#include <array>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/grid/fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef ABUT_GRID_FILL_ONCE
#define ABUT_GRID_FILL_ONCE
namespace abut::detail {

/// The number of boxes that are quantised at a time.
inline constexpr std::size_t grid_batch_size = 256;

/// A batch of boxes and their packed bounds, as a structure of arrays.
struct BoxBatch {
    alignas(64) float low[4 * grid_batch_size];   ///< four floats a box; in 3D the last is unused
    alignas(64) float high[4 * grid_batch_size];  ///< four floats a box; in 3D the first is unused
    alignas(64) std::uint32_t cell[grid_batch_size];
    alignas(64) std::uint32_t low_word[grid_batch_size], high_word[grid_batch_size];  ///< in its first cell
    alignas(64) std::uint32_t far_word[grid_batch_size];  ///< the high word in its last cell
    alignas(64) std::uint32_t last_cell[grid_batch_size];
    alignas(
        64) std::uint32_t kind[grid_batch_size];  ///< the axes along which it touches two cells, or a constant below
};
/// The kind of boxes that touch more than two cells along an axis.
template <int D>
inline constexpr std::uint32_t wide_kind = 1u << D;
template <int D>
inline constexpr std::uint32_t empty_kind = (1u << D) + 1;

/// The indices of some boxes, in ascending order.
struct ItemList {
    std::uint32_t length = 0;
    std::uint32_t item[grid_batch_size];
};

/// A range of cells that one thread fills.
struct CellPart {
    std::uint32_t begin, end;

    bool contains(std::uint32_t cell) const { return begin <= cell && cell < end; }
};
/// All cells, divided into a few parts. Each part has a bit, which marks the boxes that touch its cells.
struct CellParts {
    static constexpr std::uint32_t max_count = 8;

    /// Two parts a thread balance the load. More would cost more, for each part searches all marks for its boxes.
    CellParts(std::uint32_t cells, std::uint32_t workers) : count(std::min(2 * workers, max_count)) {
        const auto cell = [&](std::uint64_t part) { return static_cast<std::uint32_t>(cells * part / count); };
        for (std::uint32_t i = 0; i < count; ++i) list[i] = {cell(i), cell(i + 1)};
    }

    std::uint32_t count;
    std::array<CellPart, max_count> list;
};

}  // namespace abut::detail
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<float, 16>;
using Numbers = hn::RebindToSigned<Lanes>;
using Words = hn::RebindToUnsigned<Lanes>;
constexpr Lanes df;
constexpr Numbers di;
constexpr Words du;

/// The coordinates of boxes i to i + lanes - 1 along all axes.
struct Coordinates {
    hn::Vec<Lanes> low[3], high[3];
};

void load(const Aabb<3>& box, std::size_t i, BoxBatch& batch) {
    // A box is six consecutive floats: the last four begin with min.z.
    std::memcpy(batch.low + 4 * i, &box.min.x, 4 * sizeof(float));
    std::memcpy(batch.high + 4 * i, &box.min.z, 4 * sizeof(float));
}
Coordinates coordinates(const Aabb<3>*, const BoxBatch& batch, std::size_t i) {
    Coordinates result;
    hn::Vec<Lanes> unused;
    hn::LoadInterleaved4(df, batch.low + 4 * i, result.low[0], result.low[1], result.low[2], unused);
    hn::LoadInterleaved4(df, batch.high + 4 * i, unused, result.high[0], result.high[1], result.high[2]);
    return result;
}
void load(const Aabb<2>& box, std::size_t i, BoxBatch& batch) {
    std::memcpy(batch.low + 4 * i, &box.min.x, 4 * sizeof(float));
}
Coordinates coordinates(const Aabb<2>*, const BoxBatch& batch, std::size_t i) {
    Coordinates result;
    hn::LoadInterleaved4(df, batch.low + 4 * i, result.low[0], result.low[1], result.high[0], result.high[1]);
    return result;
}

template <int D>
hn::Vec<Words> steps_of(const GridCells<D>& cells, std::size_t axis, hn::Vec<Lanes> coordinate) {
    const auto position = hn::Mul(hn::Sub(coordinate, hn::Set(df, cells.origin[axis])), hn::Set(df, cells.scale));
    const auto inside = hn::Min(hn::Max(position, hn::Zero(df)), hn::Set(df, cells.last[axis]));
    return hn::BitCast(du, hn::ConvertTo(di, inside));
}

/// Packs a batch of boxes: the SIMD form of PackedBox for the first and the last cell of each.
template <int D>
void pack(const GridCells<D>& cells, std::size_t count, BoxBatch& batch) {
    using Packing = PackedBounds<D>;
    const auto step_mask = hn::Set(du, Packing::steps - 1), one = hn::Set(du, 1);
    for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
        const Coordinates at = coordinates(static_cast<const Aabb<D>*>(nullptr), batch, i);
        auto cell = hn::Zero(du), last_cell = hn::Zero(du), low_word = hn::Zero(du), kind = hn::Zero(du),
             widest = hn::Zero(du);
        auto far_word = hn::Set(du, Packing::guards);
        auto high_word = hn::Set(du, Packing::guards | Packing::flags(Packing::all_axes));
        auto is_valid = hn::Le(at.low[0], at.high[0]);
        for (int axis = 0; axis < D; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            is_valid = hn::And(is_valid, hn::Le(at.low[a], at.high[a]));
            const auto low = steps_of(cells, a, at.low[a]), high = steps_of(cells, a, at.high[a]);
            const auto low_cell = hn::ShiftRight<Packing::step_bits>(low), stride = hn::Set(du, cells.stride[a]);
            const auto high_cell = hn::ShiftRight<Packing::step_bits>(high), span = hn::Sub(high_cell, low_cell);
            cell = hn::Add(cell, hn::Mul(low_cell, stride));
            last_cell = hn::Add(last_cell, hn::Mul(high_cell, stride));
            widest = hn::Max(widest, span);
            const auto spans = hn::Min(span, one);
            kind = hn::Add(kind, hn::ShiftLeftSame(spans, axis));
            const int drop = Packing::step_bits - Packing::field_bits[axis], shift = Packing::field_shift[axis];
            const auto field = [&](auto step) {
                return hn::ShiftLeftSame(hn::ShiftRightSame(hn::And(step, step_mask), drop), shift);
            };
            const auto last = field(high), end = hn::Set(du, Packing::max_field(axis) << shift);
            low_word = hn::Or(low_word, field(low));
            far_word = hn::Or(far_word, last);
            high_word = hn::Or(high_word, hn::IfThenElse(hn::Eq(spans, one), end, last));
        }
        kind = hn::IfThenElse(hn::Gt(widest, one), hn::Set(du, wide_kind<D>), kind);
        kind = hn::IfThenElse(hn::RebindMask(du, is_valid), kind, hn::Set(du, empty_kind<D>));
        hn::Store(cell, du, batch.cell + i);
        hn::Store(last_cell, du, batch.last_cell + i);
        hn::Store(low_word, du, batch.low_word + i);
        hn::Store(high_word, du, batch.high_word + i);
        hn::Store(far_word, du, batch.far_word + i);
        hn::Store(kind, du, batch.kind + i);
    }
}

template <int D>
void pack_all(const GridCells<D>& cells, const Aabb<D>* boxes, std::size_t count, BoxBatch& batch, Aabb<D>* own) {
    for (std::size_t i = 0; i < count; ++i) {
        load(boxes[i], i, batch);
        own[i] = boxes[i];
    }
    pack(cells, count, batch);
}
template <int D>
void pack_list(const GridCells<D>& cells, const Aabb<D>* boxes, const ItemList& list, BoxBatch& batch) {
    for (std::size_t i = 0; i < list.length; ++i) load(boxes[list.item[i]], i, batch);
    pack(cells, list.length, batch);
}

/// Marks each box of a batch with the parts whose cells it touches. The test is conservative for boxes in many cells.
void mark_parts(const CellParts& parts, std::size_t count, const BoxBatch& batch, std::uint8_t* marks) {
    alignas(64) std::uint32_t bits[grid_batch_size];
    for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
        const auto first = hn::Load(du, batch.cell + i), last = hn::Load(du, batch.last_cell + i);
        auto touched = hn::Zero(du);
        for (std::uint32_t part = 0; part < parts.count; ++part) {
            const auto begins_before = hn::Lt(first, hn::Set(du, parts.list[part].end));
            const auto ends_before = hn::Lt(last, hn::Set(du, parts.list[part].begin));
            touched =
                hn::Or(touched, hn::IfThenElseZero(hn::AndNot(ends_before, begins_before), hn::Set(du, 1u << part)));
        }
        hn::Store(touched, du, bits + i);
    }
    for (std::size_t i = 0; i < count; ++i) marks[i] = static_cast<std::uint8_t>(bits[i]);
}

ABUT_NAME_DIMENSIONS(pack_all);
ABUT_NAME_DIMENSIONS(pack_list);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(pack_all);
ABUT_EXPORT_DIMENSIONS(pack_list);
HWY_EXPORT(mark_parts);

namespace {

/// The boxes of a batch, grouped by kind. Each list has capacity for the whole batch, so that adding needs no branch.
template <int D>
struct BoxesByKind {
    static constexpr std::size_t count = empty_kind<D> + 1;
    std::uint32_t length[count] = {};
    std::uint32_t list[count][grid_batch_size];

    BoxesByKind(const BoxBatch& batch, std::size_t boxes) {
        for (std::size_t i = 0; i < boxes; ++i) {
            const std::uint32_t kind = batch.kind[i];
            list[kind][length[kind]++] = static_cast<std::uint32_t>(i);
        }
    }
    std::span<const std::uint32_t> of(std::uint32_t kind) const { return {list[kind], length[kind]}; }
};

/// Adds boxes to the cells of a part.
template <int D>
class CellFiller {
public:
    CellFiller(const GridCells<D>& cells, CellPart part, GridStore& store)
        : cells_(cells), part_(part), store_(store) {}

    /// Adds the boxes of a batch; items(i) is the index of box i. Reports those that touch too many cells.
    template <class Items, class ReportLarge>
    void add(const BoxBatch& batch, const BoxesByKind<D>& kinds, const Aabb<D>* boxes, Items items,
             ReportLarge report_large) {
        for (std::uint32_t kind = 0; kind <= PackedBounds<D>::all_axes; ++kind)
            for (std::uint32_t axes = 0; axes <= kind; ++axes)
                if ((axes & ~kind) == 0) add_offset(batch, kinds.of(kind), axes, items);
        for (const std::uint32_t i : kinds.of(wide_kind<D>)) {
            const QuantisedBox<D> box = cells_.quantised(boxes[items(i)]);
            const CellRange<D> range = cells_.range(box);
            if (fits_in_cells(range))
                add_wide(box, range, items(i));
            else if (part_.contains(batch.cell[i]))
                report_large(items(i));
        }
    }

private:
    /// Adds the boxes of a list to the cells that follow their first cells along `axes`.
    template <class Items>
    void add_offset(const BoxBatch& batch, std::span<const std::uint32_t> list, std::uint32_t axes, Items items) {
        using Packing = PackedBounds<D>;
        std::uint32_t offset = 0;
        for (std::size_t i = 0; i < D; ++i) offset += (axes >> i & 1) * cells_.stride[i];
        const std::uint32_t fields = Packing::fields(axes), flags = Packing::flags(axes);
        for (const std::uint32_t i : list) {
            const std::uint32_t cell = batch.cell[i] + offset;
            if (!part_.contains(cell)) continue;
            store_.add(cell, (batch.low_word[i] & ~fields) | flags,
                       (batch.high_word[i] & ~(fields | flags)) | (batch.far_word[i] & fields), items(i));
        }
    }
    void add_wide(const QuantisedBox<D>& box, const CellRange<D>& range, std::uint32_t item) {
        each_cell<D>(range, [&](const std::array<std::uint32_t, D>& at) {
            const std::uint32_t cell = cells_.index(at);
            const PackedBox<D> packed(box, at);
            if (part_.contains(cell)) store_.add(cell, packed.low, packed.high, item);
            return true;
        });
    }

    const GridCells<D>& cells_;
    CellPart part_;
    GridStore& store_;
};

void clear(BoxBatch& batch) {
    std::memset(batch.low, 0, sizeof batch.low);
    std::memset(batch.high, 0, sizeof batch.high);
}

template <int D>
void fill_serial(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
                 std::vector<std::uint32_t>& large) {
    BoxBatch batch;
    clear(batch);
    CellFiller<D> filler(cells, {0, cells.total}, store);
    for (std::size_t begin = 0; begin < boxes.size() && !store.is_full(); begin += grid_batch_size) {
        const std::size_t count = std::min(grid_batch_size, boxes.size() - begin);
        const auto first = static_cast<std::uint32_t>(begin);
        dispatched_pack_all<D>()(cells, &boxes[begin], count, batch, own + begin);
        const BoxesByKind<D> kinds(batch, count);
        filler.add(
            batch, kinds, own, [first](std::uint32_t i) { return first + i; },
            [&large](std::uint32_t item) { large.push_back(item); });
        for (const std::uint32_t i : kinds.of(empty_kind<D>)) own[first + i] = usable(boxes[first + i]);
    }
}

/// First copies each box and marks it with the parts whose cells it touches. Then one thread fills each part, in the
/// same order as `fill_serial`.
template <int D>
void fill_parallel(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
                   std::vector<std::uint32_t>& large, std::uint8_t* marks, Executor& executor) {
    const CellParts parts(cells.total, executor.workers());
    const std::size_t batches = (boxes.size() + grid_batch_size - 1) / grid_batch_size;
    executor.run(part_count, [&](std::uint32_t job) {
        BoxBatch batch;
        clear(batch);
        const auto [begin_batch, end_batch] = range_of_part(batches, job);
        for (std::size_t begin = begin_batch * grid_batch_size;
             begin < std::min(end_batch * grid_batch_size, boxes.size()); begin += grid_batch_size) {
            const std::size_t count = std::min(grid_batch_size, boxes.size() - begin);
            dispatched_pack_all<D>()(cells, &boxes[begin], count, batch, own + begin);
            HWY_DYNAMIC_DISPATCH(mark_parts)(parts, count, batch, marks + begin);
            for (std::size_t i = 0; i < count; ++i) {
                if (batch.kind[i] != empty_kind<D>) continue;
                own[begin + i] = usable(boxes[begin + i]);
                marks[begin + i] = 0;
            }
        }
    });
    Mutex large_mutex;
    executor.run(parts.count, [&](std::uint32_t job) {
        BoxBatch batch;
        clear(batch);
        ItemList list;
        CellFiller<D> filler(cells, parts.list[job], store);
        for (std::size_t begin = 0; begin < boxes.size() && !store.is_full(); begin += grid_batch_size) {
            const std::size_t end = std::min(begin + grid_batch_size, boxes.size());
            std::uint32_t length = 0;
            for (std::size_t i = begin; i < end; ++i) {
                list.item[length] = static_cast<std::uint32_t>(i);
                length += marks[i] >> job & 1u;
            }
            list.length = length;
            dispatched_pack_list<D>()(cells, own, list, batch);
            const BoxesByKind<D> kinds(batch, list.length);
            filler.add(
                batch, kinds, own, [&list](std::uint32_t i) { return list.item[i]; },
                [&](std::uint32_t item) {
                    const Lock lock(large_mutex);
                    large.push_back(item);
                });
        }
    });
    std::sort(large.begin(), large.end());
}

}  // namespace

template <int D>
void fill(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
          std::vector<std::uint32_t>& large, std::uint8_t* marks, Executor* executor) {
    if (executor == nullptr || boxes.size() < grid_min_parallel_count)
        fill_serial(cells, boxes, own, store, large);
    else
        fill_parallel(cells, boxes, own, store, large, marks, *executor);
}

template void fill(const GridCells<2>&, std::span<const Aabb<2>>, Aabb<2>*, GridStore&, std::vector<std::uint32_t>&,
                   std::uint8_t*, Executor*);
template void fill(const GridCells<3>&, std::span<const Aabb<3>>, Aabb<3>*, GridStore&, std::vector<std::uint32_t>&,
                   std::uint8_t*, Executor*);

}  // namespace abut::detail
#endif
