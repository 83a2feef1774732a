// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. What is
// written where doesn't depend on it.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/grid_jobs.hpp>
#include <abut/broad_phase/grid_store.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <mutex>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/grid_fill.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef ABUT_GRID_FILL_ONCE
#define ABUT_GRID_FILL_ONCE
namespace abut {

/// Boxes are looked at some at a time.
inline constexpr std::size_t grid_block = 256;

/// How boxes lie in their cells, one column of numbers each.
struct GridBlock {
    alignas(64) float low[4 * grid_block];   ///< rows of four, the last of which is of no use in 3D
    alignas(64) float high[4 * grid_block];  ///< rows of four, the first of which is of no use in 3D
    alignas(64) std::uint32_t cell[grid_block];
    alignas(64) std::uint32_t low_word[grid_block], high_word[grid_block];  ///< in the first cell
    alignas(64) std::uint32_t far_word[grid_block];                         ///< high word in the last cell
    alignas(64) std::uint32_t last_cell[grid_block];
    alignas(64) std::uint32_t kind[grid_block];  ///< the axes along which it touches two cells, or one of:
};
template <int D>
inline constexpr std::uint32_t wide_kind = 1u << D;
template <int D>
inline constexpr std::uint32_t empty_kind = (1u << D) + 1;

/// Some boxes, in the order of their numbers.
struct GridList {
    std::uint32_t length = 0;
    std::uint32_t item[grid_block];
};

/// The cells that a thread may write to.
struct GridPart {
    std::uint32_t begin, end;

    bool has(std::uint32_t cell) const { return begin <= cell && cell < end; }
};
/// All cells, in a few parts. A box that touches cells of a part has the bit of that part.
struct GridParts {
    static constexpr std::uint32_t most = 8;

    /// So many that no thread waits long for the last one, and no more: each has to look for its boxes.
    GridParts(std::uint32_t cells, std::uint32_t workers) : count(std::min(2 * workers, most)) {
        const auto cell = [&](std::uint64_t part) { return static_cast<std::uint32_t>(cells * part / count); };
        for (std::uint32_t i = 0; i < count; ++i) list[i] = {cell(i), cell(i + 1)};
    }

    std::uint32_t count;
    std::array<GridPart, most> list;
};

}  // namespace abut
#endif

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

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

void load(const Aabb<3>& box, std::size_t i, GridBlock& block) {
    // A box is six numbers: the last four begin with the last of its low side.
    std::memcpy(block.low + 4 * i, &box.min.x, 4 * sizeof(float));
    std::memcpy(block.high + 4 * i, &box.min.z, 4 * sizeof(float));
}
Coordinates coordinates(const Aabb<3>*, const GridBlock& block, std::size_t i) {
    Coordinates result;
    hn::Vec<Lanes> unused;
    hn::LoadInterleaved4(df, block.low + 4 * i, result.low[0], result.low[1], result.low[2], unused);
    hn::LoadInterleaved4(df, block.high + 4 * i, unused, result.high[0], result.high[1], result.high[2]);
    return result;
}
void load(const Aabb<2>& box, std::size_t i, GridBlock& block) {
    std::memcpy(block.low + 4 * i, &box.min.x, 4 * sizeof(float));
}
Coordinates coordinates(const Aabb<2>*, const GridBlock& block, std::size_t i) {
    Coordinates result;
    hn::LoadInterleaved4(df, block.low + 4 * i, result.low[0], result.low[1], result.high[0], result.high[1]);
    return result;
}

template <int D>
hn::Vec<Words> steps_of(const GridCells<D>& cells, std::size_t axis, hn::Vec<Lanes> coordinate) {
    const auto place = hn::Mul(hn::Sub(coordinate, hn::Set(df, cells.origin[axis])), hn::Set(df, cells.scale));
    const auto inside = hn::Min(hn::Max(place, hn::Zero(df)), hn::Set(df, cells.last[axis]));
    return hn::BitCast(du, hn::ConvertTo(di, inside));
}

