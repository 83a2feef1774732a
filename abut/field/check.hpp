#pragma once

// Validation of a field's data. For .cpp files.

#include <abut/field/data.hpp>
#include <abut/math/result.hpp>

#include <optional>

namespace abut::detail {

/// Maximum number of cells along an axis: floats represent every integer up to it.
inline constexpr std::uint32_t max_cells = 1u << 24;

/// Exclusive limits of a cell's length; the upper one also limits coordinates and distances. Sums and products of two
/// such numbers don't overflow a float.
inline constexpr float min_field_length = 0x1p-100f, max_field_length = 0x1p100f;

/// Maximum distance of a sample, in cells. Squares of slopes don't overflow a float.
inline constexpr float max_field_slope = 0x1p60f;

/// Checks the counts, the brick numbers, the cell and all samples. The Problem's index is that of the block, or of the
/// number in its array. Without a Problem no look-up leaves the data, and every query with a finite point has a finite
/// result.
///
/// The change of the distance from sample to sample is not limited. It may be any number of cells where the sign of an
/// open mesh is uncertain, or where the volume of a field that is combined with others cuts its solid.
template <int D>
std::optional<Problem> fault_of(const FieldData<D>& data);

/// The part of the check that reads all samples.
template <int D>
std::optional<Problem> fault_of_numbers(const FieldData<D>& data);

}  // namespace abut::detail
