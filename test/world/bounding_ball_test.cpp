// Bounding balls contain their shapes at all scales and positions, and never separate shapes that touch.

#include "support/random_shapes.hpp"
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/world/detail/bounding_ball.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

template <class S>
auto ball_of(const S& shape) {
    return detail::bounding_ball(View<dimension<S>>(view(shape)));
}

template <int D>
void expect_ball(const BoundingBall<D>& ball, const DVec<D>& center, double radius) {
    EXPECT_LE(length(ball.center - center), 1e-6 * radius);
    EXPECT_GE(ball.radius, radius);
    EXPECT_LE(ball.radius, 1.0002 * radius);
}

TEST(BoundingBall, OfKnownShapesIsTheLeast) {
    expect_ball<3>(ball_of(Sphere{{1, 2, 3}, 4}), {1, 2, 3}, 4);
    expect_ball<2>(ball_of(Segment2{{0, 0}, {6, 8}}), {3, 4}, 5);
    expect_ball<3>(ball_of(Capsule3{{0, 0, -2}, {0, 0, 4}, 1}), {0, 0, 1}, 4);
    expect_ball<3>(ball_of(Box3{{1, 1, 1}, {2, 3, 6}}), {1, 1, 1}, 7);
    expect_ball<2>(ball_of(rounded(Box2{{0, 0}, {3, 4}}, 0.5f)), {0, 0}, 5.5);
    expect_ball<3>(ball_of(Cylinder{{0, 0, 0}, {0, 8, 0}, 3}), {0, 4, 0}, 5);
    expect_ball<3>(ball_of(stretched(Sphere{{1, 0, 0}, 1}, {2, 1, 3})), {2, 0, 0}, 3);
    expect_ball<3>(ball_of(at(Aabb3{{0, 0, 0}, {2, 4, 4}}, {{9, 9, 9}, turn_about({0, 0, 1}, 0)})), {10, 11, 11}, 3);
    expect_ball<2>(ball_of(stairs<2>(4, 3)), {6, 6}, std::sqrt(72.0));
    EXPECT_TRUE(std::isinf(ball_of(HalfSpace2{{1, 0}, 5}).radius));
}

TEST(BoundingBall, ApartIsMoreThanTouching) {
    const auto ball = [](double x, double radius) { return BoundingBall<2>{{x, 0}, radius}; };
    EXPECT_TRUE(detail::apart(ball(0, 1), ball(3, 1)));
    EXPECT_FALSE(detail::apart(ball(0, 1), ball(2, 1)));
    EXPECT_FALSE(detail::apart(ball(0, 1), ball(1, 1)));
    constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(detail::apart(ball(0, infinity), ball(1e300, 1)));
    EXPECT_FALSE(detail::apart(ball(0, nan), ball(1e300, 1)));
    EXPECT_FALSE(detail::apart(ball(nan, 1), ball(0, 1)));
}

/// Passes a view of a shape of any kind, size and position, with its ball, to `take`.
template <int D, class Take>
void with_placed(oracle::Random& random, double size, const Pose<D>& pose, Take&& take) {
    with_random_shape<D>(random, random_kind<D>(random, 0.1), [&](const auto& shape) {
        const View<D> own = mapped(View<D>(view(shape)), scaling<D>(Vec<D>(static_cast<float>(size))));
        take(mapped(own, affine(pose)), detail::moved(detail::bounding_ball(own), affine(pose)));
    });
}

template <int D>
void expect_holds(oracle::Random& random, const Convex<D>& convex, const BoundingBall<D>& ball) {
    for (int i = 0; i < 12; ++i) {
        const DVec<D> towards = i < 2 * D ? axis<D>(i / 2, i % 2 == 0 ? 1 : -1) : random.direction<D>();
        const DVec<D> farthest = support(convex, towards);
        EXPECT_LE(length(farthest - ball.center), ball.radius);
    }
}

template <int D>
void expect_balls_hold_shapes(std::uint64_t seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    const double size = random.power_of_two(-10, 14), far = random.power_of_two(-10, 20);
    with_placed<D>(random, size, random_pose<D>(random, far), [&](const View<D>& shape, const BoundingBall<D>& ball) {
        if (const auto* convex = std::get_if<Convex<D>>(&shape)) expect_holds(random, *convex, ball);
        if (const auto* composite = std::get_if<Composite<D>>(&shape)) {
            const Aabb<D> everywhere{Vec<D>(-std::numeric_limits<float>::infinity()),
                                     Vec<D>(std::numeric_limits<float>::infinity())};
            each_part<D>(*composite, everywhere, [&](const Convex<D>& part, std::uint32_t) {
                expect_holds(random, part, ball);
                return true;
            });
        }
    });
}

TEST(BoundingBall, HoldsItsShape) {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        expect_balls_hold_shapes<2>(seed);
        expect_balls_hold_shapes<3>(seed);
    }
}