/// As WordsInCell tells it of the first cell and of the last.
template <int D>
void place(const GridCells<D>& cells, std::size_t count, GridBlock& block) {
    using Word = GridWords<D>;
    const auto step_mask = hn::Set(du, Word::steps - 1), one = hn::Set(du, 1);
    for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
        const Coordinates at = coordinates(static_cast<const Aabb<D>*>(nullptr), block, i);
        auto cell = hn::Zero(du), last_cell = hn::Zero(du), low_word = hn::Zero(du), kind = hn::Zero(du),
             widest = hn::Zero(du);
        auto far_word = hn::Set(du, Word::guards);
        auto high_word = hn::Set(du, Word::guards | Word::flags(Word::all_axes));
        auto holds = hn::Le(at.low[0], at.high[0]);
        for (int axis = 0; axis < D; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            holds = hn::And(holds, hn::Le(at.low[a], at.high[a]));
            const auto low = steps_of(cells, a, at.low[a]), high = steps_of(cells, a, at.high[a]);
            const auto low_cell = hn::ShiftRight<Word::step_bits>(low), stride = hn::Set(du, cells.stride[a]);
            const auto high_cell = hn::ShiftRight<Word::step_bits>(high), span = hn::Sub(high_cell, low_cell);
            cell = hn::Add(cell, hn::Mul(low_cell, stride));
            last_cell = hn::Add(last_cell, hn::Mul(high_cell, stride));
            widest = hn::Max(widest, span);
            const auto spans = hn::Min(span, one);
            kind = hn::Add(kind, hn::ShiftLeftSame(spans, axis));
            const int drop = Word::step_bits - Word::field_bits[axis], shift = Word::field_shift[axis];
            const auto field = [&](auto step) {
                return hn::ShiftLeftSame(hn::ShiftRightSame(hn::And(step, step_mask), drop), shift);
            };
            const auto last = field(high), end = hn::Set(du, Word::most(axis) << shift);
            low_word = hn::Or(low_word, field(low));
            far_word = hn::Or(far_word, last);
            high_word = hn::Or(high_word, hn::IfThenElse(hn::Eq(spans, one), end, last));
        }
        kind = hn::IfThenElse(hn::Gt(widest, one), hn::Set(du, wide_kind<D>), kind);
        kind = hn::IfThenElse(hn::RebindMask(du, holds), kind, hn::Set(du, empty_kind<D>));
        hn::Store(cell, du, block.cell + i);
        hn::Store(last_cell, du, block.last_cell + i);
        hn::Store(low_word, du, block.low_word + i);
        hn::Store(high_word, du, block.high_word + i);
        hn::Store(far_word, du, block.far_word + i);
        hn::Store(kind, du, block.kind + i);
    }
}

template <int D>
void place_all(const GridCells<D>& cells, const Aabb<D>* boxes, std::size_t count, GridBlock& block, Aabb<D>* own) {
    for (std::size_t i = 0; i < count; ++i) {
        load(boxes[i], i, block);
        own[i] = boxes[i];
    }
    place(cells, count, block);
}
template <int D>
void place_list(const GridCells<D>& cells, const Aabb<D>* boxes, const GridList& list, GridBlock& block) {
    for (std::size_t i = 0; i < list.length; ++i) load(boxes[list.item[i]], i, block);
    place(cells, list.length, block);
}

/// The parts whose cells each box of a block touches, or perhaps touches where it lies in many cells.
void mark_parts(const GridParts& parts, std::size_t count, const GridBlock& block, std::uint8_t* marks) {
    alignas(64) std::uint32_t bits[grid_block];
    for (std::size_t i = 0; i < count; i += hn::Lanes(df)) {
        const auto first = hn::Load(du, block.cell + i), last = hn::Load(du, block.last_cell + i);
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

// Names that a table of functions can be made of.
#define ABUT_FOR_DIMENSION(D)                                                                                      \
    void place_all_##D(const GridCells<D>& cells, const Aabb<D>* boxes, std::size_t count, GridBlock& block,       \
                       Aabb<D>* own) {                                                                             \
        place_all(cells, boxes, count, block, own);                                                                \
    }                                                                                                              \
    void place_list_##D(const GridCells<D>& cells, const Aabb<D>* boxes, const GridList& list, GridBlock& block) { \
        place_list(cells, boxes, list, block);                                                                     \
    }
