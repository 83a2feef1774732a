// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs. The pairs
// come in the same order from all of them: which of two lists is gone through one by one depends on their lengths
// alone, and what one meets in the other comes in the order of the other.

#include <abut/broad_phase/layered_pairs.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/layered_pairs.cpp"
#include <algorithm>

#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, 16>;
using Vector = hn::Vec<Lanes>;
constexpr Lanes d;
constexpr std::uint32_t lanes = static_cast<std::uint32_t>(hn::MaxLanes(d));
constexpr std::uint32_t block_size = 256;

/// Some of the boxes in a cell, as words of its CellFormat. Behind them are some that meet nothing.
struct Block {
    HWY_ALIGN std::uint32_t low[block_size + 16];
    HWY_ALIGN std::uint32_t high[block_size + 16];
    HWY_ALIGN std::uint32_t place[block_size + 16];
    std::uint32_t count;
};

/// Pairs that meet as words, by their numbers in two blocks.
struct Meetings {
    static constexpr std::uint32_t room = 1024;
    std::uint32_t one[room + block_size + 16];
    std::uint32_t other[room + block_size + 16];
    std::uint32_t count = 0;
};

template <int D>
class CellPairs {
public:
    using Format = CellFormat<D>;

    CellPairs(const LayeredItems<D>& items, const LayeredPlan<D>& plan, PairBuffer& pairs)
        : items_(items), plan_(plan), pairs_(pairs) {}

    bool of_cell(std::uint32_t number) {
        const LayeredCell& cell = items_.cells[number];
        const std::uint32_t count = cell.residents + cell.guests;
        for (std::uint32_t from = 0; from < count; from += block_size) {
            load(cell, from, own_);
            if (!within_own()) return false;
            for (std::uint32_t behind = from + block_size; behind < count; behind += block_size) {
                load(cell, behind, other_);
                if (!between(own_, other_)) return false;
            }
            for (std::uint32_t parent = cell.parent; parent != no_cell; parent = items_.cells[parent].parent)
                if (!with_cell_around(cell, items_.cells[parent])) return false;
        }
        return true;
    }

private:
    /// What the cell holds, from its number `from` on, residents first.
    void load(const LayeredCell& cell, std::uint32_t from, Block& block) {
        std::uint32_t count = 0;
        if (from < cell.residents) {
            count = std::min(cell.residents - from, block_size);
            const std::uint32_t first = cell.first + from;
            for (std::uint32_t i = 0; i < count; i += lanes)
                hn::StoreU(hn::Add(hn::Iota(d, i), hn::Set(d, first)), d, block.place + i);
            copy(items_.low.data() + first, count, block.low);
            copy(items_.high.data() + first, count, block.high);
        }
        const std::uint32_t skipped = from + count - cell.residents;
        const std::uint32_t guests = std::min(cell.guests - skipped, block_size - count);
        copy(items_.guest_low.data() + cell.first_guest + skipped, guests, block.low + count);
        copy(items_.guest_high.data() + cell.first_guest + skipped, guests, block.high + count);
        copy(items_.guest_place.data() + cell.first_guest + skipped, guests, block.place + count);
        block.count = count + guests;
        close(block);
    }
    static void copy(const std::uint32_t* from, std::uint32_t count, std::uint32_t* to) {
        for (std::uint32_t i = 0; i < count; ++i) to[i] = from[i];
    }
    /// No box begins as far up as these, and none that begins at 0 gets so far.
    static void close(Block& block) {
        for (std::uint32_t i = 0; i < 16; i += lanes) {
            hn::StoreU(hn::Set(d, CellWords<D>::guards - CellWords<D>::ones), d, block.low + block.count + i);
            hn::StoreU(hn::Set(d, CellWords<D>::guards), d, block.high + block.count + i);
        }
    }

    /// Finds which of a block, from `first` on, meet a box. They must not both be guests along the same axis: such a
    /// pair meets in the cell before as well.
    void meet(std::uint32_t low, std::uint32_t high, std::uint32_t number, const Block& block, std::uint32_t first) {
        const Vector box_low = hn::Set(d, low), box_high = hn::Set(d, high), box_number = hn::Set(d, number);
        const Vector guards = hn::Set(d, CellWords<D>::guards), flags = hn::Set(d, low & Format::flags);
        for (std::uint32_t i = first; i < block.count; i += lanes) {
            const Vector other_low = hn::LoadU(d, block.low + i), other_high = hn::LoadU(d, block.high + i);
            const Vector reached = hn::And(hn::Sub(box_high, other_low), hn::Sub(other_high, box_low));
            const Vector wrong = hn::Or(hn::AndNot(reached, guards), hn::And(flags, other_low));
            const auto meets = hn::Eq(wrong, hn::Zero(d));
            hn::StoreU(hn::Compress(hn::Iota(d, i), meets), d, meetings_.other + meetings_.count);
            hn::StoreU(box_number, d, meetings_.one + meetings_.count);
            meetings_.count += static_cast<std::uint32_t>(hn::CountTrue(d, meets));
        }
    }

    bool within_own() {
        for (std::uint32_t i = 0; i + 1 < own_.count; ++i) {
            meet(own_.low[i], own_.high[i], i, own_, i + 1);
            if (meetings_.count > Meetings::room && !tell(own_, own_)) return false;
        }
        return tell(own_, own_);
    }

    bool between(const Block& a, const Block& b) {
        const Block& one = a.count < b.count ? a : b;
        const Block& other = a.count < b.count ? b : a;
        for (std::uint32_t i = 0; i < one.count; ++i) {
            meet(one.low[i], one.high[i], i, other, 0);
            if (meetings_.count > Meetings::room && !tell(one, other)) return false;
        }
        return tell(one, other);
    }