/// A user's composite of one box, whose bounds are an ulp too small by rounding.
struct Crate {
    Aabb3 box;
};
Aabb3 bounds(const Crate& crate) {
    Aabb3 result = crate.box;
    for (int i = 0; i < 3; ++i) {
        result.min[i] = std::nextafter(result.min[i], result.max[i]);
        result.max[i] = std::nextafter(result.max[i], result.min[i]);
    }
    return result;
}
template <class F>
void each_part(const Crate& crate, const Aabb3&, F&& visit) {
    visit(crate.box, 0u);
}

TEST(BoundingBall, AllowsForRoundedBoundsFarOut) {
    const Crate crate{{Vec3(999999.0f), Vec3(1000001.0f)}};
    const BoundingBall<3> ball = ball_of(crate);
    oracle::Random random(1);
    expect_holds(random, view(crate.box), ball);
    EXPECT_LE(length(DVec<3>(crate.box.max) - ball.center), ball.radius);
}

struct PairCounts {
    int apart = 0, touching = 0, close = 0;
};

/// Tests pairs of shapes whose balls nearly touch.
template <int D>
void check_pair(std::uint64_t seed, PairCounts& seen) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    const double size_a = random.power_of_two(-10, 14), size_b = size_a * random.power_of_two(-4, 4);
    const double far = random.chance(0.3) ? random.power_of_two(0, 20) : 0;
    const Pose<D> pose_a = random_pose<D>(random, far);
    with_placed<D>(random, size_a, pose_a, [&](const View<D>& a, const BoundingBall<D>& ball_a) {
        if (std::holds_alternative<HalfSpaceView<D>>(a)) return;
        const DVec<D> towards = random.direction<D>();
        const Pose<D> turned{Vec<D>(0.0f), random.rotation<D>()};
        with_placed<D>(random, size_b, turned, [&](const View<D>& b, const BoundingBall<D>& ball_b) {
            if (std::holds_alternative<HalfSpaceView<D>>(b)) return;
            const double reach = (ball_a.radius + ball_b.radius) * (1 + random.uniform(-1, 1) * 1e-3) *
                                 (random.chance(0.5) ? 1 : random.uniform(0.3, 1));
            Affine<D> shift;
            shift.offset = ball_a.center - ball_b.center + towards * reach;
            const View<D> moved_b = mapped(b, shift);
            const bool balls_apart = detail::apart(ball_a, detail::moved(ball_b, shift));
            const bool touch = overlaps(a, moved_b), contacts = static_cast<bool>(contact(a, moved_b));
            EXPECT_FALSE(balls_apart && (touch || contacts));
            seen.apart += balls_apart ? 1 : 0;
            seen.touching += touch ? 1 : 0;
        });
    });
}

TEST(BoundingBall, NeverPartsWhatTouches) {
    PairCounts seen;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        check_pair<2>(seed, seen);
        check_pair<3>(seed, seen);
    }
    EXPECT_GT(seen.apart, 700);
    EXPECT_GT(seen.touching, 500);
}

/// Tests balls, which fill their bounding balls, that touch exactly, overlap slightly, or have a slight gap.
template <int D>
void check_round_pair(std::uint64_t seed, PairCounts& seen) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    oracle::Random random(seed);
    const float radius_a = static_cast<float>(random.power_of_two(-10, 14)),
                radius_b = static_cast<float>(random.power_of_two(-10, 14));
    const Vec<D> center_a = random.chance(0.5) ? Vec<D>(0.0f) : to_float(random.in_cube<D>() * 1e6);
    const double reach = static_cast<double>(radius_a) + static_cast<double>(radius_b);
    const DVec<D> towards = random.chance(0.3) ? axis<D>(0) : random.direction<D>();
    const Vec<D> center_b = to_float(DVec<D>(center_a) + towards * (reach * (1 + random.uniform(-2e-4, 4e-4))));
    const Ball<D> a{center_a, radius_a}, b{center_b, radius_b};
    const bool balls_apart = detail::apart(ball_of(a), ball_of(b));
    EXPECT_FALSE(balls_apart && (overlaps(a, b) || contact(a, b)));
    seen.apart += balls_apart ? 1 : 0;
    seen.touching += overlaps(a, b) ? 1 : 0;
    seen.close += !balls_apart && !overlaps(a, b) ? 1 : 0;
}

TEST(BoundingBall, NeverPartsBallsThatTouch) {
    PairCounts seen;
    for (std::uint64_t seed = 0; seed < 5000; ++seed) {
        check_round_pair<2>(seed, seen);
        check_round_pair<3>(seed, seen);
    }
    EXPECT_GT(seen.apart, 2000);
    EXPECT_GT(seen.touching, 2000);
    EXPECT_GT(seen.close, 200);
}

}  // namespace
}  // namespace abut::test
