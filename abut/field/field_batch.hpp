#pragma once

// Many look-ups at once, bit by bit as one by one. For .cpp files.

#include <abut/field/field_data.hpp>
#include <abut/math/vec.hpp>
#include <abut/shape/distance_function.hpp>

#include <span>

namespace abut {

void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<float> out);
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<float> out);
void look_up_all(const FieldData<2>& data, std::span<const Vec2> points, std::span<FieldSample<2>> out);
void look_up_all(const FieldData<3>& data, std::span<const Vec3> points, std::span<FieldSample<3>> out);

}  // namespace abut
