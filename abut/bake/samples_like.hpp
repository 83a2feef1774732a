#pragma once

// Where the samples of a field lie that is made of another one. For .cpp files.

#include <abut/bake/field.hpp>
#include <abut/field/field.hpp>

#include <cmath>

namespace abut {

/// The options with a cell and a volume, the samples of which are those of `like` where it has that cell.
template <int D>
FieldOptions<D> samples_like(FieldOptions<D> options, const Field<D>& like, Aabb<D> volume) {
    if (options.cell == 0) options.cell = like.cell();
    if (options.volume) return options;
    const double cell = static_cast<double>(options.cell);
    for (int i = 0; i < D && options.cell == like.cell(); ++i) {
        const double origin = static_cast<double>(like.data().origin[i]), low = static_cast<double>(volume.min[i]);
        volume.min[i] = static_cast<float>(origin - cell * std::ceil((origin - low) / cell - 1e-6));
    }
    for (int i = 0; i < D; ++i) {
        // A side that is as good as whole cells gets no cell more.
        const double cells = (static_cast<double>(volume.max[i]) - static_cast<double>(volume.min[i])) / cell;
        if (std::abs(cells - std::nearbyint(cells)) < 1e-3)
            volume.max[i] =
                static_cast<float>(static_cast<double>(volume.min[i]) + cell * (std::nearbyint(cells) - 0.01));
    }
    options.volume = volume;
    return options;
}

}  // namespace abut
