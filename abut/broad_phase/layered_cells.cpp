#include <abut/broad_phase/layered_cells.hpp>

#include <algorithm>

namespace abut {
namespace {

/// The slots for so many cells.
std::size_t slots_for(std::size_t cells) {
    return std::max<std::size_t>(4, std::bit_ceil(2 * cells));
}

}  // namespace

void CellTable::reserve(std::size_t cells) {
    slots_.reserve(slots_for(cells));
}

void CellTable::assign(const std::vector<LayeredCell>& cells) {
    // Room for a quarter more: the table need not grow for a while.
    const std::size_t slots = slots_for(cells.size() + cells.size() / 4);
    slots_.assign(slots, no_cell);
    mask_ = slots - 1;
    shift_ = 64 - std::countr_zero(slots);
    for (std::uint32_t cell = 0; cell < cells.size(); ++cell) insert(cells[cell].key, cell);
}

void CellTable::insert(std::uint64_t key, std::uint32_t cell) {
    std::size_t slot = first_slot(key);
    while (slots_[slot] != no_cell) slot = (slot + 1) & mask_;
    slots_[slot] = cell;
}

std::uint32_t CellTable::add(std::vector<LayeredCell>& cells, std::uint64_t key, std::size_t slot) {
    const auto result = static_cast<std::uint32_t>(cells.size());
    cells.push_back({key, 0, 0, 0, 0, no_cell, 0});
    if (2 * cells.size() > slots_.size())
        assign(cells);
    else
        slots_[slot] = result;
    return result;
}

}  // namespace abut
