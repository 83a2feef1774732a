#pragma once

// The data of a Field: its samples and their lattice. Bakers fill it, look-ups read it. Not for users.

#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace abut {

/// Storage of samples.
enum class FieldStore : std::uint8_t {
    dense,   ///< all samples
    sparse,  ///< bricks of samples in a narrow band around the surface; elsewhere the corners of blocks
};

/// Interpolation between samples.
enum class FieldLookup : std::uint8_t {
    linear,  ///< from the distances at a cell's corners
    /// also from the gradients there: edges stay sharp, for 16 more bits per sample and three times the time
    gradient,
};

}  // namespace abut

namespace abut::detail {

/// Cells of a brick along each axis.
template <int D>
inline constexpr std::uint32_t brick_cells = D == 2 ? 8 : 4;

/// Samples of a brick.
template <int D>
inline constexpr std::uint32_t brick_samples = D == 2 ? 9 * 9 : 5 * 5 * 5;

/// Marks a block without a brick.
inline constexpr std::uint32_t no_brick = 0xffffffff;

/// Values derived from the rest when a Field is made, for look-ups. Four lanes per axis array for SIMD; unused lanes
/// are 0.
template <int D>
struct FieldFrame {
    alignas(16) std::array<float, 4> low{};  ///< lower corner of the volume
    std::array<float, 4> high{};             ///< upper corner of the volume
    std::array<float, 4> end{};              ///< number of cells
    std::array<float, 4> last{};             ///< index of the last cell
    float inverse = 1;                       ///< 1 / cell
    glm::vec<D, std::uint32_t> stride{};     ///< dense: of samples
    glm::vec<D, std::uint32_t> block_row{};  ///< sparse: of blocks
    glm::vec<D, std::uint32_t> corners{};    ///< sparse: of the corners of blocks
};

/// A volume is a box of cubic cells with samples at their corners; sample i is at origin + cell * i, in double. In all
/// arrays the first axis is the fastest.
///
/// Dense: all samples of the volume. Sparse: the number of cells along each axis is a multiple of `brick_cells`, and
/// cells form blocks of `brick_cells` along each axis. A block has a brick with its own samples, including those on its
/// sides, or `no_brick`. Bricks share no samples, so a look-up reads one brick. A block without a brick is outside the
/// narrow band; its distances are interpolated from its corners.
template <int D>
struct FieldData {
    Vec<D> origin{};
    float cell = 1;
    glm::vec<D, std::uint32_t> cells{};  ///< number of cells of the volume along each axis; at least 1
    Aabb<D> surface = Aabb<D>::empty();  ///< bounds of the zero level set
    FieldStore store = FieldStore::dense;
    FieldLookup lookup = FieldLookup::linear;

    /// Sparse: the number of the brick of each block.
    std::vector<std::uint32_t> brick;
    /// Sparse: the distances at the corners of all blocks.
    std::vector<float> coarse;

    /// Dense: of all samples; sparse: of the samples of all bricks, brick by brick. Empty if `steps` holds them.
    std::vector<float> distance;
    /// Quantised samples: the distances as multiples of `step`, rounded to nearest and clamped to 32767 steps. Smaller
    /// distances have an error of at most half a step.
    std::vector<std::int16_t> steps;
    float step = 0;  ///< 0 if there are none

    /// Optional, in the order of `distance`: the unit gradients. A field packs them into `direction`.
    std::vector<Vec<D>> gradient;
    /// The gradients in 16 bits.
    std::vector<std::uint16_t> direction;
    /// Optional, in the order of `distance`: the closest points of the surface.
    std::vector<Vec<D>> closest;

    FieldFrame<D> frame;  ///< computed by the field

    std::size_t samples() const { return steps.empty() ? distance.size() : steps.size(); }
};

}  // namespace abut::detail
