#pragma once

// The surface of a field, as pieces: segments in the plane, triangles in space. For .cpp files.

#include <abut/field/field.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/vec.hpp>

#include <array>
#include <vector>

namespace abut {

/// Around all cells in which the interpolated distance changes its sign; empty where it does so nowhere.
template <int D>
Aabb<D> zero_box(const FieldData<D>& data);

/// Where the distance is 0, linear in the simplices of Kuhn's (1960) cut of every cell. No gap between cells of the
/// same brick or of neighbouring ones.
template <int D>
std::vector<std::array<Vec<D>, D>> zero_set(const FieldData<D>& data);

}  // namespace abut
