// Corners of shapes, and the shapes fitted to them.

#include "../../scenes/bumpy_ball.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/fit.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/view/view.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// A rotated and moved polyhedron, each corner perturbed by at most `perturbation`.
Polyhedron placed(const std::vector<DVec<3>>& points, double perturbation, Random& random) {
    const Pose<3> pose{to_float(random.in_cube<3>() * 10.0), random.rotation<3>()};
    std::vector<Vec3> result;
    for (const DVec<3>& p : points)
        result.push_back(pose * to_float(p + random.direction<3>() * (perturbation * random.unit())));
    return *Polyhedron::build(result);
}

std::vector<DVec<3>> box_corners(const DVec<3>& half) {
    std::vector<DVec<3>> result;
    for (int i = 0; i < 8; ++i)
        result.emplace_back((i & 1) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                            (i & 4) != 0 ? half.z : -half.z);
    return result;
}

/// A ring has `2 rows` corners; half a ball at each end of a segment along z.
std::vector<DVec<3>> capsule_corners(double half_length, double radius, std::uint32_t rows) {
    std::vector<DVec<3>> result;
    for (const double sign : {-1.0, 1.0})
        for (std::uint32_t row = 0; row <= rows; ++row) {
            const DVec<2> up = scenes::on_circle(1.0 * row / rows);
            for (std::uint32_t i = 0; i < 4 * rows; ++i) {
                const DVec<2> around = scenes::on_circle(1.0 * i / rows) * (up.x * radius);
                result.emplace_back(around.x, around.y, sign * (half_length + up.y * radius));
            }
        }
    return result;
}

/// The error by its definition, from the supports of both in many directions: never more than the true one.
double error_by_supports(const Polyhedron& part, const Fit& found, Random& random) {
    const auto widest = [&](const auto& shape) {
        const Convex<3> a = convex(part), b = convex(shape);
        double most = 0;
        for (int i = 0; i < 20000; ++i) {
            const DVec<3> direction = random.direction<3>();
            most = std::max(most, std::abs(dot(direction, support(a, direction) - support(b, direction))));
        }
        return most;
    };
    return std::visit(widest, found.shape);
}

void expect_right(const Polyhedron& part, const Fit& found, Random& random) {
    const double size = part.ball().radius, seen = error_by_supports(part, found, random);
    EXPECT_LE(seen, found.error + 1e-5 * size);
    EXPECT_GE(seen, 0.8 * found.error - 1e-5 * size);
}

TEST(Fit, FindsBoxes) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const DVec<3> half(random.uniform(0.1, 2), random.uniform(0.1, 2), random.uniform(0.1, 2));
        const double perturbation = seed % 2 == 0 ? 0 : 0.005 * length(half);
        const Polyhedron part = placed(box_corners(half), perturbation, random);
        const std::optional<Fit> found = fit(part);
        ASSERT_TRUE(found);
        ASSERT_TRUE(std::holds_alternative<Box<3>>(found->shape)) << found->shape.index();
        EXPECT_TRUE(found->contains);
        EXPECT_LE(found->error, 3 * perturbation + 1e-4 * length(half));
        std::vector<float> expected{static_cast<float>(half.x), static_cast<float>(half.y), static_cast<float>(half.z)};
        const Vec3 got = std::get<Box<3>>(found->shape).half;
        std::vector<float> sides{got.x, got.y, got.z};
        std::sort(expected.begin(), expected.end());
        std::sort(sides.begin(), sides.end());
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(sides[i], expected[i], 2 * perturbation + 1e-4 * length(half));
        expect_right(part, *found, random);
    }
}

TEST(Fit, FindsBoxesThatAreSquare) {
    // A shape whose inertia has no distinct axes.
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const double side = random.uniform(0.1, 2), height = seed % 2 == 0 ? side : random.uniform(0.1, 2);
        const Polyhedron part = placed(box_corners({side, side, height}), 0, random);
        const std::optional<Fit> found = fit(part);
        ASSERT_TRUE(found);
        ASSERT_TRUE(std::holds_alternative<Box<3>>(found->shape));
        EXPECT_LE(found->error, 1e-4 * part.ball().radius);
    }
}

TEST(Fit, NoBallNearbyIsBetter) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        // Corners so unevenly spread that their mean isn't the ball's centre.
        std::vector<DVec<3>> points{axis<3>(0, -1)};
        while (points.size() < 60) {
            const DVec<3> direction = random.direction<3>();
            if (direction.x > -0.3 || random.chance(0.2)) points.push_back(direction);
        }
        const Polyhedron part = placed(points, 0, random);
        const std::optional<Fit> found = fit(part, {.tolerance = 1});
        ASSERT_TRUE(found);
        if (!std::holds_alternative<Ball<3>>(found->shape)) continue;
        const DVec<3> center(std::get<Ball<3>>(found->shape).center);
        for (int i = 0; i < 200; ++i) {
            const DVec<3> near = center + random.direction<3>() * random.uniform(0, 0.1);
            double outer = 0, inner = 2;
            for (const Vec3& corner : part.points()) outer = std::max(outer, length(DVec<3>(corner) - near));
            for (std::size_t face = 0; face < part.offsets().size(); ++face)
                inner = std::min(inner, part.offsets()[face] - dot(DVec<3>(part.facets().normals[face]), near));
            EXPECT_GE((outer - inner) / 2, 0.99 * found->error);
        }
    }
}

