// User-defined distance functions against the library's shapes of the same form, their twins: every query, every kind
// of other shape, any scale, far from the origin.

#include "../oracle/random.hpp"
#include "user_functions.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/triangle.hpp>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

/// A function and its twin at the same pose.
template <int D>
struct Twins {
    AnyShape<D> function, twin;
};

template <int D>
class Drawn {
public:
    Drawn(std::uint64_t seed, double scale, double far) : random_(seed), scale_(scale), far_(far) {}

    oracle::Random& random() { return random_; }
    /// A random pose within `reach`, in units of the scale, of the center.
    Pose<D> pose(double reach) {
        Pose<D> result;
        result.rotation = random_.rotation<D>();
        result.position = to_float((DVec<D>(far_) + random_.in_cube<D>() * reach) * scale_);
        return result;
    }
    Twins<D> twins(double reach) {
        const Pose<D> pose = this->pose(reach);
        switch (random_.below(3)) {
            case 0: {
                users::Blob<D> blob;
                blob.center = point(0.5);
                blob.radius = length(0.1, 1.5);
                return placed(blob, pose);
            }
            case 1: {
                users::Brick<D> brick;
                for (int i = 0; i < D; ++i) brick.half[i] = length(0.1, 1.5);
                return placed(brick, pose);
            }
            default: {
                users::Pill<D> pill;
                pill.a = point(1);
                pill.b = point(1);
                pill.radius = length(0.1, 0.9);
                return placed(pill, pose);
            }
        }
    }
    AnyShape<D> other(double reach) {
        const Pose<D> pose = this->pose(reach);
        switch (random_.below(6)) {
            case 0: {
                const Vec<D> center = point(0.5);
                return at(Ball<D>{center, length(0.1, 1.5)}, pose);
            }
            case 1: {
                const Vec<D> a = point(1), b = point(1);
                return at(Capsule<D>{a, b, length(0.05, 0.5)}, pose);
            }
            case 2: {
                Vec<D> half;
                for (int i = 0; i < D; ++i) half[i] = length(0.1, 1.5);
                return at(Box<D>{Vec<D>(0.0f), half}, pose);
            }
            case 3: {
                const Vec<D> a = point(1), b = point(1), c = point(1);
                return at(Triangle<D>{a, b, c}, pose);
            }
            case 4: {
                std::vector<Vec<D>> points;
                for (int i = 0; i < 12; ++i) points.push_back(point(1));
                if constexpr (D == 2)
                    return at(*Polygon::build(points), pose);
                else
                    return at(*Polyhedron::build(points), pose);
            }
            default: {
                const DVec<D> normal = random_.direction<D>();
                const double offset = dot(normal, DVec<D>(pose.position));
                return HalfSpace<D>{to_float(normal), static_cast<float>(offset)};
            }
        }
    }
    Vec<D> point(double reach) { return to_float(random_.in_cube<D>() * (reach * scale_)); }
    float length(double least, double most) { return random_.uniform_float(least * scale_, most * scale_); }

private:
    template <class S>
    static Twins<D> placed(const S& shape, const Pose<D>& pose) {
        return {at(shape, pose), at(shape.twin(), pose)};
    }

    oracle::Random random_;
    double scale_, far_;
};

/// The tolerance of a function's answers if a search reaches its iteration limit.
template <int D>
double tolerance_of(const AnyShape<D>& a, const AnyShape<D>& b, double scale, double far) {
    return 1e-3 * std::min(size(a.view()), size(b.view())) + 1e-6 * far * scale;
}

struct Scale {
    double scale, far;
};
constexpr std::array<Scale, 4> scales{{{1, 0}, {1e-3, 0}, {1e4, 0}, {1, 100}}};

template <class T>
class FunctionTwins : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(FunctionTwins, Dimensions);

