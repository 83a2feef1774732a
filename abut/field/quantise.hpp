#pragma once

// Quantisation of fields to half the memory.

#include <abut/field/data.hpp>

namespace abut::detail {

/// Quantises the distances of the samples to 16 bits, with a step of a 32767th of the largest. The error is at most
/// half a step. In a sparse field it is negligible, because its samples are near the surface; in a dense field with
/// distances up to 100 cells it is 0.0015 cells. Distances at the corners of blocks are unchanged. A quantised field is
/// not changed.
template <int D>
void quantise(FieldData<D>& data);

}  // namespace abut::detail
