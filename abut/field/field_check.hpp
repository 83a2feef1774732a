#pragma once

// Whether what a field's data says of itself is true. For .cpp files.

#include <abut/field/field_data.hpp>

namespace abut {

/// So many cells an axis may have: floats count them exactly.
inline constexpr std::uint32_t most_cells = 1u << 24;

/// What is wrong with the counts, the numbers of bricks or the cell, as one line for a person; null: nothing, and no
/// look-up leaves the data.
template <int D>
const char* fault_of(const FieldData<D>& data);

}  // namespace abut
