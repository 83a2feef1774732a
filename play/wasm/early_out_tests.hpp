#pragma once

// Tests for an EarlyOut, with their inputs: calculations of a chosen cost and pass rate, and pairs of polygons.

#include <abut/query/overlaps.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/polygon.hpp>

#include <cmath>
#include <cstdint>
#include <variant>
#include <vector>

#include <glm/geometric.hpp>
#include <test/oracle/random.hpp>

namespace abut::play {

/// Tests that take a number of rounds and pass a fraction of random inputs.
class CalculatedTests {
public:
    struct Test {
        std::uint32_t rounds;
        std::uint32_t limit;  ///< random numbers below it pass
    };

    CalculatedTests(std::vector<Test> tests, double alike) : tests_(std::move(tests)) {
        oracle::Random random(1);
        for (std::uint32_t i = 0; i < 4096; ++i) {
            const auto own = static_cast<std::uint32_t>(random.bits()),
                       common = static_cast<std::uint32_t>(random.bits());
            inputs_.push_back({own, common, random.chance(alike) ? ~0u : 0u});
        }
    }

    std::uint32_t count() const { return static_cast<std::uint32_t>(tests_.size()); }
    std::uint32_t inputs() const { return static_cast<std::uint32_t>(inputs_.size()); }
    bool passes(std::uint32_t test, std::uint32_t index) const {
        const Input& input = inputs_[index];
        std::uint32_t own = input.own + test * 0x9E3779B9u;
        for (std::uint32_t i = 0; i < tests_[test].rounds; ++i) own = (own ^ own >> 15) * 0x2C1B3C6Du + 1;
        own = (own ^ own >> 16) * 0x7FEB352Du;
        own ^= own >> 15;
        return ((own & ~input.use_common) | (input.common & input.use_common)) < tests_[test].limit;
    }

private:
    struct Input {
        std::uint32_t own, common;
        std::uint32_t use_common;  ///< all bits or none
    };
    std::vector<Test> tests_;
    std::vector<Input> inputs_;
};

/// Whether two polygons overlap, after their bounding circles and their boxes.
class ShapeTests {
public:
    struct Pair {
        Circle circle_a, circle_b;
        Aabb2 box_a, box_b;
        Polygon a, b;
    };

    ShapeTests(std::uint32_t vertices, double elongation, double distance) : distance_(distance) {
        oracle::Random random(2);
        for (std::uint32_t i = 0; i < 2048; ++i) {
            const oracle::DVec<2> half = random.direction<2>() * random.uniform(0, 0.5 * distance);
            const Polygon a = polygon(vertices, elongation, half, random),
                          b = polygon(vertices, elongation, -half, random);
            pairs_.push_back({{Vec2(half), 1}, {Vec2(-half), 1}, bounds(view(a)), bounds(view(b)), a, b});
        }
    }

    std::uint32_t count() const { return 3; }
    std::uint32_t inputs() const { return static_cast<std::uint32_t>(pairs_.size()); }
    bool passes(std::uint32_t test, std::uint32_t index) const {
        const Pair& pair = pairs_[index];
        if (test == 0) return circles_reach(pair.circle_a, pair.circle_b);
        if (test == 1) return overlaps(pair.box_a, pair.box_b);
        return overlaps(pair.a, pair.b);
    }
    const Pair& pair(std::uint32_t index) const { return pairs_[index]; }
    /// The greatest distance between the centers of a pair.
    double distance() const { return distance_; }

private:
    /// As a World tests bounding balls: a few multiplications, with a margin for rounding.
    static bool circles_reach(const Circle& a, const Circle& b) {
        const Vec2 between = b.center - a.center;
        const float reach = a.radius + b.radius;
        return glm::dot(between, between) <= reach * reach * 1.00001f;
    }
    /// Inscribed in an ellipse whose longer half axis is 1.
    static Polygon polygon(std::uint32_t vertices, double elongation, const oracle::DVec<2>& center,
                           oracle::Random& random) {
        const oracle::DVec<2> along = random.direction<2>(), across(-along.y, along.x);
        std::vector<Vec2> points;
        for (std::uint32_t i = 0; i < vertices; ++i) {
            const double angle = 6.283185307179586 * i / vertices;
            points.push_back(Vec2(center + along * std::cos(angle) + across * (std::sin(angle) / elongation)));
        }
        return *Polygon::build(points);
    }

    double distance_;
    std::vector<Pair> pairs_;
};

using EarlyOutTests = std::variant<CalculatedTests, ShapeTests>;

}  // namespace abut::play
