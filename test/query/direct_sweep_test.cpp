// Sweeps of plain shapes of the plane are answered without views: as the views answer, but for rounding and for what
// may go either way.

#include "../oracle/expect.hpp"
#include "../oracle/pair.hpp"
#include "../oracle/random.hpp"
#include "drawn_shapes.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/direct_sweep.hpp>
#include <abut/query/sweep.hpp>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace abut {
namespace {

using oracle::near;
using oracle::Random;

/// How many were answered how.
struct Told {
    int pairs = 0, hits = 0, direct = 0, elsewhere = 0, alike = 0;
};

/// What the views answer of the shapes as they are a moment later.
template <class A, class B>
float distance_at(const A& a, const Vec2& moved_a, const B& b, const Vec2& moved_b) {
    return closest(at(a, Pose2{moved_a}), at(b, Pose2{moved_b})).distance;
}

template <class A, class B>
void compare(const A& a, const Vec2& motion_a, const B& b, const Vec2& motion_b, double doubt, Told& told) {
    const View<2> view_a(view(a)), view_b(view(b));
    const auto direct = sweep(a, motion_a, b, motion_b), of_views = sweep(view_a, motion_a, view_b, motion_b);
    ++told.pairs;
    std::optional<Hit<2>> ignored;
    if (direct_sweep(given(a), motion_a, given(b), motion_b, ignored) != DirectAnswer::unknown) ++told.direct;
    const double length = static_cast<double>(glm::length(motion_a - motion_b));
    if (direct.has_value() != of_views.has_value()) {
        // One of them says that what touches by no more than doubt is a hit.
        ++told.elsewhere;
        const float fraction = (direct ? direct : of_views)->fraction;
        EXPECT_NEAR(distance_at(a, motion_a * fraction, b, motion_b * fraction), 0, doubt);
        return;
    }
    if (!direct) return;
    ++told.hits;
    const double closing = -static_cast<double>(glm::dot(of_views->normal, motion_a - motion_b)) / length;
    EXPECT_NEAR(direct->distance, of_views->distance, doubt / std::max(closing, 0.01));
    EXPECT_NEAR(direct->fraction, direct->distance / length, 1e-6);
    EXPECT_EQ(direct->started_inside, of_views->started_inside);
    // Where a corner meets a corner there are several normals, and features.
    if (direct->feature == of_views->feature && near(direct->normal, of_views->normal, 1e-3)) ++told.alike;
    EXPECT_NEAR(glm::length(direct->normal), 1, 1e-6);
    // Where they meet face to face, all that is on both will do; what is deep in has no such place.
    if (direct->started_inside) return;
    const Vec2 now_a = motion_a * direct->fraction, now_b = motion_b * direct->fraction;
    EXPECT_NEAR(closest(at(a, Pose2{now_a}), direct->point).distance, 0, doubt);
    EXPECT_NEAR(closest(at(b, Pose2{now_b}), direct->point).distance, 0, doubt);
}

/// Motions by which about half of the pairs meet, some of them along an axis, and some none at all.
struct DrawnMotion {
    Vec2 from, motion_a, motion_b;

    DrawnMotion(Random& random, DrawnShapes<2>& shapes) {
        from = shapes.point(random.chance(0.1) ? 2 : 6);
        Vec2 way = shapes.point(2) - from;
        if (shapes.on_grid() && random.chance(0.5)) way[static_cast<int>(random.below(2))] = 0;
        const float stretch =
            shapes.on_grid() ? 0.5f * static_cast<float>(random.below(5)) : random.uniform_float(0, 2);
        motion_b = random.chance(0.5) ? Vec2(0) : shapes.point(3);
        motion_a = way * stretch + motion_b;
    }
};

/// Of pairs of size 1 or so, 8 or less from the origin: the margin of doubt, and a float's rounding.
constexpr double doubt = 5e-5;

TEST(DirectSweep, AnswersAreThoseOfTheViews) {
    Told told;
    for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::amount(20000)); ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        DrawnShapes<2> shapes(random);
        const DrawnMotion motion(random, shapes);
        shapes.draw(
            [&](const auto& a) {
                shapes.draw([&](const auto& b) { compare(a, motion.motion_a, b, motion.motion_b, doubt, told); });
            },
            motion.from);
        if (HasFailure()) return;
    }
    RecordProperty("direct", told.direct);
    RecordProperty("elsewhere", told.elsewhere);
    RecordProperty("alike", told.alike);
    RecordProperty("hits", told.hits);
    EXPECT_GT(told.hits, told.pairs * 3 / 10);
    EXPECT_LT(told.hits, told.pairs * 7 / 10);
    EXPECT_LT(told.elsewhere, told.pairs / 100);
    EXPECT_GT(told.alike, told.hits * 9 / 10);
}

}  // namespace
}  // namespace abut
