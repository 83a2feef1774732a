#include <abut/math/detail/exact_orientation.hpp>
#include <abut/math/detail/expansion.hpp>
#include <abut/math/predicates.hpp>

#include <cmath>

namespace abut::detail {
namespace {

/// The exact difference of two doubles as a sum of two. The second is mostly 0, as meshes are made of floats.
struct ExactDifference {
    double parts[2];

    ExactDifference(double a, double b) {
        const ExactSum sum = two_sum(a, -b);
        parts[0] = sum.rounded;
        parts[1] = sum.error;
    }
};

/// Adds sign * p * q * r.
template <std::size_t N>
void add_product(Expansion<N>& sum, const ExactDifference& p, const ExactDifference& q, const ExactDifference& r,
                 double sign) {
    for (const double x : p.parts)
        for (const double y : q.parts) {
            if (x == 0 || y == 0) continue;
            const ExactSum product = two_product(sign * x, y);
            for (const double part : {product.error, product.rounded})
                for (const double z : r.parts) {
                    if (part == 0 || z == 0) continue;
                    const ExactSum triple = two_product(part, z);
                    sum.add(triple.error);
                    sum.add(triple.rounded);
                }
        }
}

int side_by_expansion(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& d) {
    const auto minus_a = [&](const DVec<3>& v) {
        return std::array{ExactDifference(v.x, a.x), ExactDifference(v.y, a.y), ExactDifference(v.z, a.z)};
    };
    const auto p = minus_a(b), q = minus_a(c), r = minus_a(d);
    Expansion<200> sum;  // 6 products of three sums of two doubles: at most 192 parts
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        add_product(sum, p[j], q[k], r[i], 1);
        add_product(sum, p[k], q[j], r[i], -1);
    }
    return sum.sign();
}

}  // namespace

// Error bounds use u = 2^-53, the relative rounding error of a double operation, and are twice the first-order error.

int exact_side(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, const DVec<3>& d) {
    const DVec<3> p = b - a, q = c - a, r = d - a;
    double volume = 0, magnitude = 0;
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        const double left = p[j] * q[k], right = p[k] * q[j];
        volume += (left - right) * r[i];
        magnitude += (std::abs(left) + std::abs(right)) * std::abs(r[i]);
    }
    // left and right: 3 u; their difference: 4 u; times r[i], a difference: 6 u; the two sums: 8 u.
    if (std::abs(volume) >= 0x1p-49 * magnitude) return sign_of(volume);
    return side_by_expansion(a, b, c, d);
}

int exact_turn(const DVec<2>& a, const DVec<2>& b, const DVec<2>& c) {
    const DVec<2> p = b - a, q = c - a;
    const double left = p.x * q.y, right = p.y * q.x, turn = left - right;
    // Each product of two rounded differences is off by 3 u; the final difference adds u. The bound is 0 only if both
    // products are exactly 0.
    if (std::abs(turn) >= 0x1p-50 * (std::abs(left) + std::abs(right))) return sign_of(turn);
    // If p and q are exact, so is the difference of the products, which are nearly equal.
    if (p + a == b && p - b == -a && q + a == c && q - c == -a)
        return sign_of_sum(turn, two_product(p.x, q.y).error, -two_product(p.y, q.x).error);
    const ExactDifference one(1, 0);
    Expansion<16> sum;
    add_product(sum, ExactDifference(b.x, a.x), ExactDifference(c.y, a.y), one, 1);
    add_product(sum, ExactDifference(b.y, a.y), ExactDifference(c.x, a.x), one, -1);
    return sum.sign();
}

int exact_turn(const DVec<3>& a, const DVec<3>& b, const DVec<3>& c, int axis) {
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    return exact_turn(DVec<2>(a[i], a[j]), DVec<2>(b[i], b[j]), DVec<2>(c[i], c[j]));
}

}  // namespace abut::detail
