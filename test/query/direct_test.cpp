// The closed forms of plain shapes agree with the queries on their views, except for rounding.

#include "../oracle/pair.hpp"
#include "../oracle/random.hpp"
#include "drawn_shapes.hpp"
#include <abut/query/certify.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

struct ComparisonCounts {
    int pairs = 0, overlapping = 0, rays = 0, hits = 0, at_corners = 0;
};

constexpr double rounding = 1e-6;

template <int D>
void expect_near(const Vec<D>& direct, const Vec<D>& of_views) {
    for (int i = 0; i < D; ++i) EXPECT_NEAR(direct[i], of_views[i], rounding);
}

template <int D>
void expect_near(const Closest<D>& direct, const Closest<D>& of_views) {
    EXPECT_NEAR(direct.distance, of_views.distance, rounding);
    expect_near<D>(direct.on_a, of_views.on_a);
    expect_near<D>(direct.on_b, of_views.on_b);
    // Where two corners touch, several normals are right.
    if (std::abs(direct.distance) <= rounding) return;
    expect_near<D>(direct.normal, of_views.normal);
    EXPECT_EQ(direct.feature_a, of_views.feature_a);
    EXPECT_EQ(direct.feature_b, of_views.feature_b);
}

template <int D>
void expect_near(const Contact<D>& direct, const Contact<D>& of_views) {
    expect_near<D>(direct.normal, of_views.normal);
    EXPECT_NEAR(direct.depth, of_views.depth, rounding);
    EXPECT_EQ(direct.feature_a, of_views.feature_a);
    EXPECT_EQ(direct.feature_b, of_views.feature_b);
    ASSERT_EQ(direct.points.size(), of_views.points.size());
    for (std::size_t i = 0; i < direct.points.size(); ++i) {
        expect_near<D>(direct.points[i].position, of_views.points[i].position);
        EXPECT_NEAR(direct.points[i].depth, of_views.points[i].depth, rounding);
        EXPECT_EQ(direct.points[i].feature, of_views.points[i].feature);
    }
}

/// A ray that hits a corner may report either side; one that ends at the surface may miss.
template <int D>
void expect_near(const std::optional<Hit<D>>& direct, const std::optional<Hit<D>>& of_views, ComparisonCounts& counts) {
    if (direct.has_value() != of_views.has_value()) {
        EXPECT_NEAR((direct ? direct : of_views)->fraction, 1, rounding);
        return;
    }
    if (!direct) return;
    EXPECT_NEAR(direct->fraction, of_views->fraction, rounding);
    EXPECT_NEAR(direct->distance, of_views->distance, rounding);
    expect_near<D>(direct->point, of_views->point);
    EXPECT_EQ(direct->started_inside, of_views->started_inside);
    ++counts.hits;
    if (direct->feature != of_views->feature)
        ++counts.at_corners;
    else
        expect_near<D>(direct->normal, of_views->normal);
}

/// All answers about one pair.
template <int D>
struct PairAnswers {
    bool overlap;
    Closest<D> closest, closest_untraced;
    Contact<D> contact, contact_within;
};

template <class A, class B>
PairAnswers<dimension<A>> answers_of(const A& a, const B& b, float margin) {
    return {overlaps(a, b), closest(a, b), closest(a, b, {.trace = nullptr}), contact(a, b),
            contact(a, b, {.margin = margin})};
}

template <int D>
void compare(const PairAnswers<D>& direct, const View<D>& a, const View<D>& b, float margin, ComparisonCounts& counts) {
    const PairAnswers<D> of_views = answers_of(a, b, margin);
    ++counts.pairs;
    counts.overlapping += of_views.overlap ? 1 : 0;
    EXPECT_EQ(direct.overlap, of_views.overlap);
    expect_near(direct.closest, of_views.closest);
    expect_near(direct.contact, of_views.contact);
    expect_near(direct.contact_within, of_views.contact_within);
    expect_near(direct.closest_untraced, of_views.closest_untraced);
}

template <class D>
class Direct : public testing::Test {
protected:
    /// Calls check(random, shapes) for many seeds.
    template <class Check>
    void for_each_seed(const Check& check) {
        for (std::uint64_t seed = 0; seed < static_cast<std::uint64_t>(oracle::case_count(8000)); ++seed) {
            SCOPED_TRACE(seed);
            Random random(seed);
            DrawnShapes<D::value> shapes(random);
            check(random, shapes);
            if (HasFatalFailure()) return;
        }
    }
};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(Direct, Dimensions);

TYPED_TEST(Direct, AnswersOfPairsAreThoseOfTheirViews) {
    constexpr int D = TypeParam::value;
    ComparisonCounts counts;
    this->for_each_seed([&](Random& random, DrawnShapes<D>& shapes) {
        const float margin = random.uniform_float(0, 0.5);
        shapes.draw([&](const auto& a) {
            shapes.draw([&](const auto& b) { compare<D>(answers_of(a, b, margin), view(a), view(b), margin, counts); });
        });
    });
    EXPECT_GT(counts.overlapping, counts.pairs * 3 / 10);
    EXPECT_LT(counts.overlapping, counts.pairs * 7 / 10);
}

