#pragma once

// What a field is baked from: something that tells distances at the samples of a lattice. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut {

/// Where samples lie: number i of an axis at origin + cell * i.
template <int D>
struct SampleLattice {
    DVec<D> origin{0.0};
    double cell = 1;

    double along(int axis, std::uint32_t i) const { return origin[axis] + cell * i; }
    DVec<D> at(const glm::vec<D, std::uint32_t>& sample) const {
        DVec<D> result;
        for (int i = 0; i < D; ++i) result[i] = along(i, sample[i]);
        return result;
    }
};

/// The first of `count` samples along an axis that is at a place or behind it; else `count`.
template <int D>
std::uint32_t first_behind(const SampleLattice<D>& lattice, int axis, double place, std::uint32_t count) {
    const double guess = std::ceil((place - lattice.origin[axis]) / lattice.cell);
    auto result = static_cast<std::uint32_t>(std::clamp(guess, 0.0, static_cast<double>(count)));
    while (result > 0 && lattice.along(axis, result - 1) >= place) --result;
    while (result < count && lattice.along(axis, result) < place) ++result;
    return result;
}

/// As many samples along an axis has a block at most, so that places for a whole one can wait on the stack.
template <int D>
inline constexpr std::uint32_t most_block_side = D == 2 ? 8 : 4;
template <int D>
inline constexpr std::uint32_t most_block_samples = D == 2 ? 8 * 8 : 4 * 4 * 4;

/// Some samples: `count` along each axis from `first` on, each `stride` from the next. The first axis is the fastest.
template <int D>
struct SampleBlock {
    glm::vec<D, std::uint32_t> first{}, count{};
    std::uint32_t stride = 1;

    std::uint32_t samples() const {
        std::uint32_t result = 1;
        for (int i = 0; i < D; ++i) result *= count[i];
        return result;
    }
    glm::vec<D, std::uint32_t> sample(std::uint32_t number) const {
        glm::vec<D, std::uint32_t> result;
        for (int i = 0; i < D; ++i) {
            result[i] = first[i] + stride * (number % count[i]);
            number /= count[i];
        }
        return result;
    }
};

/// What is told of samples. Null where it isn't wanted.
template <int D>
struct SampleValues {
    float* distance = nullptr;         ///< signed
    Vec<D>* gradient = nullptr;        ///< of length 1
    Vec<D>* closest = nullptr;         ///< point of the surface
    std::uint8_t* doubtful = nullptr;  ///< 1 where it is nearly as much inside as outside
};

/// A surface that is baked. Asked from many threads.
template <int D>
class SampleSource {
public:
    virtual ~SampleSource() = default;
    virtual void tell(const SampleBlock<D>& block, const SampleValues<D>& values) const = 0;
    /// Without its sign.
    virtual double distance(const DVec<D>& point) const = 0;
};

}  // namespace abut
