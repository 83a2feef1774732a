#pragma once

// Serialization of fields: a pipeline saves them, a game loads them.

#include <abut/field/field.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// Serializes a field, with the same bytes on every machine. `load_field` restores it bit by bit.
template <int D>
std::vector<std::byte> save(const Field<D>& field);

/// Loads a field that `save` has written for this dimension. A Problem (`bad_format`) if the bytes are too few or too
/// many, have another version or kind or a wrong checksum, or if a sample is beyond 2^60 cells or 2^100 from the
/// surface, or a closest point beyond 2^100; the index is that of the number in its array. `not_finite` if a number is
/// NaN or infinite. All results of a loaded field are finite. The memory is at most the number of bytes.
template <int D>
Result<Field<D>> load_field(std::span<const std::byte> bytes);

/// 2 or 3 if the bytes begin with the signature of a field of this dimension, else 0.
int field_dimension(std::span<const std::byte> bytes);

}  // namespace abut
