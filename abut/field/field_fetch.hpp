#pragma once

// What lies around some points, fetched from a field's memory and laid side by side. One by one, which no gathering by
// vectors beats: where points lie, and what is told of them, vectors find. For .cpp files.

#include <abut/field/field_data.hpp>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace abut {

/// As many points are looked up at a time.
inline constexpr std::size_t at_a_time = 64;

/// Two neighbours along the first axis.
struct FloatPair {
    float low, high;
};
struct StepPair {
    std::int16_t low, high;
};

/// What is known of so many points.
template <int D>
struct Batch {
    static constexpr std::size_t rows = std::size_t{1} << (D - 1);

    alignas(64) float share[D][at_a_time];
    alignas(64) std::uint32_t first[at_a_time];   ///< dense: the first sample; sparse: the one in the brick
    alignas(64) std::uint32_t block[at_a_time];   ///< sparse
    alignas(64) std::uint32_t corner[at_a_time];  ///< sparse: of the block, the first corner
    alignas(64) float in_block[D][at_a_time];     ///< sparse: the cell's place in it
    alignas(64) float coarse[at_a_time];          ///< sparse: 1 where there is no brick, else 0
    alignas(64) float unit[at_a_time];            ///< sparse: what the numbers are multiples of
    alignas(64) float scale[at_a_time];           ///< sparse: the slope of a rise from corner to corner
    alignas(64) FloatPair floats[rows][at_a_time];
    alignas(64) StepPair steps[rows][at_a_time];
};

template <int D, class Pair, class Number>
void fetch(const Number* from, std::uint32_t row, std::uint32_t slice, Pair (*rows)[at_a_time], std::size_t i) {
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

/// True where some lie in blocks without a brick.
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
                batch.share[a][i] = (batch.share[a][i] + batch.in_block[a][i]) * (1.0f / side);
        }
    }
    return any_coarse;
}

}  // namespace abut
