#pragma once

// The zero level set of a field as segments in 2D and triangles in 3D. For .cpp files.

#include <abut/field/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <vector>

namespace abut::detail {

/// The box around all cells in which the interpolated distance changes its sign; empty if there are none.
template <int D>
Aabb<D> isosurface_bounds(const FieldData<D>& data);

/// Extracts the zero level set by marching simplices: each cell is cut into Kuhn's (1960) simplices, in which the
/// distance is linear. It has no gaps between cells of the same brick or of neighbouring ones.
template <int D>
std::vector<std::array<Vec<D>, D>> isosurface(const FieldData<D>& data);

}  // namespace abut::detail
