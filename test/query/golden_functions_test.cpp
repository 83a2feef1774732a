// The golden hash of queries on user-defined distance functions, whose arithmetic is in double with no function but the
// square root.

#include "../oracle/random.hpp"
#include "hash.hpp"
#include "user_functions.hpp"
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// Each random number is drawn in a statement of its own, because compilers evaluate arguments in any order.
template <int D>
class WholeNumberFunctions {
public:
    explicit WholeNumberFunctions(std::uint64_t seed) : random_(seed) {}

    float number(std::uint32_t most) {
        return static_cast<float>(static_cast<int>(random_.below(2 * most + 1)) - static_cast<int>(most)) / 128;
    }
    float size() { return (1 + static_cast<float>(random_.below(64))) / 32; }
    Vec<D> point() {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = number(256);
        return result;
    }
    Pose<D> pose() {
        Pose<D> result;
        if constexpr (D == 2) {
            result.rotation.cos = number(100);
            result.rotation.sin = number(100) + 1;
        } else {
            for (int i = 0; i < 4; ++i) result.rotation[i] = number(100) + (i == 0 ? 1.0f : 0.0f);
        }
        result.position = point();
        return result;
    }
    AnyShape<D> function() {
        const std::uint32_t which = random_.below(3);
        const Vec<D> a = point(), b = point();
        const float size = this->size();
        const Pose<D> pose = this->pose();
        if (which == 0) return users::Blob<D>{a, size};
        if (which == 1) return at(users::Brick<D>{Vec<D>(size)}, pose);
        return users::Pill<D>{a, b, size};
    }
    AnyShape<D> other() {
        const std::uint32_t which = random_.below(5);
        const Vec<D> a = point(), b = point(), c = point();
        const float size = this->size();
        const Pose<D> pose = this->pose();
        if (which == 0) return Ball<D>{a, size};
        if (which == 1) return Capsule<D>{a, b, size};
        if (which == 2) return at(Box<D>{a, Vec<D>(size)}, pose);
        if (which == 3) return Triangle<D>{a, b, c};
        Vec<D> up(0.0f);
        up[1] = 1;
        return HalfSpace<D>{up, size};
    }

private:
    oracle::Random random_;
};

template <int D>
std::uint64_t hash_of_function_answers() {
    WholeNumberFunctions<D> draw(31);
    Hash hash;
    for (int i = 0; i < 400; ++i) {
        const AnyShape<D> a = draw.function(), b = draw.other(), c = draw.function();
        const Vec<D> from = draw.point(), to = draw.point(), motion = draw.point();
        add_closest(hash, closest(a, b));
        add_contact(hash, contact(b, a));
        hash.add(std::uint64_t{overlaps(a, b)});
        add_hit(hash, raycast(Ray<D>::between(from, to), a));
        if (i % 8 != 0) continue;
        add_closest(hash, closest(a, c));
        add_hit(hash, sweep(a, motion, b));
        add_hit(hash, sweep(b, motion, a));
    }
    return hash.value();
}

TEST(GoldenFunctions, InThePlane) {
    EXPECT_EQ(hash_of_function_answers<2>(), 4666311006806654711u);
}
TEST(GoldenFunctions, InSpace) {
    EXPECT_EQ(hash_of_function_answers<3>(), 10480205314412349084u);
}

}  // namespace
}  // namespace abut
