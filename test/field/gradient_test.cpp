// Look-ups with gradients: more accurate than linear ones near edges, with equal memory.

#include "analytic.hpp"
#include <abut/field/field.hpp>
#include <abut/field/packed_direction.hpp>
#include <abut/field/quantise.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using namespace oracle;

struct Error {
    double rms = 0;          ///< of the distance, in cells
    double wrong_signs = 0;  ///< the share of them
    double normal = 0;       ///< 1 minus the cosine, on average
};

/// Within a cell of the surface.
Error error_of(const Field3& field, const Analytic<3>& solid, double cell) {
    Error result;
    Random random(61);
    const Aabb3& box = solid.surface;
    int count = 0;
    while (count < 4000) {
        DVec<3> place;
        for (int a = 0; a < 3; ++a)
            place[a] = random.uniform(static_cast<double>(box.min[a]), static_cast<double>(box.max[a]));
        const double far = solid.distance(place);
        if (std::abs(far) > 4 * cell) continue;
        const Vec3 point = to_float<3>(place - solid.gradient(place) * (far + cell * random.uniform(-1, 1)));
        const double right = solid.distance(DVec<3>(point));
        if (std::abs(right) > cell) continue;
        ++count;
        const FieldSample<3> found = field.sample(point);
        const double error = (static_cast<double>(found.distance) - right) / cell;
        result.rms += error * error;
        result.wrong_signs += (found.distance < 0) != (right < 0) ? 1 : 0;
        result.normal += 1 - dot(DVec<3>(found.normal), solid.gradient(DVec<3>(point)));
    }
    result.rms = std::sqrt(result.rms / count);
    result.wrong_signs /= count;
    result.normal /= count;
    return result;
}

/// The difference of two boxes: it has convex and reflex edges.
Analytic<3> corner_piece() {
    const Analytic<3> whole = box<3>({0, 0, 0}, {1, 1, 1});
    // Outside, the nearest point is that of the nearest of three boxes; inside, distances are to the planes and the
    // edges of the notch.
    const Analytic<3> notch = box<3>({2, 2, 2}, {2, 2, 2});
    const std::vector<Analytic<3>> parts{box<3>({-0.5, 0, 0}, {0.5, 1, 1}), box<3>({0, -0.5, 0}, {1, 0.5, 1}),
                                         box<3>({0, 0, -0.5}, {1, 1, 0.5})};
    return {[=](const DVec<3>& p) {
                if (whole.distance(p) <= 0 && notch.distance(p) >= 0)
                    return std::max(whole.distance(p), -notch.distance(p));
                double least = 1e300;
                for (const Analytic<3>& part : parts) least = std::min(least, part.distance(p));
                return least;
            },
            whole.surface};
}

TEST(FieldGradient, IsSharpNearEdges) {
    const std::vector<Analytic<3>> solids{turned(box<3>({0, 0, 0}, {0.6, 0.5, 0.4}), {1, 2, 3}, {0, 1, 0}),
                                          turned(box<3>({0, 0, 0}, {0.8, 0.5, 0.04}), {1, 2, 3}, {0, 1, 0}),
                                          turned(corner_piece(), {1, 2, 3}, {0, 1, 0})};
    for (const Analytic<3>& solid : solids) {
        const double side = static_cast<double>(solid.surface.max.x - solid.surface.min.x);
        const double cell = side / 40;
        FillOptions options;
        const Field3 linear(filled_around<3>(solid, static_cast<float>(cell), 3, options));
        options.lookup = FieldLookup::gradient;
        FieldData<3> data = filled_around<3>(solid, static_cast<float>(cell), 3, options);
        quantise(data);
        const Field3 sharp(data);
        EXPECT_LE(sharp.bytes(), linear.bytes());
        const Error of_linear = error_of(linear, solid, cell), of_sharp = error_of(sharp, solid, cell);
        EXPECT_GT(of_linear.rms, 0.04);
        EXPECT_LT(of_sharp.rms, 0.02);
        EXPECT_LT(of_sharp.rms, 0.25 * of_linear.rms);
        EXPECT_LT(of_sharp.wrong_signs, 0.2 * of_linear.wrong_signs);
        EXPECT_LT(of_sharp.normal, 0.25 * of_linear.normal);
    }
}