ABUT_FOR_DIMENSION(2)
ABUT_FOR_DIMENSION(3)
#undef ABUT_FOR_DIMENSION

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(place_all_2);
HWY_EXPORT(place_all_3);
HWY_EXPORT(place_list_2);
HWY_EXPORT(place_list_3);
HWY_EXPORT(mark_parts);

namespace {

template <int D>
void place_all(const GridCells<D>& cells, const Aabb<D>* boxes, std::size_t count, GridBlock& block, Aabb<D>* own) {
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(place_all_2)(cells, boxes, count, block, own);
    else
        HWY_DYNAMIC_DISPATCH(place_all_3)(cells, boxes, count, block, own);
}
template <int D>
void place_list(const GridCells<D>& cells, const Aabb<D>* boxes, const GridList& list, GridBlock& block) {
    if constexpr (D == 2)
        HWY_DYNAMIC_DISPATCH(place_list_2)(cells, boxes, list, block);
    else
        HWY_DYNAMIC_DISPATCH(place_list_3)(cells, boxes, list, block);
}

/// The numbers of the boxes of a block, by kind. Each list has room for all, as nobody could guess the next one's kind.
template <int D>
struct Kinds {
    static constexpr std::size_t count = empty_kind<D> + 1;
    std::uint32_t length[count] = {};
    std::uint32_t list[count][grid_block];

    Kinds(const GridBlock& block, std::size_t boxes) {
        for (std::size_t i = 0; i < boxes; ++i) {
            const std::uint32_t kind = block.kind[i];
            list[kind][length[kind]++] = static_cast<std::uint32_t>(i);
        }
    }
    std::span<const std::uint32_t> of(std::uint32_t kind) const { return {list[kind], length[kind]}; }
};

/// Writes boxes into the cells of a part.
template <int D>
class Filler {
public:
    Filler(const GridCells<D>& cells, GridPart part, GridStore& store) : cells_(cells), part_(part), store_(store) {}

    /// `items` are the numbers of the boxes that are placed in the block; tells those that lie in too many cells.
    template <class Items, class TellLarge>
    void add(const GridBlock& block, const Kinds<D>& kinds, const Aabb<D>* boxes, Items items, TellLarge tell_large) {
        for (std::uint32_t kind = 0; kind <= GridWords<D>::all_axes; ++kind)
            for (std::uint32_t axes = 0; axes <= kind; ++axes)
                if ((axes & ~kind) == 0) add_beyond(block, kinds.of(kind), axes, items);
        for (const std::uint32_t i : kinds.of(wide_kind<D>)) {
            const GridSteps<D> steps = cells_.steps(boxes[items(i)]);
            const CellRange<D> range = cells_.range(steps);
            if (fits_in_cells(range))
                add_wide(steps, range, items(i));
            else if (part_.has(block.cell[i]))
                tell_large(items(i));
        }
    }

private:
    /// Adds the boxes of a list to the cells that lie one farther along some axes.
    template <class Items>
    void add_beyond(const GridBlock& block, std::span<const std::uint32_t> list, std::uint32_t axes, Items items) {
        using Words = GridWords<D>;
        std::uint32_t offset = 0;
        for (std::size_t i = 0; i < D; ++i) offset += (axes >> i & 1) * cells_.stride[i];
        const std::uint32_t fields = Words::fields(axes), flags = Words::flags(axes);
        for (const std::uint32_t i : list) {
            const std::uint32_t cell = block.cell[i] + offset;
            if (!part_.has(cell)) continue;
            store_.add(cell, (block.low_word[i] & ~fields) | flags,
                       (block.high_word[i] & ~(fields | flags)) | (block.far_word[i] & fields), items(i));
        }
    }
    void add_wide(const GridSteps<D>& steps, const CellRange<D>& range, std::uint32_t item) {
        each_cell<D>(range, [&](const std::array<std::uint32_t, D>& at) {
            const std::uint32_t cell = cells_.index(at);
            const WordsInCell<D> words(steps, at);
            if (part_.has(cell)) store_.add(cell, words.low, words.high, item);
            return true;
        });
    }