TYPED_TEST(FunctionTwins, DistancesAndContacts) {
    constexpr int D = TypeParam::value;
    for (const auto& [scale, far] : scales) {
        Drawn<D> drawn(11, scale, far);
        int overlapping = 0, apart = 0;
        constexpr int count = D == 2 ? 400 : 250;
        for (int i = 0; i < count; ++i) {
            SCOPED_TRACE(testing::Message() << "seed 11, scale " << scale << ", far " << far << ", pair " << i);
            const auto [function, twin] = drawn.twins(1.5);
            const AnyShape<D> other = drawn.other(1.5);
            const double allowed = tolerance_of(twin, other, scale, far);
            const Closest<D> found = closest(function, other), expected = closest(twin, other);
            const auto distance = static_cast<double>(found.distance), truth = static_cast<double>(expected.distance);
            if (truth > 0) {
                EXPECT_NEAR(distance, truth, allowed);
                ++apart;
            } else {
                // The depth is not larger than the minimal separating translation.
                EXPECT_LE(distance, allowed);
                EXPECT_GE(distance, truth - allowed);
                ++overlapping;
            }
            EXPECT_NEAR(length(DVec<D>(found.normal)), 1, 1e-5);
            const DVec<D> across = DVec<D>(found.on_b) - DVec<D>(found.on_a) - DVec<D>(found.normal) * distance;
            EXPECT_LE(length(across), allowed);
            EXPECT_TRUE(certify(function, other, found));
            const Closest<D> turned = closest(other, function);
            EXPECT_NEAR(static_cast<double>(turned.distance), distance, allowed);
            if (std::abs(distance) > allowed) {
                EXPECT_EQ(overlaps(function, other), distance <= 0);
            }
            const Contact<D> contact = abut::contact(function, other);
            if (std::abs(distance) > allowed) {
                EXPECT_EQ(static_cast<bool>(contact), distance <= 0);
            }
            if (contact) {
                EXPECT_NEAR(static_cast<double>(contact.depth), -distance, allowed);
                double deepest = -1;
                for (const ContactPoint<D>& point : contact.points)
                    deepest = std::max(deepest, static_cast<double>(point.depth));
                EXPECT_NEAR(deepest, static_cast<double>(contact.depth), allowed);
                int contacts = 0;
                each_contact(function, other, [&](const Contact<D>&) { ++contacts; });
                EXPECT_EQ(contacts, 1);
            }
        }
        EXPECT_GT(overlapping, count / 5);
        EXPECT_GT(apart, count / 5);
    }
}

TYPED_TEST(FunctionTwins, PointsAndRays) {
    constexpr int D = TypeParam::value;
    for (const auto& [scale, far] : scales) {
        Drawn<D> drawn(12, scale, far);
        int hits = 0, inside = 0;
        constexpr int count = 4000;
        for (int i = 0; i < count; ++i) {
            SCOPED_TRACE(testing::Message() << "seed 12, scale " << scale << ", far " << far << ", ray " << i);
            const auto [function, twin] = drawn.twins(0.5);
            const double allowed = 2e-5 * scale + 1e-6 * far * scale;
            const Vec<D> from = drawn.pose(3).position, to = drawn.pose(1.5).position;
            const auto depth = static_cast<double>(closest(twin, from).distance);
            if (std::abs(depth) > allowed) {
                EXPECT_EQ(contains(function, from), depth < 0);
            }
            inside += depth < 0 ? 1 : 0;
            if (std::abs(depth) <= allowed) continue;
            const Ray<D> ray = Ray<D>::between(from, to);
            const std::optional<Hit<D>> hit = raycast(ray, function), expected = raycast(ray, twin);
            // Twins may differ in a start inside, which depends on the direction out.
            if (depth < 0) {
                if (hit) {
                    EXPECT_TRUE(hit->fraction == 0 && hit->started_inside);
                }
                continue;
            }
            hits += expected ? 1 : 0;
            if (hit.has_value() != expected.has_value()) {
                // The answers differ only if the ray grazes, or ends on, the surface.
                const Hit<D>& one = hit ? *hit : *expected;
                const double slant = std::abs(dot(DVec<D>(one.normal), DVec<D>(ray.direction)));
                EXPECT_TRUE(slant < 0.03 || one.fraction > 0.999f) << slant << " " << one.fraction;
                continue;
            }
            if (!hit) continue;
            const double slant = std::abs(dot(DVec<D>(expected->normal), DVec<D>(ray.direction)));
            const double along = static_cast<double>(hit->distance) - static_cast<double>(expected->distance);
            EXPECT_LE(std::abs(along) * slant, allowed);
            EXPECT_LE(dot(DVec<D>(hit->normal), DVec<D>(ray.direction)), 0);
            EXPECT_FALSE(hit->started_inside);
        }
        EXPECT_GT(hits, count / 8);
        EXPECT_GT(inside, count / 100);
    }
}

