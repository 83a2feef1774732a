#pragma once

// Fields that take half the memory.

#include <abut/field/field_data.hpp>

namespace abut {

/// Keeps the distances of the samples as multiples of a 32767th of the largest of them, in 16 bits: right to half of
/// that. Of a sparse field that is next to nothing, as its samples lie near the surface; of a dense one whose distances
/// go to 100 cells, 0.0015 of a cell. Those at the corners of blocks stay as they are. Nothing where it is done
/// already.
template <int D>
void quantise(FieldData<D>& data);

}  // namespace abut