    const GridCells<D>& cells_;
    GridPart part_;
    GridStore& store_;
};

void clear(GridBlock& block) {
    std::memset(block.low, 0, sizeof block.low);
    std::memset(block.high, 0, sizeof block.high);
}

template <int D>
void fill_alone(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
                std::vector<std::uint32_t>& large) {
    GridBlock block;
    clear(block);
    Filler<D> filler(cells, {0, cells.total}, store);
    for (std::size_t begin = 0; begin < boxes.size() && !store.is_full(); begin += grid_block) {
        const std::size_t count = std::min(grid_block, boxes.size() - begin);
        const auto first = static_cast<std::uint32_t>(begin);
        place_all(cells, &boxes[begin], count, block, own + begin);
        const Kinds<D> kinds(block, count);
        filler.add(
            block, kinds, own, [first](std::uint32_t i) { return first + i; },
            [&large](std::uint32_t item) { large.push_back(item); });
        for (const std::uint32_t i : kinds.of(empty_kind<D>)) own[first + i] = usable(boxes[first + i]);
    }
}

/// First each box is copied, and marked with the parts of the cells that it touches; then each part is filled by one
/// thread, in the same order as by a single one.
template <int D>
void fill_together(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
                   std::vector<std::uint32_t>& large, std::uint8_t* marks, Executor& executor) {
    const GridParts parts(cells.total, executor.workers());
    const std::size_t blocks = (boxes.size() + grid_block - 1) / grid_block;
    executor.run(parts_of_job, [&](std::uint32_t job) {
        GridBlock block;
        clear(block);
        const auto [begin_block, end_block] = part_of(blocks, job);
        for (std::size_t begin = begin_block * grid_block; begin < std::min(end_block * grid_block, boxes.size());
             begin += grid_block) {
            const std::size_t count = std::min(grid_block, boxes.size() - begin);
            place_all(cells, &boxes[begin], count, block, own + begin);
            HWY_DYNAMIC_DISPATCH(mark_parts)(parts, count, block, marks + begin);
            for (std::size_t i = 0; i < count; ++i) {
                if (block.kind[i] != empty_kind<D>) continue;
                own[begin + i] = usable(boxes[begin + i]);
                marks[begin + i] = 0;
            }
        }
    });
    std::mutex large_at_once;
    executor.run(parts.count, [&](std::uint32_t job) {
        GridBlock block;
        clear(block);
        GridList list;
        Filler<D> filler(cells, parts.list[job], store);
        for (std::size_t begin = 0; begin < boxes.size() && !store.is_full(); begin += grid_block) {
            const std::size_t end = std::min(begin + grid_block, boxes.size());
            std::uint32_t length = 0;
            for (std::size_t i = begin; i < end; ++i) {
                list.item[length] = static_cast<std::uint32_t>(i);
                length += marks[i] >> job & 1u;
            }
            list.length = length;
            place_list(cells, own, list, block);
            const Kinds<D> kinds(block, list.length);
            filler.add(
                block, kinds, own, [&list](std::uint32_t i) { return list.item[i]; },
                [&](std::uint32_t item) {
                    const std::lock_guard lock(large_at_once);
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
    if (executor == nullptr || boxes.size() < grid_few)
        fill_alone(cells, boxes, own, store, large);
    else
        fill_together(cells, boxes, own, store, large, marks, *executor);
}

template void fill(const GridCells<2>&, std::span<const Aabb<2>>, Aabb<2>*, GridStore&, std::vector<std::uint32_t>&,
                   std::uint8_t*, Executor*);
template void fill(const GridCells<3>&, std::span<const Aabb<3>>, Aabb<3>*, GridStore&, std::vector<std::uint32_t>&,
                   std::uint8_t*, Executor*);

}  // namespace abut
#endif