TEST(Fit, FindsCapsules) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const double half = random.uniform(0.5, 3), radius = random.uniform(0.2, 1);
        const double perturbation = seed % 2 == 0 ? 0 : 0.01 * radius;
        const Polyhedron part = placed(capsule_corners(half, radius, 4), perturbation, random);
        const std::optional<Fit> found = fit(part);
        ASSERT_TRUE(found);
        ASSERT_TRUE(std::holds_alternative<Capsule<3>>(found->shape)) << found->shape.index();
        const auto& capsule = std::get<Capsule<3>>(found->shape);
        EXPECT_NEAR(static_cast<double>(capsule.radius), radius, 0.05 * radius);
        EXPECT_NEAR(length(DVec<3>(capsule.b) - DVec<3>(capsule.a)), 2 * half, 0.15 * radius);
        EXPECT_LE(found->error, 0.03 * radius + 2 * perturbation);
        expect_right(part, *found, random);

        const std::optional<Fit> holding = fit(part, {.tolerance = 0.1, .hold = true});
        ASSERT_TRUE(holding);
        EXPECT_TRUE(holding->contains);
        expect_right(part, *holding, random);
    }
}

TEST(Fit, FindsBalls) {
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        const double radius = random.uniform(0.01, 5), perturbation = seed % 2 == 0 ? 0 : 0.004 * radius;
        const Polyhedron part = placed(capsule_corners(0, radius, 6), perturbation, random);
        const std::optional<Fit> found = fit(part);
        ASSERT_TRUE(found);
        ASSERT_TRUE(std::holds_alternative<Ball<3>>(found->shape)) << found->shape.index();
        EXPECT_NEAR(static_cast<double>(std::get<Ball<3>>(found->shape).radius), radius, 0.03 * radius);
        EXPECT_LE(found->error, 0.03 * radius);
        expect_right(part, *found, random);
        EXPECT_TRUE(fit(part, {.tolerance = 0.1, .hold = true})->contains);
    }
}

TEST(Fit, RefusesWhatIsNoneOfThem) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE(seed);
        Random random(seed);
        EXPECT_FALSE(fit(placed({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0, random))) << "a tetrahedron";
        EXPECT_FALSE(fit(placed({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {0, 2, 2}}, 0, random)))
            << "half a box";
        std::vector<DVec<3>> cylinder, octahedron;
        for (int i = 0; i < 24; ++i)
            for (const double z : {-1.0, 1.0}) {
                const DVec<2> at = scenes::on_circle(i / 6.0);
                cylinder.emplace_back(at.x, at.y, z);
            }
        for (int i = 0; i < 3; ++i)
            for (const double sign : {-1.0, 1.0}) octahedron.push_back(axis<3>(i, sign));
        EXPECT_FALSE(fit(placed(cylinder, 0, random)));
        EXPECT_FALSE(fit(placed(octahedron, 0, random)));
        EXPECT_TRUE(fit(placed(octahedron, 0, random), {.tolerance = 0.4}));
    }
}

TEST(Fit, OfThinThings) {
    Random random(1);
    const std::optional<Fit> sheet = fit(*Polyhedron::build({{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}}));
    ASSERT_TRUE(sheet);
    const auto& box = std::get<Box<3>>(sheet->shape);
    EXPECT_NEAR(std::min({box.half.x, box.half.y, box.half.z}), 0, 1e-6);
    EXPECT_LE(sheet->error, 1e-5);
    EXPECT_FALSE(fit(*Polyhedron::build({{0, 0, 1}, {2, 0, 1}, {1, 3, 1}}))) << "a triangle";
    EXPECT_FALSE(fit(*Polyhedron::build({{0, 0, 1}, {2, 0, 1}})));
    EXPECT_FALSE(fit(Polyhedron()));
}

TEST(Fit, TheSameAtAnyScale) {
    for (const float scale : {1e-3f, 1.0f, 1e4f}) {
        std::vector<Vec3> points;
        for (const DVec<3>& p : capsule_corners(2, 1, 4)) points.push_back(to_float(p) * scale);
        const std::optional<Fit> found = fit(*Polyhedron::build(points));
        ASSERT_TRUE(found);
        ASSERT_TRUE(std::holds_alternative<Capsule<3>>(found->shape));
        EXPECT_NEAR(found->error / static_cast<double>(scale), 0.02, 0.01);
    }
}

}  // namespace
}  // namespace abut
