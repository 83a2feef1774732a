#pragma once

// The lattice of a field's samples, from the options. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/bake/field/samples.hpp>
#include <abut/field/data.hpp>
#include <abut/field/field.hpp>
#include <abut/math/result.hpp>

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace abut::detail {

/// The maximum number of samples that a field stores.
inline constexpr double max_field_samples = 2147483648.0;

/// A field without samples: origin, cell, size, store and look-up. A Problem if an option is outside its limits, or if
/// the lattice alone would have too many samples.
template <int D>
Result<FieldData<D>> field_grid(const Aabb<D>& surface, const FieldOptions<D>& options);

template <int D>
SampleLattice<D> lattice_of(const FieldData<D>& field) {
    return {DVec<D>(field.origin), static_cast<double>(field.cell)};
}

/// The number of samples of a dense field along each axis.
template <int D>
glm::vec<D, std::uint32_t> samples_along(const FieldData<D>& field) {
    return field.cells + 1u;
}
/// The number of blocks of a sparse field along each axis.
template <int D>
glm::vec<D, std::uint32_t> blocks_along(const FieldData<D>& field) {
    return field.cells / brick_cells<D>;
}
/// The row-major index of an item; the first axis is the fastest.
template <int D>
std::size_t linear_index(const glm::vec<D, std::uint32_t>& item, const glm::vec<D, std::uint32_t>& along) {
    std::size_t result = item[D - 1];
    for (int i = D - 2; i >= 0; --i) result = result * along[i] + item[i];
    return result;
}
template <int D>
glm::vec<D, std::uint32_t> grid_index(std::size_t number, const glm::vec<D, std::uint32_t>& along) {
    glm::vec<D, std::uint32_t> result;
    for (int i = 0; i < D; ++i) {
        result[i] = static_cast<std::uint32_t>(number % along[i]);
        number /= along[i];
    }
    return result;
}
template <int D>
std::size_t grid_size(const glm::vec<D, std::uint32_t>& along) {
    std::size_t result = 1;
    for (int i = 0; i < D; ++i) result *= along[i];
    return result;
}

/// Completes the options of a field that is made from another one. If the cell is that of `like`, the samples coincide
/// with those of `like`.
template <int D>
FieldOptions<D> aligned_options(FieldOptions<D> options, const Field<D>& like, Aabb<D> volume) {
    if (options.cell == 0) options.cell = like.cell();
    if (options.volume) return options;
    const double cell = static_cast<double>(options.cell);
    for (int i = 0; i < D && options.cell == like.cell(); ++i) {
        const double origin = static_cast<double>(like.data().origin[i]), low = static_cast<double>(volume.min[i]);
        volume.min[i] = static_cast<float>(origin - cell * std::ceil((origin - low) / cell - 1e-6));
    }
    for (int i = 0; i < D; ++i) {
        // A side within a thousandth of a whole number of cells is not rounded up.
        const double cells = (static_cast<double>(volume.max[i]) - static_cast<double>(volume.min[i])) / cell;
        if (std::abs(cells - std::nearbyint(cells)) < 1e-3)
            volume.max[i] =
                static_cast<float>(static_cast<double>(volume.min[i]) + cell * (std::nearbyint(cells) - 0.01));
    }
    options.volume = volume;
    return options;
}

}  // namespace abut::detail
