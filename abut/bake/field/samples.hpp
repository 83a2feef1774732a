#pragma once

// The interface from which a field is baked: signed distances at the samples of a lattice. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut::detail {

/// A regular lattice of samples: along an axis, sample i has the coordinate origin + cell * i.
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

/// The first of `count` samples along an axis whose coordinate is at least `place`, else `count`.
template <int D>
std::uint32_t first_at_or_after(const SampleLattice<D>& lattice, int axis, double place, std::uint32_t count) {
    const double guess = std::ceil((place - lattice.origin[axis]) / lattice.cell);
    auto result = static_cast<std::uint32_t>(std::clamp(guess, 0.0, static_cast<double>(count)));
    while (result > 0 && lattice.along(axis, result - 1) >= place) --result;
    while (result < count && lattice.along(axis, result) < place) ++result;
    return result;
}

/// The maximum number of samples of a block along an axis; arrays for one block fit on the stack.
template <int D>
inline constexpr std::uint32_t max_block_side = D == 2 ? 8 : 4;
template <int D>
inline constexpr std::uint32_t max_block_samples = D == 2 ? 8 * 8 : 4 * 4 * 4;

/// A block of samples: `count` along each axis from `first` on, `stride` apart. The first axis is the fastest.
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

/// Output arrays for samples. A quantity that is not requested is null.
template <int D>
struct SampleValues {
    float* distance = nullptr;          ///< signed
    Vec<D>* gradient = nullptr;         ///< unit length
    Vec<D>* closest = nullptr;          ///< closest point of the surface
    std::uint8_t* uncertain = nullptr;  ///< 1 if the sign is uncertain
};

/// A surface to be baked. All functions may run on many threads.
template <int D>
class SampleSource {
public:
    virtual ~SampleSource() = default;
    virtual void evaluate(const SampleBlock<D>& block, const SampleValues<D>& values) const = 0;
    /// The unsigned distance.
    virtual double distance(const DVec<D>& point) const = 0;
};

}  // namespace abut::detail