    bool with_cell_around(const LayeredCell& cell, const LayeredCell& around) {
        lift(cell, around);
        const std::uint32_t count = around.residents + around.guests;
        for (std::uint32_t from = 0; from < count && lifted_.count > 0; from += block_size) {
            load(around, from, other_);
            if (!between(lifted_, other_)) return false;
        }
        return true;
    }

    /// The own boxes as words of a cell around. Of a box that lies in several finer cells of it the first one tells: a
    /// guest takes part only where its cell is the first within the cell around.
    void lift(const LayeredCell& cell, const LayeredCell& around) {
        const std::uint32_t layer = CellKey<D>::layer(cell.key), layer_around = CellKey<D>::layer(around.key);
        const int shift = plan_.shift[layer_around] - plan_.shift[layer];
        const int shift_units = std::min(shift, Format::cell_bits);
        std::uint32_t banned = Format::flags;
        Vector inside[D];
        for (std::size_t i = 0; i < D; ++i) {
            const std::uint32_t number =
                static_cast<std::uint32_t>(CellKey<D>::coordinate(cell.key, i)) & ((1u << shift) - 1);
            if (number == 0) banned &= ~(1u << (Format::first_flag + static_cast<int>(i)));
            inside[i] = hn::Set(d, number << (Format::cell_bits - shift_units));
        }
        const Vector bans = hn::Set(d, banned), flags = hn::Set(d, Format::flags),
                     guards = hn::Set(d, CellWords<D>::guards);
        const Vector field = hn::Set(d, Format::field);
        const auto lifted = [&](Vector words) {
            Vector result = hn::Zero(d);
            for (int i = 0; i < D; ++i) {
                const Vector own = hn::And(hn::ShiftRightSame(words, i * Format::field_bits), field);
                const Vector all = hn::Add(inside[i], hn::ShiftRightSame(own, shift_units));
                result = hn::Or(
                    result, hn::ShiftLeftSame(hn::ShiftRightSame(all, shift - shift_units), i * Format::field_bits));
            }
            return result;
        };
        std::uint32_t count = 0;
        for (std::uint32_t i = 0; i < own_.count; i += lanes) {
            const Vector low = hn::Load(d, own_.low + i), high = hn::Load(d, own_.high + i);
            const auto in_block = hn::Lt(hn::Iota(d, i), hn::Set(d, own_.count));
            const auto taken = hn::And(hn::Eq(hn::And(low, bans), hn::Zero(d)), in_block);
            hn::StoreU(hn::Compress(hn::Or(lifted(low), hn::And(low, flags)), taken), d, lifted_.low + count);
            hn::StoreU(hn::Compress(hn::Or(lifted(high), guards), taken), d, lifted_.high + count);
            hn::StoreU(hn::Compress(hn::Load(d, own_.place + i), taken), d, lifted_.place + count);
            count += static_cast<std::uint32_t>(hn::CountTrue(d, taken));
        }
        lifted_.count = count;
        close(lifted_);
    }

    /// Hands the meetings on. Where words part two boxes or overlap by a unit and more, so do the boxes; in between the
    /// boxes themselves are asked. Returns false where the visitor has had enough.
    bool tell(const Block& block, const Block& other_block) {
        const std::uint32_t count = meetings_.count;
        meetings_.count = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t one = meetings_.one[i], other = meetings_.other[i];
            const std::uint32_t sure = (block.high[one] - other_block.low[other] - CellWords<D>::ones) &
                                       (other_block.high[other] - block.low[one] - CellWords<D>::ones) &
                                       CellWords<D>::guards;
            const std::uint32_t place = block.place[one], other_place = other_block.place[other];
            if (sure != CellWords<D>::guards && !overlaps(items_.boxes[place], items_.boxes[other_place])) continue;
            const std::uint32_t a = items_.index[place], b = items_.index[other_place];
            if (!pairs_.add(std::min(a, b), std::max(a, b))) return false;
        }
        return true;
    }

    const LayeredItems<D>& items_;
    const LayeredPlan<D>& plan_;
    PairBuffer& pairs_;
    Block own_, other_, lifted_;
    Meetings meetings_;
};

template <int D>
bool pairs_of(const LayeredItems<D>& items, const LayeredPlan<D>& plan, std::uint32_t begin, std::uint32_t end,
              PairBuffer& pairs) {
    CellPairs<D> cells(items, plan, pairs);
    for (std::uint32_t i = begin; i < end; ++i)
        if (!cells.of_cell(i)) return false;
    return true;
}
bool pairs_of_2(const LayeredItems<2>& items, const LayeredPlan<2>& plan, std::uint32_t begin, std::uint32_t end,
                PairBuffer& pairs) {
    return pairs_of<2>(items, plan, begin, end, pairs);
}
bool pairs_of_3(const LayeredItems<3>& items, const LayeredPlan<3>& plan, std::uint32_t begin, std::uint32_t end,
                PairBuffer& pairs) {
    return pairs_of<3>(items, plan, begin, end, pairs);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(pairs_of_2);
HWY_EXPORT(pairs_of_3);

bool pairs_of_cells(const LayeredItems<2>& items, const LayeredPlan<2>& plan, std::uint32_t begin, std::uint32_t end,
                    PairBuffer& pairs) {
    return HWY_DYNAMIC_DISPATCH(pairs_of_2)(items, plan, begin, end, pairs);
}
bool pairs_of_cells(const LayeredItems<3>& items, const LayeredPlan<3>& plan, std::uint32_t begin, std::uint32_t end,
                    PairBuffer& pairs) {
    return HWY_DYNAMIC_DISPATCH(pairs_of_3)(items, plan, begin, end, pairs);
}

}  // namespace abut
#endif
