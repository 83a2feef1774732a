// Path data with known answers, and curves against their formulas.

#include "../oracle/random.hpp"
#include <abut/io/svg/path.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using Point = DVec<2>;

std::string text(const Result<std::vector<svg::Subpath>>& paths) {
    if (!paths) return paths.problem().message;
    std::string result;
    for (const svg::Subpath& path : *paths) {
        for (const Point& p : path.points) {
            std::array<char, 64> one{};
            std::snprintf(one.data(), one.size(), "%g,%g ", p.x, p.y);
            result += one.data();
        }
        result += path.closed ? "Z " : "; ";
    }
    return result;
}
std::string flat(const std::string& data) {
    return text(svg::flatten_path(data));
}

TEST(SvgPath, StraightCommandsAbsoluteAndRelative) {
    EXPECT_EQ(flat("M1 2 L3 4 H5 V6 Z"), "1,2 3,4 5,4 5,6 Z ");
    EXPECT_EQ(flat("m1 2 l3 4 h5 v6 z"), "1,2 4,6 9,6 9,12 Z ");
    EXPECT_EQ(flat("M1 2 3 4 5 6"), "1,2 3,4 5,6 ; ") << "more points after M are lines";
    EXPECT_EQ(flat("m1 2 3 4 5 6"), "1,2 4,6 9,12 ; ");
    EXPECT_EQ(flat("M0 0 1 1z l2 0 z m5 5 1 0"), "0,0 1,1 Z 0,0 2,0 Z 5,5 6,5 ; ") << "goes on where it began";
    EXPECT_EQ(flat("M1-2+3,.5.5 1e1"), "1,-2 3,0.5 0.5,10 ; ") << "no blanks where none are needed";
    EXPECT_EQ(flat(" "), "");
    EXPECT_EQ(flat("M1 2"), "1,2 ; ");
}

TEST(SvgPath, SmoothCommandsMirrorTheControlPointBefore) {
    const auto same = [](const char* short_form, const char* long_form) {
        EXPECT_EQ(flat(short_form), flat(long_form)) << short_form;
    };
    same("M0 0C1 2 3 4 5 5S8 9 9 9", "M0 0C1 2 3 4 5 5C7 6 8 9 9 9");
    same("M1 1S3 4 5 5", "M1 1C1 1 3 4 5 5");
    same("M0 0Q1 3 4 4T8 8", "M0 0Q1 3 4 4Q7 5 8 8");
    same("M0 0Q1 3 4 4T8 8T9 0", "M0 0Q1 3 4 4Q7 5 8 8Q9 11 9 0");
    same("M1 1T5 5", "M1 1Q1 1 5 5");
    same("M1 1Q2 3 4 4L5 5T7 7", "M1 1Q2 3 4 4L5 5Q5 5 7 7");
    same("M1 1c1 2 3 4 5 5s8 9 9 9", "M1 1C2 3 4 5 6 6S14 15 15 15");
    same("M1 1q1 2 3 4t5 6", "M1 1Q2 3 4 5T9 11");
    same("M1 1a2 3 10 0 1 2 2", "M1 1A2 3 10 0 1 3 3");
    same("M1 1a2 3 10 013 3", "M1 1A2 3 10 0 1 4 4");
}

TEST(SvgPath, SaysWhereItStopsUnderstanding) {
    EXPECT_EQ(flat("L1 2"), "path data: M was expected at character 1");
    EXPECT_EQ(flat("M1"), "path data: a number was expected at character 3");
    EXPECT_EQ(flat("M1 2 X"), "path data: a number was expected at character 6");
    EXPECT_EQ(flat("M1 2 Z 3"), "path data: a command was expected at character 8");
    EXPECT_EQ(flat("M1 2A1 1 0 2 0 5 5"), "path data: a flag, 0 or 1, was expected at character 12");
    EXPECT_EQ(flat("M1 2 Linf 3"), "path data: a number was expected at character 7");
    EXPECT_EQ(flat("M1 2 L1e999 3"), "path data: a number was expected at character 7");
    EXPECT_EQ(text(svg::flatten_path("M0 0C0 9 9 9 9 0", 1e-9)),
              "path data: a curve needs more than 4096 segments for this tolerance at character 17");
}

double distance_to(const std::vector<Point>& line, const Point& p) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point ab = line[i + 1] - line[i];
        const double squared = dot(ab, ab);
        const double t = squared > 0 ? std::clamp(dot(p - line[i], ab) / squared, 0.0, 1.0) : 0;
        least = std::min(least, length(p - (line[i] + t * ab)));
    }
    return least;
}

Point random_point(oracle::Random& random) {
    const double x = random.uniform(-10, 10);
    return {x, random.uniform(-10, 10)};
}
std::string written(const Point& p) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), " %.17g %.17g", p.x, p.y);
    return text.data();
}