TEST(FieldGradient, IsRightToTheSecondOrderWhereItIsSmooth) {
    const Analytic<3> solid = turned(torus({0, 0, 0}, 0.65, 0.25), {1, 2, 3}, {0, 1, 0});
    double before = 0;
    for (const double cell : {0.05, 0.025}) {
        FillOptions options;
        const Field3 linear(filled_around<3>(solid, static_cast<float>(cell), 3, options));
        options.lookup = FieldLookup::gradient;
        const Field3 smooth(filled_around<3>(solid, static_cast<float>(cell), 3, options));
        const double now = error_of(smooth, solid, cell).rms;
        EXPECT_LT(now, 0.25 * error_of(linear, solid, cell).rms);
        if (before > 0) {
            EXPECT_LT(now, 0.4 * before) << "in cells, which are half as large";
        }
        before = now;
    }
}

/// The reported normal is the direction in which the distance grows, by differences.
TEST(FieldGradient, ItsDirectionIsThatOfTheDistance) {
    const Analytic<3> solid = turned(box<3>({0, 0, 0}, {0.6, 0.5, 0.4}), {1, 2, 3}, {0, 1, 0});
    FillOptions options;
    options.lookup = FieldLookup::gradient;
    const Field3 field(filled_around<3>(solid, 0.05f, 3, options));
    Random random(67);
    int right = 0, all = 0;
    while (all < 2000) {
        Vec3 point;
        for (int a = 0; a < 3; ++a) point[a] = random.uniform_float(-0.9, 0.9);
        if (!contains(field.volume(), point)) continue;
        constexpr float step = 2e-4f;
        DVec<3> rise;
        for (int a = 0; a < 3; ++a) {
            Vec3 low = point, high = point;
            low[a] -= step;
            high[a] += step;
            rise[a] = (static_cast<double>(field.distance(high)) - static_cast<double>(field.distance(low))) /
                      (2 * static_cast<double>(step));
        }
        if (length(rise) < 0.3 || length(rise) > 1.5) continue;  // across a border or a ridge
        ++all;
        right += dot(normalized(rise), DVec<3>(field.sample(point).normal)) > 0.999 ? 1 : 0;
    }
    EXPECT_GT(right, 1800);
}

TEST(FieldGradient, NothingSolidIsOutsideOfItsBounds) {
    const Analytic<3> solid = turned(corner_piece(), {1, 2, 3}, {0, 1, 0});
    FillOptions options;
    options.lookup = FieldLookup::gradient;
    const Field3 field(filled_around<3>(solid, 0.15f, 3, options));
    Random random(73);
    for (int i = 0; i < 200000; ++i) {
        Vec3 point;
        for (int a = 0; a < 3; ++a)
            point[a] = random.uniform_float(static_cast<double>(field.volume().min[a]),
                                            static_cast<double>(field.volume().max[a]));
        if (field.distance(point) <= 0) {
            ASSERT_TRUE(contains(bounds(field), point));
        }
    }
}

TEST(FieldGradient, DirectionsFitSixteenBits) {
    Random random(79);
    double worst2 = 0, worst3 = 0;
    for (int i = 0; i < 50000; ++i) {
        const DVec<2> u = random.direction<2>();
        const DVec<3> v = random.direction<3>();
        const DVec<2> again2(unpacked<2>(packed(to_float<2>(u))));
        const DVec<3> again3(unpacked<3>(packed(to_float<3>(v))));
        ASSERT_NEAR(length(again2), 1, 1e-6);
        ASSERT_NEAR(length(again3), 1, 1e-6);
        worst2 = std::max(worst2, length(u - again2));
        worst3 = std::max(worst3, length(v - again3));
    }
    EXPECT_LT(worst2, 7e-5);
    EXPECT_LT(worst3, 0.0166);
    for (int a = 0; a < 3; ++a)
        for (const float sign : {-1.0f, 1.0f}) {
            Vec3 v(0.0f);
            v[a] = sign;
            EXPECT_EQ(unpacked<3>(packed(v)), v);
        }
    for (const Vec2 v : {Vec2(1, 0), Vec2(-1, 0), Vec2(0, 1), Vec2(0, -1)}) EXPECT_EQ(unpacked<2>(packed(v)), v);
}

}  // namespace
}  // namespace abut
