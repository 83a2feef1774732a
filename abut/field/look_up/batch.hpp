#pragma once

// Batched look-ups, bit by bit equal to single ones. For .cpp files.

#include <abut/field/data.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/view/distance_function.hpp>

#include <span>

namespace abut::detail {

void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<float> out);
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<float> out);
void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<FieldSample<2>> out);
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<FieldSample<3>> out);

}  // namespace abut::detail
