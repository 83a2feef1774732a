#pragma once

// The contents of the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid/cells.hpp>
#include <abut/math/executor.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut::detail {

/// A copy of a box in a cell.
struct GridRecord {
    std::uint32_t low, high;  ///< see PackedBounds
    std::uint32_t item;
};

/// The records of a cell lie in pages, all of them full except the newest. Each cell has three consecutive pages of its
/// own; further pages are allocated as needed.
///
/// Several threads may add at once if no two add to the same cell.
class GridStore {
public:
    static constexpr std::uint32_t page_size = 16;
    static constexpr std::uint32_t pages_per_cell = 3;
    static constexpr std::uint32_t none = 0xffffffff;

    std::vector<GridRecord> records;  ///< in pages; those beyond the count of a page are of no use

    /// Reserves capacity for so many pages and cells. Allocates nothing if the capacity suffices.
    void reserve(std::uint32_t max_pages, std::uint32_t max_cells) {
        page_limit_ = max_pages;
        // The reserve keeps the capacity exact: a resize alone could double it.
        records.reserve(std::size_t{page_size} * max_pages);
        records.resize(std::size_t{page_size} * max_pages);
        previous_.reserve(max_pages);
        previous_.resize(max_pages);
        next_.reserve(max_cells);
    }
    void clear(std::uint32_t cells) {
        next_.assign(cells, 0);
        pages_ = first_shared_page_ = cells * pages_per_cell;
        free_page_ = none;
        is_full_ = 0;
    }

    /// True after a record was dropped for lack of capacity.
    bool is_full() const { return std::atomic_ref(is_full_).load(std::memory_order_relaxed) != 0; }

    void add(std::uint32_t cell, std::uint32_t low, std::uint32_t high, std::uint32_t item) {
        std::uint32_t position = next_[cell];
        if (position % page_size == 0) {
            position = begin_page(cell, position);
            if (position == none) return;
        }
        records[position] = {low, high, item};
        next_[cell] = position + 1;
    }
    /// Removes an item that is in the cell; the last record takes its position.
    void remove(std::uint32_t cell, std::uint32_t item) {
        const std::uint32_t last = next_[cell] - 1;
        each_page(cell, [&](std::uint32_t first, std::uint32_t count) {
            std::uint32_t position = first;
            while (position < first + count && records[position].item != item) ++position;
            if (position == first + count) return true;
            records[position] = records[last];
            return false;
        });
        next_[cell] = last;
        if (last % page_size == 0) end_page(cell, last);
    }

    bool is_empty(std::uint32_t cell) const { return next_[cell] == 0; }
    /// The first record of the page that the cell began before this one; `none` for its first page.
    std::uint32_t previous_page(std::uint32_t first_record) const { return previous_[first_record / page_size]; }
    /// Whether the newest page has exactly one record.
    bool has_new_page(std::uint32_t cell) const { return next_[cell] % page_size == 1; }
    std::uint32_t page_count(std::uint32_t cell) const {
        std::uint32_t result = 0;
        each_page(cell, [&](std::uint32_t, std::uint32_t) { return ++result > 0; });
        return result;
    }

    /// Calls visit(first record, count) for each page of a cell, newest first, until the visitor returns false. Returns
    /// whether it never did.
    template <class Visit>
    bool each_page(std::uint32_t cell, Visit visit) const {
        const std::uint32_t end = next_[cell];
        if (end == 0) return true;
        std::uint32_t first = (end - 1) / page_size * page_size, count = end - first;
        for (; first != none; first = previous_page(first), count = page_size)
            if (!visit(first, count)) return false;
        return true;
    }

private:
    /// Begins a page after the full ones and returns its first record; `none` if the store is full.
    std::uint32_t begin_page(std::uint32_t cell, std::uint32_t position) {
        std::uint32_t page = position == 0 ? cell * pages_per_cell : position / page_size;
        if (page >= (cell + 1) * pages_per_cell) page = allocate_page();
        if (page >= page_limit_) {
            std::atomic_ref(is_full_).store(1, std::memory_order_relaxed);
            return none;
        }
        previous_[page] = position == 0 ? none : position - page_size;
        return page * page_size;
    }
    /// Frees the newest page of a cell, which begins at this record.
    void end_page(std::uint32_t cell, std::uint32_t first) {
        const std::uint32_t page = first / page_size, previous = previous_[page];
        next_[cell] = previous == none ? 0 : previous + page_size;
        if (page < first_shared_page_) return;
        previous_[page] = free_page_;
        free_page_ = page;
    }
    std::uint32_t allocate_page() {
        // The free list is empty while several threads add, so that it needs no lock.
        if (free_page_ == none) return std::atomic_ref(pages_).fetch_add(1, std::memory_order_relaxed);
        const std::uint32_t result = free_page_;
        free_page_ = previous_[result];
        return result;
    }

    std::vector<std::uint32_t> previous_;  ///< by page; see previous_page. Of a free page: the next free page
    std::vector<std::uint32_t> next_;      ///< by cell: the record after its last one; 0 if it has none
    std::uint32_t first_shared_page_ = 0;  ///< the pages before this one belong to cells
    std::uint32_t pages_ = 0;              ///< the number of pages in use; beyond page_limit_ if allocations failed
    std::uint32_t page_limit_ = 0;
    std::uint32_t free_page_ = none;  ///< the head of the free list
    mutable std::uint32_t is_full_ = 0;
};

/// Boxes that would touch more cells are stored separately.
template <int D>
inline constexpr std::uint32_t max_cells_per_box = D == 2 ? 16 : 32;

/// Whether a box with this range of cells is stored in cells.
template <int D>
bool fits_in_cells(const CellRange<D>& range) {
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < D; ++i) count *= range.high[i] - range.low[i] + 1;
    return count <= max_cells_per_box<D>;
}

/// Adds all boxes to the store, copies them to `own` (empty ones as Aabb::empty()), and appends the indices of boxes
/// that would touch too many cells to `large`. Stops early if the store is full. The order of the boxes in each cell
/// doesn't depend on the executor. With an executor, `marks` has one entry for each box.
template <int D>
void fill(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
          std::vector<std::uint32_t>& large, std::uint8_t* marks, Executor* executor);

}  // namespace abut::detail
