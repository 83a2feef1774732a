#pragma once

// How far what a field tells between its samples is from the truth.

#include <abut/bake/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/result.hpp>

#include <cstddef>
#include <functional>

namespace abut::tool {

template <int D>
using Baker = std::function<Result<Field<D>>(const FieldOptions<D>&)>;

/// Of some points; as lengths.
struct FieldError {
    std::size_t points = 0;
    double root_mean_square = 0, largest = 0;
    std::size_t wrong_side = 0;  ///< of the points: the field has them on the other side of the surface
};

struct FieldErrors {
    FieldError near;    ///< of the points no farther than a cell from the surface
    FieldError volume;  ///< of all
};

/// The truth are the exact samples of a second grid over the same volume, some tens of thousands: each of its places
/// lies elsewhere in a cell. A Problem where that is too little to be cut, or as `bake` has it.
template <int D>
Result<FieldErrors> measure_error(const Field<D>& field, const Baker<D>& bake, Executor* executor);

}  // namespace abut::tool