TYPED_TEST(FunctionTwins, Sweeps) {
    constexpr int D = TypeParam::value;
    for (const auto& [scale, far] : scales) {
        Drawn<D> drawn(13, scale, far);
        int hits = 0, misses = 0;
        constexpr int count = D == 2 ? 120 : 60;
        for (int i = 0; i < count; ++i) {
            SCOPED_TRACE(testing::Message() << "seed 13, scale " << scale << ", far " << far << ", sweep " << i);
            const Twins<D> both = drawn.twins(0.5);
            const AnyShape<D>&function = both.function, &twin = both.twin;
            const AnyShape<D> other = drawn.other(4);
            if (closest(twin, other).distance <= 0) continue;
            const double allowed = 2 * tolerance_of(twin, other, scale, far);
            // The motion goes to a point near the other shape, and a little farther.
            const DVec<D> displacement = DVec<D>(drawn.pose(1).position) - DVec<D>(center(bounds(other)));
            const Vec<D> motion = to_float(is_finite(to_float(displacement)) && size(other.view()) < 1e5 * scale
                                               ? displacement * 1.25
                                               : drawn.random().template direction<D>() * (4 * scale));
            const std::optional<Hit<D>> expected = sweep(other, motion, twin), hit = sweep(other, motion, function);
            (expected ? hits : misses) += 1;
            // The distance at a fraction, such as the reported one.
            const auto apart = [&](float fraction) {
                Pose<D> moved;
                moved.position = motion * fraction;
                return static_cast<double>(closest(at(other, moved), twin).distance);
            };
            if (hit) {
                EXPECT_NEAR(apart(hit->fraction), 0, allowed);
                EXPECT_LE(dot(DVec<D>(hit->normal), DVec<D>(motion)), 1e-3 * scale);
                if (expected) {
                    EXPECT_LE(hit->fraction, 1.0f);
                }
            } else if (expected) {
                // The motion only grazes.
                EXPECT_GT(apart(1), -allowed);
                for (int k = 0; k <= 32; ++k) EXPECT_GT(apart(static_cast<float>(k) / 32), -allowed);
            }
            if (hit && expected) {
                for (int k = 0; k < 16; ++k) EXPECT_GE(apart(hit->fraction * static_cast<float>(k) / 16), -allowed);
            }
            // Now the function is the mover.
            const std::optional<Hit<D>> turned = sweep(function, -motion, other);
            if (hit && turned) {
                EXPECT_NEAR(apart(turned->fraction), 0, allowed);
            }
            // The motion has a rotation.
            const Pose<D> from, to = drawn.pose(2);
            Pose<D> near = to;
            near.position -= to_float(DVec<D>(far * scale));
            const std::optional<Hit<D>> rotating = sweep(other, from, near, function, Pose<D>{}, Pose<D>{}),
                                        truth = sweep(other, from, near, twin, Pose<D>{}, Pose<D>{});
            if (rotating && truth) {
                EXPECT_NEAR(static_cast<double>(rotating->fraction), static_cast<double>(truth->fraction), 0.02);
            }
        }
        EXPECT_GT(hits, count / 10);
        EXPECT_GT(misses, count / 10);
    }
}

/// Under similarity transforms and rounding, the function agrees with its twin.
TYPED_TEST(FunctionTwins, ScaledAndRounded) {
    constexpr int D = TypeParam::value;
    oracle::Random random(14);
    for (int i = 0; i < 300; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 14, pair " << i);
        users::Brick<D> brick;
        for (int k = 0; k < D; ++k) brick.half[k] = random.uniform_float(0.2, 1.5);
        const float scale = random.uniform_float(0.1, 4), radius = random.uniform_float(0, 0.5);
        Pose<D> pose;
        pose.rotation = random.rotation<D>();
        pose.position = to_float(random.in_cube<D>());
        const auto there = at(rounded(stretched(brick, Vec<D>(scale)), radius), pose);
        const auto twin = at(rounded(stretched(brick.twin(), Vec<D>(scale)), radius), pose);
        const Ball<D> ball{to_float(random.in_cube<D>() * 6.0), random.uniform_float(0.1, 1)};
        const auto truth = static_cast<double>(closest(twin, ball).distance);
        if (truth > 0) {
            EXPECT_NEAR(static_cast<double>(closest(there, ball).distance), truth, 2e-5);
        }
        for (int k = 0; k < D; ++k) EXPECT_NEAR(bounds(there).min[k], bounds(twin).min[k], 1e-5f);
    }
}

/// A non-uniformly stretched function has the twin's zero set, and a lower bound of its distance.
TYPED_TEST(FunctionTwins, StretchedIsALowerBound) {
    constexpr int D = TypeParam::value;
    oracle::Random random(15);
    for (int i = 0; i < 500; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 15, point " << i);
        Vec<D> factors;
        for (int k = 0; k < D; ++k) factors[k] = random.uniform_float(0.25, 3);
        const users::Brick<D> brick;
        const auto there = stretched(brick, factors), twin = stretched(brick, factors);
        const Box<D> box{Vec<D>(0.0f), factors};
        const Vec<D> point = to_float(random.in_cube<D>() * 4.0);
        const auto truth = static_cast<double>(closest(box, point).distance);
        const auto found = static_cast<double>(closest(there, point).distance);
        EXPECT_LE(std::abs(found), std::abs(truth) + 1e-5);
        if (std::abs(truth) > 1e-4) {
            EXPECT_EQ(contains(twin, point), truth < 0);
        }
        const Ray<D> ray = Ray<D>::between(point, Vec<D>(0.0f));
        const auto hit = raycast(ray, there), expected = raycast(ray, box);
        if (truth > 1e-3) {
            ASSERT_TRUE(hit && expected);
            EXPECT_NEAR(hit->distance, expected->distance, 1e-4f);
        }
    }
}

}  // namespace
}  // namespace abut
