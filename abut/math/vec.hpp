#pragma once

// Vector types: glm's vectors, float in the public interface and double inside.

#include <cfloat>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>

namespace abut {

/// A point, a displacement or a direction in D dimensions.
template <int D>
using Vec = glm::vec<D, float>;
using Vec2 = Vec<2>;
using Vec3 = Vec<3>;

// glm's configuration macros change the layout or type of its vectors, or how a function takes them, which would break
// the binary interface of the library.
static_assert(sizeof(Vec2) == 2 * sizeof(float) && sizeof(Vec3) == 3 * sizeof(float) && alignof(Vec3) == alignof(float),
              "abut needs glm's packed vectors: build without GLM_FORCE_DEFAULT_ALIGNED_GENTYPES");
static_assert(
    std::is_trivially_copyable_v<Vec2> && std::is_trivially_copyable_v<Vec3>,
    "abut needs glm's vectors to be passed in registers: build without GLM_FORCE_CTOR_INIT and GLM_FORCE_CXX98");
static_assert(std::is_same_v<glm::length_t, int>,
              "abut needs glm's lengths to be int: build without GLM_FORCE_SIZE_T_LENGTH");

// What is inline in headers needs it of the user's flags, as the library does of its own. Only x87 arithmetic lacks it.
static_assert(FLT_EVAL_METHOD == 0,
              "abut needs numbers without excess precision: on i386 build with -msse2 -mfpmath=sse");

}  // namespace abut

namespace abut::detail {

/// A double vector, for internal arithmetic.
template <int D>
using DVec = glm::vec<D, double>;

template <int D>
bool is_finite(const Vec<D>& v) {
    for (int i = 0; i < D; ++i)
        if (!std::isfinite(v[i])) return false;
    return true;
}

}  // namespace abut::detail
