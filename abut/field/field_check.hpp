#pragma once

// Whether a field's data is such that every question about it has an answer. For .cpp files.

#include <abut/field/field_data.hpp>
#include <abut/math/result.hpp>

#include <optional>

namespace abut {

/// So many cells an axis may have: floats count them exactly.
inline constexpr std::uint32_t most_cells = 1u << 24;

/// A cell is longer than the one and shorter than the other; no coordinate and no distance of a field reaches the
/// other. Sums and products of two of them stay within what floats hold.
inline constexpr float min_field_length = 0x1p-100f, max_field_length = 0x1p100f;

/// No distance of a sample is more cells than this. Squares of slopes stay within what floats hold.
inline constexpr float max_field_slope = 0x1p60f;

/// What is wrong with the counts, the numbers of bricks, the cell or a sample: the Problem's index is that of the block
/// or of the number in its array. Nothing: no look-up leaves the data, and every answer about a finite point is finite.
///
/// How much a distance changes from sample to sample has no limit: neighbours of a cell apart may differ by any
/// number of cells where the sign of an open mesh is a guess, and where the volume of a field that is combined with
/// others cuts its solid.
template <int D>
std::optional<Problem> fault_of(const FieldData<D>& data);

/// The part of it that looks at every number.
template <int D>
std::optional<Problem> fault_of_numbers(const FieldData<D>& data);

}  // namespace abut
