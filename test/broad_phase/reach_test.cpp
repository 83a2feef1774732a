// A ray visits every box that it touches: against points along it, and at the corners where rounding decides.

#include "../oracle/random.hpp"
#include "dimensions.hpp"
#include <abut/broad_phase/reach.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <int D>
bool reaches(const Ray<D>& ray, const Aabb<D>& box) {
    double enters = -1;
    const bool result = RayReach<D>(ray).measure(box, enters);
    EXPECT_EQ(result, result && enters >= 0);
    return result;
}

template <int D>
double distance_squared(const Vec<D>& point, const Aabb<D>& box) {
    double result = -1;
    EXPECT_TRUE(BoxReach<D>({point, point}, std::numeric_limits<float>::infinity()).measure(box, result));
    return result;
}

template <class T>
class Reach : public testing::Test {};
TYPED_TEST_SUITE(Reach, Both);

TYPED_TEST(Reach, OfARayInClosedForm) {
    constexpr int D = TypeParam::value;
    const Aabb<D> box{Vec<D>(1), Vec<D>(2)};
    const Vec<D> x(axis<D>(0)), y(axis<D>(1));
    const auto at = [](float first, float others) {
        Vec<D> result(others);
        result[0] = first;
        return result;
    };
    EXPECT_TRUE(reaches<D>({at(0, 1.5f), x}, box));
    EXPECT_TRUE(reaches<D>({at(0, 1.5f), x, 1}, box)) << "ends on the face";
    EXPECT_FALSE(reaches<D>({at(0, 1.5f), x, 0.999f}, box));
    EXPECT_FALSE(reaches<D>({at(0, 1.5f), -x}, box));
    EXPECT_TRUE(reaches<D>({at(0, 2), x}, box)) << "slides along a face";
    EXPECT_TRUE(reaches<D>({at(0, 1), x}, box)) << "slides along a face";
    EXPECT_FALSE(reaches<D>({at(0, 2.0001f), x}, box));
    EXPECT_TRUE(reaches<D>({at(2, 1.5f), x}, box)) << "leaves a face";
    EXPECT_FALSE(reaches<D>({at(2.0001f, 1.5f), x}, box));
    EXPECT_TRUE(reaches<D>({at(1.5f, 1.5f), y}, box)) << "starts inside";
    EXPECT_TRUE(reaches<D>({at(1.5f, 1.5f), y, 0}, box)) << "a point inside";
    EXPECT_TRUE(reaches<D>({at(2, 2), y, 0}, box)) << "a point at the corner";
    EXPECT_FALSE(reaches<D>({at(2.0001f, 2), y, 0}, box));
    EXPECT_TRUE(reaches<D>({at(1.5f, 1.5f), Vec<D>(0)}, box)) << "no direction at all";
    EXPECT_FALSE(reaches<D>({at(1.5f, 2.5f), Vec<D>(0)}, box));
    EXPECT_TRUE(reaches<D>({at(0, 1.5f), x + Vec<D>(axis<D>(1)) * 1e-45f}, box)) << "almost along an axis";
    EXPECT_FALSE(reaches<D>({at(0, 1.5f), x}, Aabb<D>::empty()));
    EXPECT_FALSE(reaches<D>({at(0, 1.5f), x, -1}, box));
    constexpr float far = std::numeric_limits<float>::infinity();
    EXPECT_TRUE(reaches<D>({at(0, 1.5f), x}, {Vec<D>(-far), Vec<D>(far)}));
    EXPECT_TRUE(reaches<D>({at(0, 1.5f), x}, {Vec<D>(1), Vec<D>(far)}));
    EXPECT_FALSE(reaches<D>({at(0, 1.5f), x}, {Vec<D>(-far), Vec<D>(-1)}));
    for (const float bad : {far, -far, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_TRUE(RayReach<D>({at(bad, 1.5f), x}).is_exhausted());
        EXPECT_TRUE(RayReach<D>({at(0, 1.5f), x * bad}).is_exhausted());
        EXPECT_EQ(RayReach<D>({at(0, 1.5f), x, bad}).is_exhausted(), bad != far);
    }
}

TYPED_TEST(Reach, OfARayToEveryPointOnIt) {
    constexpr int D = TypeParam::value;
    oracle::Random random(17);
    int behind = 0, aside = 0;
    for (int repeat = 0; repeat < 20000; ++repeat) {
        const double size = random.power_of_two(-10, 14);
        const Vec<D> a(random.in_cube<D>() * size), b(random.in_cube<D>() * size);
        const Ray<D> ray = Ray<D>::between(a, b);
        // A corner of the box is a point of the ray, rounded outward to floats.
        const double t = random.chance(0.2) ? 1 : random.unit();
        const DVec<D> point = DVec<D>(ray.origin) + DVec<D>(ray.direction) * (t * static_cast<double>(ray.length));
        Aabb<D> box;
        for (int i = 0; i < D; ++i) {
            float beyond = static_cast<float>(point[i]);
            const bool below = random.chance(0.5);
            if (below == (static_cast<double>(beyond) < point[i]))
                beyond = std::nextafter(beyond, below ? HUGE_VALF : -HUGE_VALF);
            const float other = beyond + (below ? -1.0f : 1.0f) * random.uniform_float(0, size);
            box.min[i] = std::min(beyond, other);
            box.max[i] = std::max(beyond, other);
        }
        EXPECT_TRUE(reaches(ray, box)) << "seed 17, repeat " << repeat;
        behind += reaches(Ray<D>{ray.origin, -ray.direction, ray.length}, box) ? 0 : 1;
        aside += reaches(Ray<D>{ray.origin, Vec<D>(random.direction<D>())}, box) ? 0 : 1;
    }
    EXPECT_GT(behind, 5000);
    EXPECT_GT(aside, 5000);
}

TYPED_TEST(Reach, OfARayThatGrazesACorner) {
    constexpr int D = TypeParam::value;
    oracle::Random random(19);
    for (int repeat = 0; repeat < 20000; ++repeat) {
        // With integers, the point is exactly on the ray, and the only one in the box.
        Vec<D> origin(0), direction(0);
        for (int i = 0; i < D; ++i) {
            origin[i] = static_cast<float>(random.below(1000));
            direction[i] = static_cast<float>(1 + random.below(1000)) * (random.chance(0.5) ? 1.0f : -1.0f);
        }
        const float steps = static_cast<float>(1 + random.below(1000));
        const Vec<D> point = origin + direction * steps;
        Aabb<D> box{point, point};
        box.max[0] += 1;
        if ((direction[0] > 0) == (direction[1] > 0))
            box.min[1] -= 1;
        else
            box.max[1] += 1;
        EXPECT_TRUE(reaches<D>({origin, direction}, box)) << "seed 19, repeat " << repeat;
        EXPECT_TRUE(reaches<D>({origin, direction, steps}, box)) << "seed 19, repeat " << repeat;
        EXPECT_FALSE(reaches<D>({origin, direction, steps * 0.999f}, box)) << "seed 19, repeat " << repeat;
    }
}

TYPED_TEST(Reach, OfAPointInClosedForm) {
    constexpr int D = TypeParam::value;
    const Aabb<D> box{Vec<D>(1), Vec<D>(2)};
    EXPECT_EQ(distance_squared(Vec<D>(1.5f), box), 0);
    EXPECT_EQ(distance_squared(Vec<D>(2), box), 0);
    EXPECT_EQ(distance_squared(Vec<D>(4), box), 4.0 * D);
    EXPECT_EQ(distance_squared(Vec<D>(0), box), D);
    EXPECT_EQ(distance_squared(Vec<D>(3e38f), {Vec<D>(-3e38f), Vec<D>(-3e38f)}), D * std::pow(2 * double{3e38f}, 2));
    double measure = 0;
    constexpr float far = std::numeric_limits<float>::infinity();
    const Aabb<D> endless{Vec<D>(-far), Vec<D>(far)};
    EXPECT_TRUE(BoxReach<D>(endless, 0).measure(endless, measure));
    EXPECT_EQ(measure, 0);
    EXPECT_TRUE(BoxReach<D>(box, 0).measure(endless, measure));
    EXPECT_EQ(measure, 0);
    EXPECT_TRUE(BoxReach<D>(box, 1).measure(Aabb<D>{Vec<D>(2), Vec<D>(3)}, measure));
    EXPECT_FALSE(BoxReach<D>(box, 1).measure(Aabb<D>{Vec<D>(3.01f), Vec<D>(4)}, measure));
    EXPECT_TRUE(BoxReach<D>(box, -1).is_exhausted());
    EXPECT_TRUE(BoxReach<D>(box, std::numeric_limits<float>::quiet_NaN()).is_exhausted());
    EXPECT_TRUE(BoxReach<D>(Aabb<D>::empty(), 1).is_exhausted());
}

}  // namespace
}  // namespace abut::test
