// The bounding boxes of an AnyShape: without a view those of the view, bit for bit, and with a margin of 1e-6 of their
// size.

#include "../oracle/random.hpp"
#include <abut/broad_phase/boxes.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/capsule.hpp>

#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace abut::test {
namespace {

using oracle::Random;

template <int D>
Vec<D> point_in(Random& random, double size) {
    return Vec<D>(random.in_cube<D>() * size);
}

template <int D>
std::vector<AnyShape<D>> some_shapes(Random& random) {
    const double size = random.power_of_two(-6, 6);
    const auto length = [&] { return random.uniform_float(0, size); };
    const Vec<D> middle = random.chance(0.5) ? Vec<D>(0.0f) : point_in<D>(random, size);
    const Vec<D> half = glm::abs(point_in<D>(random, size));
    return {Ball<D>{middle, length()}, Box<D>{middle, half}, Box<D>{middle, half, random.rotation<D>()},
            Capsule<D>{middle, point_in<D>(random, size), length()}};
}

template <int D>
void expect_bounds(const AnyShape<D>& shape, const Pose<D>& pose) {
    const View<D> placed = shape.placed(pose);
    const Aabb<D> box = shape.bounds(pose), grown = shape.bounds_for_queries(pose);
    if (!detail::is_finite(placed)) {
        EXPECT_TRUE(detail::is_empty(box) && detail::is_empty(grown));
        return;
    }
    EXPECT_EQ(box, detail::bounds(placed));
    double size = 0;
    for (int i = 0; i < D; ++i) size += static_cast<double>(box.max[i]) - static_cast<double>(box.min[i]);
    const double margin = 1e-6 * size;
    for (int i = 0; i < D; ++i) {
        // The box is rounded outwards once or twice.
        for (const auto& [at, far] : {std::pair(-box.min[i], -grown.min[i]), std::pair(box.max[i], grown.max[i])}) {
            const double step = std::abs(static_cast<double>(at)) * 0x1p-23 + 1e-30;
            EXPECT_GE(static_cast<double>(far), static_cast<double>(at) + 0.99 * margin - step);
            EXPECT_LE(static_cast<double>(far), static_cast<double>(at) + 1.01 * margin + 2 * step);
            EXPECT_GE(far, at);
        }
    }
}

template <class T>
class AnyShapeBounds : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(AnyShapeBounds, Dimensions);

TYPED_TEST(AnyShapeBounds, AreThoseOfTheView) {
    constexpr int D = TypeParam::value;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const std::vector<AnyShape<D>> shapes = some_shapes<D>(random);
        Pose<D> pose{point_in<D>(random, random.power_of_two(-6, 20)), random.rotation<D>()};
        for (const AnyShape<D>& shape : shapes) expect_bounds(shape, pose);
        const float infinity = std::numeric_limits<float>::infinity();
        pose.position[0] = random.chance(0.5) ? infinity : std::numeric_limits<float>::quiet_NaN();
        for (const AnyShape<D>& shape : shapes) expect_bounds(shape, pose);
        ASSERT_FALSE(testing::Test::HasFailure());
    }
}

TYPED_TEST(AnyShapeBounds, OfNumbersThatAreNotFiniteAreEmpty) {
    constexpr int D = TypeParam::value;
    const Vec<D> zero(0.0f);
    for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()})
        for (const AnyShape<D>& shape :
             std::vector<AnyShape<D>>{Ball<D>{zero, bad}, Box<D>{zero, Vec<D>(bad)}, Capsule<D>{zero, zero, bad},
                                      Capsule<D>{zero, Vec<D>(bad), 1}, Capsule<D>{Vec<D>(bad), zero, 1}})
            EXPECT_TRUE(detail::is_empty(shape.bounds_for_queries({})) && detail::is_empty(shape.bounds({})));
}

}  // namespace
}  // namespace abut::test
