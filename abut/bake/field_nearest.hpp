#pragma once

// The nearest piece of a surface to a point, and to all samples of a block at once. For .cpp files.

#include <abut/bake/field_pieces.hpp>
#include <abut/bake/field_samples.hpp>

#include <cstdint>

namespace abut {

/// Which piece is the nearest, and the square of its distance, right to some units in the last place of the larger of
/// the distance and the piece. It is what measuring all pieces one by one would give, to the last bit, on every
/// machine: of those for which the same number comes out the first.
struct NearestPiece {
    double squared = 0;
    std::uint32_t piece = 0;
};

template <int D>
NearestPiece nearest_piece(const PieceTree<D>& tree, const DVec<D>& point);

/// `nearest` has room for all samples of the block.
template <int D>
void nearest_pieces(const PieceTree<D>& tree, const SampleLattice<D>& lattice, const SampleBlock<D>& block,
                    NearestPiece* nearest);

}  // namespace abut
