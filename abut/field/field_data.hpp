#pragma once

// What a Field is made of: the numbers at its samples, and where they lie. Bakers fill it, looking up reads it. Not for
// users.

#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// How samples are kept.
enum class FieldStore : std::uint8_t {
    dense,   ///< all of them
    sparse,  ///< those of bricks near the surface; elsewhere one a brick's corner
};

/// How what lies between samples is told from them.
enum class FieldLookup : std::uint8_t {
    linear,    ///< from the distances at a cell's corners
    gradient,  ///< and from their gradients there: edges stay sharp, for 16 bits a sample and three times the time
};

/// As many cells a side has a brick.
template <int D>
inline constexpr std::uint32_t brick_cells = D == 2 ? 8 : 4;

/// As many samples.
template <int D>
inline constexpr std::uint32_t brick_samples = D == 2 ? 9 * 9 : 5 * 5 * 5;

/// There is no brick.
inline constexpr std::uint32_t no_brick = 0xffffffff;

/// What look-ups need at once, told from the rest when a Field is made. Four lanes an axis each, 0 where there is none,
/// for vectors.
template <int D>
struct FieldFrame {
    alignas(16) std::array<float, 4> low{};  ///< the lower corner of the volume
    std::array<float, 4> high{};             ///< the upper one
    std::array<float, 4> end{};              ///< the number of cells
    std::array<float, 4> last{};             ///< the last cell
    float inverse = 1;                       ///< 1 / cell
    glm::vec<D, std::uint32_t> stride{};     ///< dense: of samples
    glm::vec<D, std::uint32_t> block_row{};  ///< sparse: of blocks
    glm::vec<D, std::uint32_t> corners{};    ///< sparse: of the corners of blocks
};

/// A volume is a box of cubes, the cells, with samples at their corners; sample i is at origin + cell * i, in doubles.
/// Wherever samples follow one another the first axis is the fastest.
///
/// Dense: the samples of the volume. Sparse: the cells of each axis are a multiple of `brick_cells`; a block of so many
/// cells a side has a brick of its own samples, those on its sides included, or `no_brick`. Bricks share no samples, so
/// that a look-up sees one brick. A block without a brick lies farther than the band from the surface; there the
/// distance is told from those at its corners.
template <int D>
struct FieldData {
    Vec<D> origin{};
    float cell = 1;
    glm::vec<D, std::uint32_t> cells{};  ///< of the volume, along each axis; at least 1
    Aabb<D> surface = Aabb<D>::empty();  ///< around all places where the distance is 0
    FieldStore store = FieldStore::dense;
    FieldLookup lookup = FieldLookup::linear;

    /// Sparse: the number of the brick of each block.
    std::vector<std::uint32_t> brick;
    /// Sparse: the distances at the corners of all blocks.
    std::vector<float> coarse;

    /// Dense: of all samples; sparse: of the bricks' samples, brick by brick. Empty where `steps` holds them.
    std::vector<float> distance;
    /// Where the samples take 16 bits: the same distances as multiples of `step`, rounded to the nearest and kept
    /// within 32767 of them. Distances are right to half a step where they are less than 32767 steps.
    std::vector<std::int16_t> steps;
    float step = 0;  ///< 0 where there are none

    /// As `distance`, where wanted, else empty: the gradient, of length 1. A field packs them into `direction`.
    std::vector<Vec<D>> gradient;
    /// The same in 16 bits.
    std::vector<std::uint16_t> direction;
    /// As `distance`, where wanted, else empty: the closest point of the surface.
    std::vector<Vec<D>> closest;

    FieldFrame<D> frame;  ///< the field sees to it

    std::size_t samples() const { return steps.empty() ? distance.size() : steps.size(); }
};

}  // namespace abut
