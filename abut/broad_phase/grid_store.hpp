#pragma once

// What lies in the cells of a Grid. For .cpp files.

#include <abut/broad_phase/grid_cells.hpp>

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
struct GridStore {
    static constexpr std::uint32_t page_size = 16;
    static constexpr std::uint32_t own_pages = 3;
    static constexpr std::uint32_t none = 0xffffffff;

    std::vector<GridRecord> records;    ///< in pages
    std::vector<std::uint32_t> before;  ///< of a page, the first record of that of its cell begun before, or none
    std::vector<std::uint32_t> next;    ///< of a cell, the record after its last one; 0: it has none
    std::uint32_t pages = 0;            ///< so many are handed out
    std::uint32_t page_limit = 0;       ///< one more than these there is, for what finds no room
    bool is_full = false;

    /// Room for so many pages and cells. Nothing is allocated where there was as much room before.
    void reserve(std::uint32_t most_pages, std::uint32_t most_cells, std::uint32_t guards) {
        meets_nothing = guards;
        page_limit = most_pages;
        records.resize(std::size_t{page_size} * (most_pages + 1));
        before.resize(std::size_t{most_pages} + 1);
        next.reserve(most_cells);
    }
    void clear(std::uint32_t cells) {
        next.assign(cells, 0);
        pages = cells * own_pages;
        is_full = false;
    }

    void add(std::uint32_t cell, std::uint32_t low, std::uint32_t high, std::uint32_t item) {
        std::uint32_t place = next[cell];
        if (place % page_size == 0) place = begin_page(cell, place);
        records[place] = {low, high, item};
        next[cell] = place + 1;
    }

    bool is_empty(std::uint32_t cell) const { return next[cell] == 0; }
    std::uint32_t page_before(std::uint32_t first_record) const { return before[first_record / page_size]; }

    /// Calls visit(first record, how many) for each page of a cell, the one begun last first, until one says false.
    /// Returns whether none did.
    template <class Visit>
    bool each_page(std::uint32_t cell, Visit visit) const {
        const std::uint32_t end = next[cell];
        if (end == 0) return true;
        std::uint32_t first = (end - 1) / page_size * page_size, count = end - first;
        for (; first != none; first = page_before(first), count = page_size)
            if (!visit(first, count)) return false;
        return true;
    }

private:
    std::uint32_t begin_page(std::uint32_t cell, std::uint32_t place) {
        std::uint32_t page = place == 0 ? cell * own_pages : place / page_size;
        if (page >= (cell + 1) * own_pages) {
            if (pages == page_limit) {
                is_full = true;
                return page_limit * page_size;
            }
            page = pages++;
        }
        const std::uint32_t first = page * page_size;
        before[page] = place == 0 ? none : place - page_size;
        // Meets nothing: all guards are lost.
        for (std::uint32_t i = 0; i < page_size; ++i) records[first + i] = {meets_nothing, 0, 0};
        return first;
    }

    std::uint32_t meets_nothing = 0;
};

/// A box that would lie in more cells than this is kept by itself.
template <int D>
inline constexpr std::uint32_t most_cells_of_a_box = D == 2 ? 16 : 32;

/// Puts all boxes into the store, a copy of them into `own` (empty ones as Aabb::empty()), and the numbers of those
/// that would lie in too many cells into `large`. Stops early where the store is full.
template <int D>
void fill(const GridCells<D>& cells, std::span<const Aabb<D>> boxes, Aabb<D>* own, GridStore& store,
          std::vector<std::uint32_t>& large);

}  // namespace abut
