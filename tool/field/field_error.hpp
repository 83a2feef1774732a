#pragma once

// Measures the interpolation error of a field.

#include <abut/bake/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <functional>

namespace abut::tool {

template <int D>
using Baker = std::function<Result<Field<D>>(const FieldOptions<D>&)>;

/// Error statistics over sample points; lengths in the field's units.
struct FieldError {
    std::size_t points = 0;
    double root_mean_square = 0, largest = 0;
    std::size_t wrong_side = 0;  ///< count of points with the wrong sign
};

struct FieldErrors {
    FieldError near;    ///< points at most one cell from the surface
    FieldError volume;  ///< all points
};

/// Compares the field with exact samples of a second grid over the same volume, some tens of thousands, each at a
/// different offset in its cell. Returns a Problem if the volume is too small for that, and the Problems of `bake`.
template <int D>
Result<FieldErrors> measure_error(const Field<D>& field, const Baker<D>& bake, Executor* executor);

}  // namespace abut::tool
