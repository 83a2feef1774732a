// Exact predicates of floats, by those of doubles. Differences of floats are multiples of 2^-149 below 2^129, so
// nothing underflows or overflows: products of three are multiples of 2^-447 below 2^387.

#include <abut/math/detail/exact_orientation.hpp>
#include <abut/math/detail/expansion.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/library_entry.hpp>

namespace abut {

int detail::triangle_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    return exact_turn(DVec<2>(a), DVec<2>(b), DVec<2>(c));
}

int detail::tetrahedron_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    return exact_side(DVec<3>(a), DVec<3>(b), DVec<3>(c), DVec<3>(d));
}

bool on_line(const Vec2& a, const Vec2& b, const Vec2& p) {
    detail::enter_library();
    return orientation(a, b, p) == 0;
}

bool on_line(const Vec3& a, const Vec3& b, const Vec3& p) {
    detail::enter_library();
    // The three coordinates of cross(b - a, p - a), each from projections of the points along an axis.
    const auto projection_on_line = [&](int x, int y) {
        return orientation(Vec2(a[x], a[y]), Vec2(b[x], b[y]), Vec2(p[x], p[y])) == 0;
    };
    return projection_on_line(0, 1) && projection_on_line(1, 2) && projection_on_line(2, 0);
}

bool in_plane(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
    detail::enter_library();
    return orientation(a, b, c, p) == 0;
}

}  // namespace abut

namespace abut::detail {

int turn_towards(const Vec2& a, const Vec2& b, const DVec<2>& c) {
    return exact_turn(DVec<2>(a), DVec<2>(b), c);
}

int sign_of_sum(double a, double b, double c) {
    // a + b is off by at most half an ulp. If c nearly cancels it, the next sum is exact and not smaller than that; the
    // rounding error decides only if the sum is 0.
    const ExactSum two = two_sum(a, b);
    const double three = two.rounded + c;
    return sign_of(three != 0 ? three : two.error);
}

}  // namespace abut::detail
