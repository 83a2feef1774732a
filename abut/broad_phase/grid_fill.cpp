// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. What is
// written where doesn't depend on it.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/grid_store.hpp>

#include <algorithm>
#include <cstring>

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
    alignas(64) std::uint32_t kind[grid_block];  ///< the axes along which it touches two cells, or one of:
};
template <int D>
inline constexpr std::uint32_t wide_kind = 1u << D;
template <int D>
inline constexpr std::uint32_t empty_kind = (1u << D) + 1;

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

void load(const Aabb<3>* boxes, std::size_t count, GridBlock& block, Aabb<3>* own) {
    for (std::size_t i = 0; i < count; ++i) {
        // A box is six numbers: the last four begin with the last of its low side.
        std::memcpy(block.low + 4 * i, &boxes[i].min.x, 4 * sizeof(float));
        std::memcpy(block.high + 4 * i, &boxes[i].min.z, 4 * sizeof(float));
        own[i] = boxes[i];
    }
}
Coordinates coordinates(const Aabb<3>*, const GridBlock& block, std::size_t i) {
    Coordinates result;
    hn::Vec<Lanes> unused;
    hn::LoadInterleaved4(df, block.low + 4 * i, result.low[0], result.low[1], result.low[2], unused);
    hn::LoadInterleaved4(df, block.high + 4 * i, unused, result.high[0], result.high[1], result.high[2]);
    return result;
}
void load(const Aabb<2>* boxes, std::size_t count, GridBlock& block, Aabb<2>* own) {
    for (std::size_t i = 0; i < count; ++i) {
        std::memcpy(block.low + 4 * i, &boxes[i].min.x, 4 * sizeof(float));
        own[i] = boxes[i];
    }
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
        auto cell = hn::Zero(du), low_word = hn::Zero(du), kind = hn::Zero(du), widest = hn::Zero(du);
        auto far_word = hn::Set(du, Word::guards);
        auto high_word = hn::Set(du, Word::guards | Word::flags(Word::all_axes));
        auto holds = hn::Le(at.low[0], at.high[0]);
        for (int axis = 0; axis < D; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            holds = hn::And(holds, hn::Le(at.low[a], at.high[a]));
            const auto low = steps_of(cells, a, at.low[a]), high = steps_of(cells, a, at.high[a]);
            const auto low_cell = hn::ShiftRight<Word::step_bits>(low);
            const auto span = hn::Sub(hn::ShiftRight<Word::step_bits>(high), low_cell);
            cell = hn::Add(cell, hn::Mul(low_cell, hn::Set(du, cells.stride[a])));
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
        hn::Store(low_word, du, block.low_word + i);
        hn::Store(high_word, du, block.high_word + i);
        hn::Store(far_word, du, block.far_word + i);
        hn::Store(kind, du, block.kind + i);
    }
}

void place_block2(const GridCells<2>& cells, const Aabb<2>* boxes, std::size_t count, GridBlock& block, Aabb<2>* own) {
    load(boxes, count, block, own);
    place(cells, count, block);
}
void place_block3(const GridCells<3>& cells, const Aabb<3>* boxes, std::size_t count, GridBlock& block, Aabb<3>* own) {
    load(boxes, count, block, own);
    place(cells, count, block);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(place_block2);
HWY_EXPORT(place_block3);

namespace {

void place_block(const GridCells<2>& cells, const Aabb<2>* boxes, std::size_t count, GridBlock& block, Aabb<2>* own) {
    HWY_DYNAMIC_DISPATCH(place_block2)(cells, boxes, count, block, own);
}
void place_block(const GridCells<3>& cells, const Aabb<3>* boxes, std::size_t count, GridBlock& block, Aabb<3>* own) {
    HWY_DYNAMIC_DISPATCH(place_block3)(cells, boxes, count, block, own);
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

/// Adds the boxes of a list to the cells that lie one farther along some axes.
template <int D>
void add_beyond(const GridCells<D>& cells, const GridBlock& block, std::span<const std::uint32_t> list,
                std::uint32_t axes, std::uint32_t first, GridStore& store) {
    using Words = GridWords<D>;
    std::uint32_t offset = 0;
    for (std::size_t i = 0; i < D; ++i) offset += (axes >> i & 1) * cells.stride[i];
    const std::uint32_t fields = Words::fields(axes), flags = Words::flags(axes);
    for (const std::uint32_t i : list)
        store.add(block.cell[i] + offset, (block.low_word[i] & ~fields) | flags,
                  (block.high_word[i] & ~(fields | flags)) | (block.far_word[i] & fields), first + i);
}

template <int D>
void add_wide(const GridCells<D>& cells, const Aabb<D>& box, std::uint32_t item, GridStore& store,
              std::vector<std::uint32_t>& large) {
    const GridSteps<D> steps = cells.steps(box);
    const CellRange<D> range = cells.range(steps);
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < D; ++i) count *= range.high[i] - range.low[i] + 1;
    if (count > most_cells_of_a_box<D>) {
        large.push_back(item);
        return;
    }
    each_cell<D>(range, [&](const std::array<std::uint32_t, D>& cell) {
        const WordsInCell<D> words(steps, cell);
        store.add(cells.index(cell), words.low, words.high, item);
        return true;
    });
}

}  // namespace

template <int D>
void fill(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
          std::vector<std::uint32_t>& large) {
    GridBlock block;
    std::memset(block.low, 0, sizeof block.low);
    std::memset(block.high, 0, sizeof block.high);
    for (std::size_t begin = 0; begin < boxes.size() && !store.is_full; begin += grid_block) {
        const std::size_t count = std::min(grid_block, boxes.size() - begin);
        const auto first = static_cast<std::uint32_t>(begin);
        place_block(cells, &boxes[begin], count, block, own + begin);
        const Kinds<D> kinds(block, count);
        for (std::uint32_t kind = 0; kind <= GridWords<D>::all_axes; ++kind)
            for (std::uint32_t axes = 0; axes <= kind; ++axes)
                if ((axes & ~kind) == 0) add_beyond(cells, block, kinds.of(kind), axes, first, store);
        for (const std::uint32_t i : kinds.of(wide_kind<D>)) add_wide(cells, boxes[first + i], first + i, store, large);
        for (const std::uint32_t i : kinds.of(empty_kind<D>)) own[first + i] = usable(boxes[first + i]);
    }
}

template void fill(const GridCells<2>&, std::span<const Aabb<2>>, Aabb<2>*, GridStore&, std::vector<std::uint32_t>&);
template void fill(const GridCells<3>&, std::span<const Aabb<3>>, Aabb<3>*, GridStore&, std::vector<std::uint32_t>&);

}  // namespace abut
#endif