TEST(SvgPath, CurvesAreWithinTheTolerance) {
    oracle::Random random(20260917);
    double worst = 0, of_all = 0;
    constexpr int rounds = 300;
    for (int round = 0; round < rounds; ++round) {
        const Point a = random_point(random), b = random_point(random), c = random_point(random),
                    d = random_point(random);
        const double tolerance = std::pow(10, random.uniform(-4, -0.5));
        const bool cubic = round % 2 == 0;
        const std::string data =
            "M" + written(a) + (cubic ? "C" + written(b) + written(c) : "Q" + written(b)) + written(d);
        const Result<std::vector<svg::Subpath>> paths = svg::flatten_path(data, tolerance);
        ASSERT_TRUE(paths) << data;
        double most = 0;
        for (int i = 0; i <= 500; ++i) {
            const double t = i / 500.0, s = 1 - t;
            const Point on = cubic ? s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d
                                   : s * s * a + 2 * s * t * b + t * t * d;
            most = std::max(most, distance_to(paths->front().points, on));
        }
        ASSERT_LE(most, tolerance * (1 + 1e-9)) << data << " " << tolerance;
        worst = std::max(worst, most / tolerance);
        of_all += most / tolerance / rounds;
    }
    EXPECT_GT(worst, 0.9) << "the bound is reached";
    EXPECT_GT(of_all, 0.3) << "and not by far too many points";
}

TEST(SvgPath, ArcsLieOnTheirEllipses) {
    // A quarter of a circle, with all four flags from (1, 0) to (0, 1).
    struct Case {
        const char* flags;
        Point center, on_arc;
    };
    const double r = std::sqrt(0.5);
    for (const Case& one : {Case{"0 1", {0, 0}, {r, r}}, Case{"0 0", {1, 1}, {1 - r, 1 - r}},
                            Case{"1 1", {1, 1}, {1 + r, 1 + r}}, Case{"1 0", {0, 0}, {-r, -r}}}) {
        const auto paths = svg::flatten_path("M1 0A1 1 0 " + std::string(one.flags) + " 0 1", 1e-3);
        ASSERT_TRUE(paths);
        const std::vector<Point>& points = paths->front().points;
        for (const Point& p : points) EXPECT_NEAR(length(p - one.center), 1, 1e-12) << one.flags;
        EXPECT_LE(distance_to(points, one.on_arc), 1e-3) << one.flags;
        EXPECT_EQ(points.back(), Point(0, 1));
    }
    // Radii that are too small grow until they fit: a half circle about the middle.
    const auto half = svg::flatten_path("M-3 0A1 1 0 0 0 3 0");
    ASSERT_TRUE(half);
    for (const Point& p : half->front().points) EXPECT_NEAR(length(p), 3, 1e-12);
    EXPECT_EQ(flat("M1 1A0 5 0 0 0 4 4"), "1,1 4,4 ; ") << "without a radius it is a line";
    EXPECT_EQ(flat("M1 1A5 5 0 0 0 1 1"), "1,1 1,1 ; ");
}

TEST(SvgPath, RandomArcsAreWithinTheTolerance) {
    oracle::Random random(20260918);
    constexpr double pi = 3.14159265358979323846;
    for (int round = 0; round < 300; ++round) {
        // An ellipse and a piece of it, from which the path is written.
        const Point center = random_point(random), radii(random.uniform(0.5, 5), random.uniform(0.5, 5));
        const double degrees = random.uniform(-180, 180), turn = degrees * pi / 180;
        const double first = random.uniform(-pi, pi), angle = random.uniform(-1.95 * pi, 1.95 * pi);
        const auto on = [&](double t) {
            const Point p(radii.x * std::cos(t), radii.y * std::sin(t));
            return center +
                   Point(p.x * std::cos(turn) - p.y * std::sin(turn), p.x * std::sin(turn) + p.y * std::cos(turn));
        };
        const double tolerance = std::pow(10, random.uniform(-3, -1));
        const std::string flags = std::string(std::abs(angle) > pi ? " 1" : " 0") + (angle > 0 ? " 1" : " 0");
        const std::string data = "M" + written(on(first)) + "A" + written(radii) + " " + std::to_string(degrees) +
                                 flags + written(on(first + angle));
        const Result<std::vector<svg::Subpath>> paths = svg::flatten_path(data, tolerance);
        ASSERT_TRUE(paths) << data;
        for (int i = 0; i <= 200; ++i)
            ASSERT_LE(distance_to(paths->front().points, on(first + angle * i / 200)), tolerance + 2e-4) << data;
    }
}

}  // namespace
}  // namespace abut
