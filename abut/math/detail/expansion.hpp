#pragma once

// Expansion arithmetic: exact sums and products of doubles (Shewchuk: "Adaptive precision floating-point arithmetic and
// fast robust geometric predicates", 1997). For .cpp files.

#include <array>
#include <cstddef>

namespace abut::detail {

inline int sign_of(double value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

/// rounded + error == a + b, exactly (Knuth).
struct ExactSum {
    double rounded, error;
};

inline ExactSum two_sum(double a, double b) {
    const double sum = a + b, b_in_sum = sum - a;
    return {sum, (a - (sum - b_in_sum)) + (b - b_in_sum)};
}

/// rounded + error == a * b, exactly (Dekker).
inline ExactSum two_product(double a, double b) {
    const auto upper_half = [](double x) {
        const double scaled = 0x1.0000002p27 * x;
        return scaled - (scaled - x);
    };
    const double product = a * b, a_high = upper_half(a), a_low = a - a_high, b_high = upper_half(b),
                 b_low = b - b_high;
    return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

/// An exact sum of up to N doubles as nonoverlapping components of increasing magnitude, none of them zero. The last
/// component has the sign of the sum.
template <std::size_t N>
class Expansion {
public:
    void add(double term) {
        std::size_t count = 0;
        for (std::size_t i = 0; i < count_; ++i) {
            const ExactSum sum = two_sum(term, parts_[i]);
            if (sum.error != 0) parts_[count++] = sum.error;
            term = sum.rounded;
        }
        if (term != 0) parts_[count++] = term;
        count_ = count;
    }

    int sign() const { return count_ == 0 ? 0 : sign_of(parts_[count_ - 1]); }

private:
    std::array<double, N> parts_;
    std::size_t count_ = 0;
};

}  // namespace abut::detail
