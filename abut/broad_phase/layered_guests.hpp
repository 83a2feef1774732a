#pragma once

// The guests of the cells of a LayeredGrid. For .cpp files.

#include <abut/broad_phase/layered_items.hpp>

#include <cstdint>

namespace abut {

/// Writes each cell's guests, `count` in all, from the residents of those cells that `spare` tells.
void fetch_guests(LayeredItems<2>& items, std::uint32_t count);
void fetch_guests(LayeredItems<3>& items, std::uint32_t count);

}  // namespace abut
