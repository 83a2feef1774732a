#pragma once

// Copies the samples around several points from a field's memory into arrays, for SIMD. Scalar copies are faster than
// gather instructions here; SIMD computes the positions before and the interpolation after. For .cpp files.

#include <abut/field/data.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace abut::detail {

/// Number of points per batch.
inline constexpr std::size_t batch_size = 64;

/// Two neighbours along the first axis.
struct FloatPair {
    float low, high;
};
struct StepPair {
    std::int16_t low, high;
};

/// The intermediate values of a batch of points.
template <int D>
struct Batch {
    static constexpr std::size_t rows = std::size_t{1} << (D - 1);

    alignas(64) float fraction[D][batch_size];
    alignas(64) std::uint32_t first[batch_size];   ///< dense: the first sample; sparse: its index in the brick
    alignas(64) std::uint32_t block[batch_size];   ///< sparse
    alignas(64) std::uint32_t corner[batch_size];  ///< sparse: the first corner of the block
    alignas(64) float in_block[D][batch_size];     ///< sparse: position of the cell in its block
    alignas(64) float coarse[batch_size];          ///< sparse: 1 without a brick, else 0
    alignas(64) float unit[batch_size];            ///< sparse: value of one unit of the samples
    alignas(64) float scale[batch_size];           ///< sparse: slope per unit of difference between corners
    alignas(64) FloatPair floats[rows][batch_size];
    alignas(64) StepPair steps[rows][batch_size];
};

template <int D, class Pair, class Number>
void fetch(const Number* from, std::uint32_t row, std::uint32_t slice, Pair (*rows)[batch_size], std::size_t i) {
    static_assert(sizeof(Pair) == 2 * sizeof(Number));
    std::memcpy(&rows[0][i], from, sizeof(Pair));
    std::memcpy(&rows[1][i], from + row, sizeof(Pair));
    if constexpr (D == 3) {
        std::memcpy(&rows[2][i], from + slice, sizeof(Pair));
        std::memcpy(&rows[3][i], from + slice + row, sizeof(Pair));
    }
}

template <int D, class Number>
void fetch_samples(const FieldData<D>& data, std::uint32_t first, std::uint32_t row, std::uint32_t slice,
                   Batch<D>& batch, std::size_t i) {
    if constexpr (std::is_same_v<Number, float>)
        fetch<D>(data.distance.data() + first, row, slice, batch.floats, i);
    else
        fetch<D>(data.steps.data() + first, row, slice, batch.steps, i);
}

/// Returns true if a point lies in a block without a brick.
template <int D, class Number>
bool fetch_all(const FieldData<D>& data, std::size_t count, Batch<D>& batch) {
    if (data.store == FieldStore::dense) {
        const glm::vec<D, std::uint32_t> stride = data.frame.stride;
        for (std::size_t i = 0; i < count; ++i)
            fetch_samples<D, Number>(data, batch.first[i], stride[1], stride[D - 1], batch, i);
        return false;
    }
    constexpr std::uint32_t side = brick_cells<D>;
    const glm::vec<D, std::uint32_t> corners = data.frame.corners;
    const std::uint32_t* bricks = data.brick.data();
    const float* coarse = data.coarse.data();
    const float unit = std::is_same_v<Number, float> ? 1.0f : data.step, scale = unit * data.frame.inverse;
    bool any_coarse = false;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t brick = bricks[batch.block[i]];
        if (brick != no_brick) {
            const std::uint32_t first = brick * brick_samples<D> + batch.first[i];
            fetch_samples<D, Number>(data, first, side + 1, (side + 1) * (side + 1), batch, i);
            batch.coarse[i] = 0;
            batch.unit[i] = unit;
            batch.scale[i] = scale;
        } else {
            any_coarse = true;
            fetch<D>(coarse + batch.corner[i], corners[1], corners[D - 1], batch.floats, i);
            batch.coarse[i] = 1;
            batch.unit[i] = 1;
            batch.scale[i] = data.frame.inverse * (1.0f / side);
            for (std::size_t a = 0; a < D; ++a)
                batch.fraction[a][i] = (batch.fraction[a][i] + batch.in_block[a][i]) * (1.0f / side);
        }
    }
    return any_coarse;
}

}  // namespace abut::detail