TYPED_TEST(Direct, RaysAndPointsTooAreThoseOfTheViews) {
    constexpr int D = TypeParam::value;
    ComparisonCounts counts;
    this->for_each_seed([&](Random&, DrawnShapes<D>& shapes) {
        shapes.draw([&](const auto& shape) {
            const View<D> as_view(view(shape));
            const Vec<D> from = shapes.point(4), to = shapes.point(0.5);
            if (from != to) {
                const Ray<D> ray = Ray<D>::between(from, to);
                expect_near<D>(raycast(ray, shape), raycast(ray, as_view), counts);
                ++counts.rays;
            }
            expect_near(closest(shape, from), closest(as_view, View<D>(round_points<D>({from}, 0))));
        });
    });
    EXPECT_GT(counts.hits, counts.rays * 15 / 100);
    EXPECT_LT(counts.hits, counts.rays * 8 / 10);
    EXPECT_LT(counts.at_corners, counts.hits / 50);
}

// A cache must not change answers, whether it holds the last state of the pair or that of another pair.

template <int D>
void expect_same_from(Cache& cache, const auto& a, const auto& b, ComparisonCounts& counts) {
    const View<D> view_a(view(a)), view_b(view(b));
    const Closest<D> anew = closest(view_a, view_b);
    ++counts.pairs;
    counts.overlapping += anew.distance < 0 ? 1 : 0;
    const Closest<D> found = closest(a, b, {.cache = &cache});
    EXPECT_NEAR(found.distance, anew.distance, rounding);
    EXPECT_NEAR(glm::dot(found.on_b - found.on_a, found.normal), anew.distance, 4 * rounding);
    EXPECT_TRUE(certify(view_a, view_b, found).holds);
    if (std::abs(anew.distance) < 1e-5f) return;
    EXPECT_EQ(overlaps(a, b, {.cache = &cache}), anew.distance < 0);
    EXPECT_NEAR(contact(a, b, {.cache = &cache}).depth, std::max(-anew.distance, 0.0f), rounding);
    const float margin = 0.25f;
    if (std::abs(anew.distance - margin) < 1e-5f) return;
    const Contact<D> near = contact(a, b, {.cache = &cache, .margin = margin});
    EXPECT_EQ(static_cast<bool>(near), anew.distance < margin);
    if (!near) return;
    EXPECT_NEAR(near.depth, -anew.distance, rounding);
}

TYPED_TEST(Direct, AnswersFromACacheAreThoseAnew) {
    constexpr int D = TypeParam::value;
    ComparisonCounts counts;
    this->for_each_seed([&](Random& random, DrawnShapes<D>& shapes) {
        Cache cache;
        if (random.chance(0.2)) {
            cache.count = 1 + random.below(2);
            for (std::size_t i = 0; i < 2; ++i) {
                cache.corner_a[i] = random.below(5);
                cache.corner_b[i] = random.below(5);
            }
        }
        const Vec<D> step = to_float<D>(random.direction<D>() * 0.05);
        const Rotation<D> turned = random.rotation<D>();
        if (random.chance(0.5)) {
            const Box<D> a{shapes.point(1), shapes.half(), shapes.rotation()};
            Box<D> b{shapes.point(1.5), shapes.half(), shapes.rotation()};
            for (int i = 0; i < 8; ++i, b.center += step) {
                if (i == 4) b.rotation = turned;
                expect_same_from<D>(cache, a, b, counts);
            }
        } else {
            std::vector<Vec<D>> of_a(4 + random.below(6)), of_b(4 + random.below(6));
            for (Vec<D>& p : of_a) p = shapes.point(1);
            for (Vec<D>& p : of_b) p = shapes.point(1);
            const BuiltHull<D> a = *BuiltHull<D>::build(of_a), b = *BuiltHull<D>::build(of_b);
            Pose<D> pose{shapes.point(1.5), shapes.rotation()};
            for (int i = 0; i < 8; ++i, pose.position += step) {
                if (i == 4) pose.rotation = turned;
                expect_same_from<D>(cache, a, at(b, pose), counts);
            }
        }
    });
    EXPECT_GT(counts.overlapping, counts.pairs / 5);
    EXPECT_LT(counts.overlapping, counts.pairs * 4 / 5);
}

// Corner against corner, the bounding balls of two boxes are hardly larger than the boxes.
TEST(DirectBoxes, ThatMeetWithTheirCornersAreNotRefusedByTheirBalls) {
    for (const float half : {1.0f, 0.7f, 1.5f}) {
        const Box3 a{{0, 0, 0}, {1, 1, 1}};
        const auto beside = [&](float gap) { return Box3{Vec3(1 + half + gap), Vec3(half)}; };
        EXPECT_TRUE(overlaps(a, beside(-0.001f)));
        EXPECT_TRUE(contact(a, beside(-0.001f)));
        EXPECT_FALSE(overlaps(a, beside(0.001f)));
        EXPECT_FALSE(contact(a, beside(0.001f)));
        EXPECT_TRUE(contact(a, beside(0.01f), {.margin = 0.05f}));
        EXPECT_FALSE(contact(a, beside(0.01f), {.margin = 0.01f}));
    }
}

}  // namespace
}  // namespace abut
