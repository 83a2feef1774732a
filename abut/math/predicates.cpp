// Exact predicates: double decides nearly always, and expansions of doubles decide where an error bound leaves it open.
//
// Error bounds use u = 2^-53, the relative rounding error of a double operation. Nothing underflows or overflows: a
// float is a multiple of 2^-149 below 2^128, so products of three are multiples of 2^-447 below 2^384, and products of
// differences are below 2^387.

#include <abut/math/dvec.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <array>
#include <cmath>
#include <cstddef>

namespace abut {
namespace {

using detail::DVec;

int sign(double value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// rounded + error == a + b, exactly (Knuth).
struct Sum {
    double rounded, error;
};

Sum two_sum(double a, double b) {
    const double sum = a + b, b_in_sum = sum - a;
    return {sum, (a - (sum - b_in_sum)) + (b - b_in_sum)};
}

/// rounded + error == a * b, exactly (Dekker).
Sum two_product(double a, double b) {
    const auto upper_half = [](double x) {
        const double scaled = 0x1.0000002p27 * x;
        return scaled - (scaled - x);
    };
    const double product = a * b, a_high = upper_half(a), a_low = a - a_high, b_high = upper_half(b),
                 b_low = b - b_high;
    return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// An expansion: an exact sum of up to 48 doubles as nonoverlapping components of increasing magnitude, none of them
/// zero. The last component has the sign of the sum.
class Expansion {
public:
    void add(double term) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Sum sum = two_sum(term, parts_[i]);
            if (sum.error != 0) parts_[count++] = sum.error;
            term = sum.rounded;
        }
        if (term != 0) parts_[count++] = term;
        count_ = count;
    }

    /// Adds the product of a double `product` (of two floats) and a float.
    void add_product(double product, double factor) {
        // Two halves of 26 bits (Dekker), times 24: neither product is rounded.
        const double scaled = 0x1.0000002p27 * product;
        const double high = scaled - (scaled - product), low = product - high;
        add(high * factor);
        add(low * factor);
    }

    int sign() const { return count_ == 0 ? 0 : abut::sign(parts_[count_ - 1]); }

private:
    std::array<double, 48> parts_;
    std::size_t count_ = 0;
};

bool is_exact(const DVec<2>& from, const DVec<2>& to) {
    return two_sum(to.x, -from.x).error == 0 && two_sum(to.y, -from.y).error == 0;
}

/// If the differences are exact, as between floats of usual exponents, two products decide: rounding is monotonic, and
/// equal rounded products are decided by their errors. Otherwise the determinant of | a 1 |, | b 1 |, | c 1 | is
/// expanded into six products of two floats, which are exact in double.
int exact_orientation(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
    if (is_exact(a, b) && is_exact(a, c)) {
        const DVec<2> p = b - a, q = c - a;
        const Sum left = two_product(p.x, q.y), right = two_product(p.y, q.x);
        return left.rounded != right.rounded ? sign(left.rounded - right.rounded) : sign(left.error - right.error);
    }
    Expansion sum;
    const auto add_cross = [&](const DVec<2>& p, const DVec<2>& q) {
        sum.add(p.x * q.y);
        sum.add(-p.y * q.x);
    };
    add_cross(a, b);
    add_cross(b, c);
    add_cross(c, a);
    return sum.sign();
}

/// The determinant of four rows: [b c d] - [a c d] + [a b d] - [a b c], where [p q r] = dot(cross(p, q), r).
int exact_orientation(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& d) {
    Expansion sum;
    const auto add_triple = [&](const DVec<3>& p, const DVec<3>& q, const DVec<3>& r) {
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            sum.add_product(p[j] * q[k], r[i]);
            sum.add_product(-p[k] * q[j], r[i]);
        }
    };
    add_triple(b, c, d);
    add_triple(c, a, d);
    add_triple(a, b, d);
    add_triple(b, a, c);
    return sum.sign();
}

}  // namespace

int detail::triangle_orientation(const Vec2& a, const Vec2& b, const Vec2& c) {
    const DVec<2> p = DVec<2>(b) - DVec<2>(a), q = DVec<2>(c) - DVec<2>(a);
    const double left = p.x * q.y, right = p.y * q.x, turn = left - right;
    // Each product of two rounded differences is off by 3 u; the final difference adds u. The bound is twice the
    // first-order error, 8 u; it is 0 only if both products are exactly 0.
    const double bound = 0x1p-50 * (std::abs(left) + std::abs(right));
    if (std::abs(turn) >= bound) return sign(turn);
    return exact_orientation(DVec<2>(a), DVec<2>(b), DVec<2>(c));
}

int detail::tetrahedron_orientation(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    const DVec<3> p = DVec<3>(b) - DVec<3>(a), q = DVec<3>(c) - DVec<3>(a), r = DVec<3>(d) - DVec<3>(a);
    double volume = 0, magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double left = p[j] * q[k], right = p[k] * q[j];
        volume += (left - right) * r[i];
        magnitude += (std::abs(left) + std::abs(right)) * std::abs(r[i]);
    }
    // left and right: 3 u; their difference: 4 u; times r[i], a difference: 6 u; the two sums: 8 u. The bound is twice
    // that.
    if (std::abs(volume) >= 0x1p-49 * magnitude) return sign(volume);
    return exact_orientation(DVec<3>(a), DVec<3>(b), DVec<3>(c), DVec<3>(d));
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
    const DVec<2> from(a), to(b), p = to - from, q = c - from;
    const double left = p.x * q.y, right = p.y * q.x, turn = left - right;
    if (std::abs(turn) >= 0x1p-50 * (std::abs(left) + std::abs(right))) return sign(turn);  // as above
    Expansion sum;
    const auto add_product = [&](double factor, double number) {
        const Sum product = two_product(factor, number);
        sum.add(product.error);
        sum.add(product.rounded);
    };
    sum.add(from.x * to.y);
    sum.add(-from.y * to.x);
    add_product(to.x, c.y);
    add_product(-to.y, c.x);
    add_product(-from.x, c.y);
    add_product(from.y, c.x);
    return sum.sign();
}

int sign_of_sum(double a, double b, double c) {
    // a + b is off by at most half an ulp. If c nearly cancels it, the next sum is exact and not smaller than that; the
    // rounding error decides only if the sum is 0.
    const Sum two = two_sum(a, b);
    const double three = two.rounded + c;
    return sign(three != 0 ? three : two.error);
}

}  // namespace abut::detail
