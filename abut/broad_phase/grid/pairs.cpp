// Highway compiles this file once for each SIMD target and dispatches at run time. The order of the pairs doesn't
// depend on the target.

#include <abut/broad_phase/grid/queries.hpp>
#include <abut/math/detail/blob.hpp>
#include <abut/math/simd/dispatch-inl.h>

#include <algorithm>
#include <bit>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/grid/pairs.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<std::uint32_t, 16>;
constexpr Lanes d;
constexpr std::size_t lanes = hn::MaxLanes(d);
constexpr std::size_t groups = GridStore::page_size / lanes;

/// The overlaps of two pages: one bit for each pair of records, 16 bits for each record of the first page.
struct Tile {
    static constexpr std::uint32_t size = GridStore::page_size;
    static constexpr std::size_t word_count = size * size / 64;
    static constexpr std::uint32_t rows_per_word = 64 / size;

    HWY_ALIGN std::uint8_t bits[size * size / 8];

    std::uint64_t word(std::size_t w) const {
        std::uint64_t result;
        std::memcpy(&result, bits + 8 * w, 8);
        return little(result);
    }
};

void store_bits(const hn::Mask<Lanes> (&overlap)[groups], std::uint8_t* bits) {
    if constexpr (lanes >= 8) {
        for (std::size_t g = 0; g < groups; ++g) hn::StoreMaskBits(d, overlap[g], bits + g * lanes / 8);
    } else {
        std::uint8_t part[groups];
        for (std::size_t g = 0; g < groups; ++g) hn::StoreMaskBits(d, overlap[g], part + g);
        std::uint32_t all = 0;
        for (std::size_t g = 0; g < groups; ++g) all |= std::uint32_t{part[g]} << (g * lanes);
        bits[0] = static_cast<std::uint8_t>(all);
        bits[1] = static_cast<std::uint8_t>(all >> 8);
    }
}

/// The records of a page in SIMD vectors. Those beyond its count overlap nothing, for every subtraction from their low
/// word clears guard bits.
template <int D>
struct Page {
    hn::Vec<Lanes> low[groups], high[groups];

    Page(const GridRecord* records, std::size_t count) {
        const auto none = hn::Set(d, PackedBounds<D>::guards);
        hn::Vec<Lanes> unused;
        for (std::size_t g = 0; g < groups; ++g) {
            hn::LoadInterleaved3(d, &records[g * lanes].low, low[g], high[g], unused);
            const std::size_t before = std::min(g * lanes, count);
            low[g] = hn::IfThenElse(hn::FirstN(d, count - before), low[g], none);
        }
    }

    /// Tests each record of `row` against the whole page.
    void test(const GridRecord* row, std::uint32_t rows, Tile& tile) const {
        const auto guards = hn::Set(d, PackedBounds<D>::guards);
        for (std::uint32_t i = 0; i < rows; ++i) {
            const auto row_low = hn::Set(d, row[i].low), row_high = hn::Set(d, row[i].high);
            hn::Mask<Lanes> overlap[groups];
            for (std::size_t g = 0; g < groups; ++g) {
                const auto differences = hn::And(hn::Sub(high[g], row_low), hn::Sub(row_high, low[g]));
                overlap[g] = hn::Eq(hn::And(differences, guards), guards);
            }
            store_bits(overlap, tile.bits + i * Tile::size / 8);
        }
    }
};

/// Reports pairs whose quantised bounds overlap, in batches. If these don't prove the overlap, the boxes decide.
template <int D>
class PairReporter {
public:
    PairReporter(const GridStore& store, const Aabb<D>* boxes, PairsCall visit)
        : records_(store.records.data()), boxes_(boxes), visit_(visit) {}

    /// Makes space for another tile. Returns false if the visitor stops the search.
    bool make_space() { return count_ + Tile::size * Tile::size <= capacity || flush(); }

    void add(std::uint64_t bits, std::uint32_t row, std::uint32_t column) {
        // Each iteration writes three pairs, even if fewer remain, for a loop by count would be unpredictable.
        std::uint32_t remaining = static_cast<std::uint32_t>(std::popcount(bits));
        std::size_t at = count_;
        count_ += remaining;
        for (;;) {
            for (int k = 0; k < 3; ++k) {
                const auto bit = static_cast<std::uint32_t>(std::countr_zero(bits)) & 63;
                bits &= bits - 1;
                first_[at] = row + bit / Tile::size;
                second_[at++] = column + bit % Tile::size;
            }
            if (remaining <= 3) return;
            remaining -= 3;
        }
    }

