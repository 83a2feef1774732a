#pragma once

// Nearest-primitive queries for a point and for all samples of a block. For .cpp files.

#include <abut/bake/field/primitive_bvh.hpp>
#include <abut/bake/field/samples.hpp>

#include <cstdint>

namespace abut::detail {

/// The number of the nearest primitive and its squared distance. The distance is accurate to a few units in the last
/// place of the larger of the distance and the primitive's size.
///
/// The result equals that of a brute-force search over all primitives, bit by bit, on every machine. Of several
/// primitives with equal computed distance, the one with the lowest number is chosen.
struct NearestPrimitive {
    double squared = 0;
    std::uint32_t primitive = 0;
};

template <int D>
NearestPrimitive nearest_primitive(const PrimitiveBvh<D>& tree, const DVec<D>& point);

/// `nearest` has capacity for all samples of the block.
template <int D>
void nearest_primitives(const PrimitiveBvh<D>& tree, const SampleLattice<D>& lattice, const SampleBlock<D>& block,
                        NearestPrimitive* nearest);

}  // namespace abut::detail
