#pragma once

// Run-time dispatch of function templates over the dimension: HWY_EXPORT takes only names without template arguments.
// For .cpp files that Highway compiles once for each SIMD target.

/// In the namespace of a target: the names `function_2` and `function_3` for function<2> and function<3>.
#define ABUT_NAME_DIMENSIONS(function)          \
    constexpr auto& function##_2 = function<2>; \
    constexpr auto& function##_3 = function<3>

/// Once, after all targets: dispatched_function<D>() returns a pointer to function<D> of the best target.
#define ABUT_EXPORT_DIMENSIONS(function)                \
    HWY_EXPORT(function##_2);                           \
    HWY_EXPORT(function##_3);                           \
    template <int D>                                    \
    auto dispatched_##function() {                      \
        if constexpr (D == 2)                           \
            return &HWY_DYNAMIC_DISPATCH(function##_2); \
        else                                            \
            return &HWY_DYNAMIC_DISPATCH(function##_3); \
    }                                                   \
    static_assert(true)
