#pragma once

// Fields as bytes: what a pipeline bakes and a game loads.

#include <abut/field/field.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace abut {

/// The field as bytes, the same on every machine. `load_field` makes the same field of them, bit by bit.
template <int D>
std::vector<std::byte> save(const Field<D>& field);

/// A Problem (`bad_format`) where they aren't what `save` makes of a field of this dimension, down to the last bit:
/// they end too soon, go on, are of another version or kind, or a bit is wrong; or where a sample is beyond 2^60 cells
/// or 2^100 from the surface, or a closest point beyond 2^100: the index is its place in its array. `not_finite` where
/// a number is NaN or infinite. Every answer of a field that loads is finite. Takes no more memory than there are
/// bytes.
template <int D>
Result<Field<D>> load_field(std::span<const std::byte> bytes);

/// 2 or 3 where the bytes begin as those of a field of the plane or of space do; else 0.
int field_dimension(std::span<const std::byte> bytes);

}  // namespace abut
