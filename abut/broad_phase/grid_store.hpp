#pragma once

// What lies in the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid_cells.hpp>
#include <abut/math/executor.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A box in a cell.
struct GridRecord {
    std::uint32_t low, high;  ///< GridWords
    std::uint32_t item;
};

/// The records of a cell lie in pages, of which all but the one begun last are full. Each cell has three pages of its
/// own, beside those of the next cell; what they can't hold lies in pages that are handed out as they are needed.
///
/// Several threads may add at once, each to cells of its own.
class GridStore {
public:
    static constexpr std::uint32_t page_size = 16;
    static constexpr std::uint32_t own_pages = 3;
    static constexpr std::uint32_t none = 0xffffffff;

    std::vector<GridRecord> records;  ///< in pages; where a page holds none, one that meets nothing

    /// Room for so many pages and cells. Nothing is allocated where there was as much room before. `guards` are those
    /// of the words.
    void reserve(std::uint32_t most_pages, std::uint32_t most_cells, std::uint32_t guards) {
        meets_nothing_ = guards;
        page_limit_ = most_pages;
        // Exactly: a resize alone would double what there was.
        records.reserve(std::size_t{page_size} * most_pages);
        records.resize(std::size_t{page_size} * most_pages);
        before_.reserve(most_pages);
        before_.resize(most_pages);
        next_.reserve(most_cells);
    }
    void clear(std::uint32_t cells) {
        next_.assign(cells, 0);
        pages_ = own_end_ = cells * own_pages;
        free_page_ = none;
        is_full_ = 0;
    }

    /// A record that found no room is lost, and from then on the store is full.
    bool is_full() const { return std::atomic_ref(is_full_).load(std::memory_order_relaxed) != 0; }

    void add(std::uint32_t cell, std::uint32_t low, std::uint32_t high, std::uint32_t item) {
        std::uint32_t place = next_[cell];
        if (place % page_size == 0) {
            place = begin_page(cell, place);
            if (place == none) return;
        }
        records[place] = {low, high, item};
        next_[cell] = place + 1;
    }
    /// An item that is in the cell; the last one takes its place.
    void remove(std::uint32_t cell, std::uint32_t item) {
        const std::uint32_t last = next_[cell] - 1;
        each_page(cell, [&](std::uint32_t first, std::uint32_t count) {
            std::uint32_t place = first;
            while (place < first + count && records[place].item != item) ++place;
            if (place == first + count) return true;
            records[place] = records[last];
            return false;
        });
        records[last] = {meets_nothing_, 0, 0};
        next_[cell] = last;
        if (last % page_size == 0) end_page(cell, last);
    }

    bool is_empty(std::uint32_t cell) const { return next_[cell] == 0; }
    std::uint32_t page_before(std::uint32_t first_record) const { return before_[first_record / page_size]; }
    /// Whether the page begun last holds one record only.
    bool has_new_page(std::uint32_t cell) const { return next_[cell] % page_size == 1; }
    std::uint32_t page_count(std::uint32_t cell) const {
        std::uint32_t result = 0;
        each_page(cell, [&](std::uint32_t, std::uint32_t) { return ++result > 0; });
        return result;
    }

    /// Calls visit(first record, how many) for each page of a cell, the one begun last first, until one says false.
    /// Returns whether none did.
    template <class Visit>
    bool each_page(std::uint32_t cell, Visit visit) const {
        const std::uint32_t end = next_[cell];
        if (end == 0) return true;
        std::uint32_t first = (end - 1) / page_size * page_size, count = end - first;
        for (; first != none; first = page_before(first), count = page_size)
            if (!visit(first, count)) return false;
        return true;
    }

private:
    /// The place of its first record, or none.
    std::uint32_t begin_page(std::uint32_t cell, std::uint32_t place) {
        std::uint32_t page = place == 0 ? cell * own_pages : place / page_size;
        if (page >= (cell + 1) * own_pages) page = take_page();
        if (page >= page_limit_) {
            std::atomic_ref(is_full_).store(1, std::memory_order_relaxed);
            return none;
        }
        const std::uint32_t first = page * page_size;
        before_[page] = place == 0 ? none : place - page_size;
        // Meets nothing: all guards are lost.
        for (std::uint32_t i = 0; i < page_size; ++i) records[first + i] = {meets_nothing_, 0, 0};
        return first;
    }
    /// The one that was begun last, with its first record.
    void end_page(std::uint32_t cell, std::uint32_t first) {
        const std::uint32_t page = first / page_size, last_before = before_[page];
        next_[cell] = last_before == none ? 0 : last_before + page_size;
        if (page < own_end_) return;
        before_[page] = free_page_;
        free_page_ = page;
    }
    std::uint32_t take_page() {
        // While several threads add, no page has come back.
        if (free_page_ == none) return std::atomic_ref(pages_).fetch_add(1, std::memory_order_relaxed);
        const std::uint32_t result = free_page_;
        free_page_ = before_[result];
        return result;
    }

    std::vector<std::uint32_t> before_;  ///< of a page, the first record of that of its cell begun before, or none
    std::vector<std::uint32_t> next_;    ///< of a cell, the record after its last one; 0: it has none
    std::uint32_t own_end_ = 0;          ///< pages before this one belong to their cells
    std::uint32_t pages_ = 0;            ///< so many are handed out, and perhaps more were asked for
    std::uint32_t page_limit_ = 0;
    std::uint32_t free_page_ = none;  ///< that came back; before_ has the next of these
    mutable std::uint32_t is_full_ = 0;
    std::uint32_t meets_nothing_ = 0;
};

/// A box that would lie in more cells than this is kept by itself.
template <int D>
inline constexpr std::uint32_t most_cells_of_a_box = D == 2 ? 16 : 32;

/// Whether a box lies in few enough cells.
template <int D>
bool fits_in_cells(const CellRange<D>& range) {
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < D; ++i) count *= range.high[i] - range.low[i] + 1;
    return count <= most_cells_of_a_box<D>;
}

/// Puts all boxes into the store, a copy of them into `own` (empty ones as Aabb::empty()), and the numbers of those
/// that would lie in too many cells into `large`. Stops early where the store is full. In each cell the order of the
/// boxes is the same whether there is an executor or not. `marks` has room for as many numbers as there are boxes.
template <int D>
void fill(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
          std::vector<std::uint32_t>& large, std::uint8_t* marks, Executor* executor);

}  // namespace abut