    /// Returns false if the visitor stops the search.
    bool flush() {
        std::size_t reported = 0, undecided = 0;
        for (std::size_t k = 0; k < count_; ++k) {
            const GridRecord &a = records_[first_[k]], &b = records_[second_[k]];
            const bool is_sure = PackedBounds<D>::surely_overlap(a.low, a.high, b.low, b.high);
            const ItemPair pair = std::minmax(a.item, b.item);
            reported_[reported] = pair;
            reported += is_sure ? 1 : 0;
            undecided_[undecided] = pair;
            undecided += is_sure ? 0 : 1;
        }
        for (std::size_t k = 0; k < undecided; ++k) {
            const Aabb<D>&a = boxes_[undecided_[k].first], &b = boxes_[undecided_[k].second];
            std::uint32_t is_disjoint = 0;
            for (int i = 0; i < D; ++i)
                is_disjoint |=
                    static_cast<std::uint32_t>(a.min[i] > b.max[i]) | static_cast<std::uint32_t>(b.min[i] > a.max[i]);
            reported_[reported] = undecided_[k];
            reported += 1 - is_disjoint;
        }
        count_ = 0;
        return reported == 0 || visit_({reported_, reported});
    }

private:
    static constexpr std::size_t capacity = 1024;

    const GridRecord* records_;
    const Aabb<D>* boxes_;
    PairsCall visit_;
    std::size_t count_ = 0;
    std::uint32_t first_[capacity + 4], second_[capacity + 4];
    ItemPair reported_[capacity + 1], undecided_[capacity + 1];
};

/// The mask of a word of the tile of a page with itself: the pairs whose first record precedes the second.
constexpr std::uint64_t in_order(std::uint32_t word) {
    std::uint64_t result = 0;
    for (std::uint32_t bit = 0; bit < 64; ++bit)
        if (bit % Tile::size > word * Tile::rows_per_word + bit / Tile::size) result |= std::uint64_t{1} << bit;
    return result;
}

template <int D>
bool visit(const GridStore& store, const Aabb<D>* boxes, std::uint32_t begin, std::uint32_t end, PairsCall call) {
    constexpr std::uint64_t order[Tile::word_count] = {in_order(0), in_order(1), in_order(2), in_order(3)};
    PairReporter<D> reporter(store, boxes, call);
    const GridRecord* records = store.records.data();
    Tile tile;
    for (std::uint32_t cell = begin; cell < end; ++cell) {
        // The newest page may be partly filled. Whole words of its tile are tested; its other records overlap nothing.
        const bool continues = store.each_page(cell, [&](std::uint32_t column, std::uint32_t count) {
            const Page<D> page(records + column, count);
            const std::uint32_t words = (count + Tile::rows_per_word - 1) / Tile::rows_per_word;
            page.test(records + column, words * Tile::rows_per_word, tile);
            if (!reporter.make_space()) return false;
            for (std::uint32_t w = 0; w < words; ++w)
                reporter.add(tile.word(w) & order[w], column + w * Tile::rows_per_word, column);
            for (std::uint32_t row = store.previous_page(column); row != GridStore::none;
                 row = store.previous_page(row)) {
                page.test(records + row, Tile::size, tile);
                if (!reporter.make_space()) return false;
                for (std::uint32_t w = 0; w < Tile::word_count; ++w)
                    reporter.add(tile.word(w), row + w * Tile::rows_per_word, column);
            }
            return true;
        });
        if (!continues) return false;
    }
    return reporter.flush();
}

ABUT_NAME_DIMENSIONS(visit);

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

ABUT_EXPORT_DIMENSIONS(visit);

template <int D>
bool visit_cells(const GridStore& store, const Aabb<D>* boxes, std::uint32_t begin, std::uint32_t end,
                 PairsCall visit) {
    return dispatched_visit<D>()(store, boxes, begin, end, visit);
}
template bool visit_cells(const GridStore&, const Aabb<2>*, std::uint32_t, std::uint32_t, PairsCall);
template bool visit_cells(const GridStore&, const Aabb<3>*, std::uint32_t, std::uint32_t, PairsCall);

}  // namespace abut::detail
#endif
