#pragma once

// Where the samples of a field lie, told by the options. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/bake/field_samples.hpp>
#include <abut/field/field_data.hpp>
#include <abut/math/result.hpp>

#include <cstdint>

namespace abut {

/// As many samples are kept at most.
inline constexpr double most_field_samples = 2147483648.0;

/// A field without samples yet: its place, cell, size, store and look-up. A Problem where an option is outside of its
/// limits, or where so many samples would be kept before the surface is even looked at.
template <int D>
Result<FieldData<D>> field_grid(const Aabb<D>& surface, const FieldOptions<D>& options);

template <int D>
SampleLattice<D> lattice_of(const FieldData<D>& field) {
    return {DVec<D>(field.origin), static_cast<double>(field.cell)};
}

/// How many samples a dense field has along each axis.
template <int D>
glm::vec<D, std::uint32_t> samples_along(const FieldData<D>& field) {
    return field.cells + 1u;
}
/// How many blocks a sparse one has.
template <int D>
glm::vec<D, std::uint32_t> blocks_along(const FieldData<D>& field) {
    return field.cells / brick_cells<D>;
}
/// The number of an item in rows whose first axis is the fastest.
template <int D>
std::size_t number_of(const glm::vec<D, std::uint32_t>& item, const glm::vec<D, std::uint32_t>& along) {
    std::size_t result = item[D - 1];
    for (int i = D - 2; i >= 0; --i) result = result * along[i] + item[i];
    return result;
}
template <int D>
glm::vec<D, std::uint32_t> item_of(std::size_t number, const glm::vec<D, std::uint32_t>& along) {
    glm::vec<D, std::uint32_t> result;
    for (int i = 0; i < D; ++i) {
        result[i] = static_cast<std::uint32_t>(number % along[i]);
        number /= along[i];
    }
    return result;
}
template <int D>
std::size_t count_of(const glm::vec<D, std::uint32_t>& along) {
    std::size_t result = 1;
    for (int i = 0; i < D; ++i) result *= along[i];
    return result;
}

}  // namespace abut
