#pragma once

// Vectors of other types, such as a game's own, converted to glm's and back.

#include <abut/math/vec.hpp>

#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace abut {
namespace detail {

// Argument-dependent lookup alone finds the functions of the user.
void to_vec() = delete;
void from_vec() = delete;

template <class V>
concept HasOwnToVec = requires(const V& v) {
    requires std::same_as<decltype(to_vec(v)), Vec2> || std::same_as<decltype(to_vec(v)), Vec3>;
};

template <class V, int D>
concept HasOwnFromVec = requires(const Vec<D>& v, V& out) {
    from_vec(v, out);
};

/// The dimension of a vector by its members x, y and z; 0 if it has none, or a fourth.
template <class V>
constexpr int dimension_by_members() {
    constexpr bool has_xy = requires(const V& v) {
        static_cast<float>(v.x);
        static_cast<float>(v.y);
    };
    constexpr bool has_z = requires(const V& v) {
        static_cast<float>(v.z);
    };
    constexpr bool has_w = requires(const V& v) {
        v.w;
    };
    if constexpr (has_xy && !has_w)
        return has_z ? 3 : 2;
    else
        return 0;
}

/// The dimension of an array or of a class with operator[]: the number of elements that fill it, if this is 2 or 3.
template <class V>
constexpr int dimension_by_index() {
    if constexpr (!std::is_pointer_v<V> && requires(const V& v) { static_cast<float>(v[0]); }) {
        constexpr std::size_t element = sizeof(std::declval<const V&>()[0]);
        constexpr bool is_filled = sizeof(V) == 2 * element || sizeof(V) == 3 * element;
        return is_filled ? static_cast<int>(sizeof(V) / element) : 0;
    } else {
        return 0;
    }
}

template <class V>
constexpr int vector_dimension = dimension_by_members<V>() != 0 ? dimension_by_members<V>() : dimension_by_index<V>();

/// The type of to_vec: an object, which argument-dependent lookup never finds.
struct ToVec {
    template <class V>
    requires(HasOwnToVec<V> || vector_dimension<V> != 0) constexpr auto operator()(const V& v) const {
        if constexpr (HasOwnToVec<V>)
            return to_vec(v);
        else if constexpr (dimension_by_members<V>() == 2)
            return Vec2(static_cast<float>(v.x), static_cast<float>(v.y));
        else if constexpr (dimension_by_members<V>() == 3)
            return Vec3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
        else if constexpr (vector_dimension<V> == 2)
            return Vec2(static_cast<float>(v[0]), static_cast<float>(v[1]));
        else
            return Vec3(static_cast<float>(v[0]), static_cast<float>(v[1]), static_cast<float>(v[2]));
    }
};

}  // namespace detail

/// `to_vec(v)` is the Vec2 or Vec3 with the coordinates of `v`, rounded to float. `v` has members `x`, `y` and maybe
/// `z`, but no `w`; or it is an array or a class with operator[] that two or three elements fill. For other types, and
/// where both differ, the user declares a function `abut::Vec3 to_vec(const V&)` in the namespace of `V`.
inline constexpr detail::ToVec to_vec;

/// The vector of type `V` with the coordinates of `v`, by the rules of to_vec: its members or elements are assigned. A
/// class without a default constructor, or whose members are constant, is constructed from the coordinates. For other
/// types the user declares a function `void from_vec(const abut::Vec3&, V& out)` in the namespace of `V`.
template <class V, int D>
requires(detail::HasOwnFromVec<V, D> || detail::vector_dimension<V> == D) constexpr V
    from_vec(const glm::vec<D, float>& v) {
    if constexpr (detail::HasOwnFromVec<V, D>) {
        V result{};
        from_vec(v, result);
        return result;
    } else if constexpr (!std::default_initializable<V> || !std::is_copy_assignable_v<V>) {
        if constexpr (D == 2)
            return V{v.x, v.y};
        else
            return V{v.x, v.y, v.z};
    } else if constexpr (detail::dimension_by_members<V>() == D) {
        V result{};
        result.x = static_cast<decltype(result.x)>(v.x);
        result.y = static_cast<decltype(result.y)>(v.y);
        if constexpr (D == 3) result.z = static_cast<decltype(result.z)>(v.z);
        return result;
    } else {
        V result{};
        using Element = std::remove_cvref_t<decltype(result[0])>;
        result[0] = static_cast<Element>(v.x);
        result[1] = static_cast<Element>(v.y);
        if constexpr (D == 3) result[2] = static_cast<Element>(v.z);
        return result;
    }
}

}  // namespace abut
