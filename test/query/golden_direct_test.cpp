// The golden hash of the closed forms of plain shapes. Their coordinates are integers, as in golden_test.cpp; rotations
// are normalized integer vectors.

#include "../oracle/random.hpp"
#include "../oracle/simd_targets.hpp"
#include "hash.hpp"
#include <abut/query/overlaps.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// Each random number is drawn in a statement of its own, because compilers evaluate arguments in any order.
template <int D>
class PlainShapes {
public:
    explicit PlainShapes(std::uint64_t seed) : random_(seed) {}

    float number(std::uint32_t most) {
        return static_cast<float>(static_cast<int>(random_.below(2 * most + 1)) - static_cast<int>(most)) / 128;
    }
    Vec<D> point(std::uint32_t most) {
        Vec<D> result;
        for (int i = 0; i < D; ++i) result[i] = number(most);
        return result;
    }
    float size() { return (1 + static_cast<float>(random_.below(64))) / 64; }
    float sign() { return random_.below(2) == 0 ? -1.0f : 1.0f; }

    Rotation<D> rotation() {
        if constexpr (D == 2) {
            static constexpr float triples[5][3] = {{1, 0, 1}, {3, 4, 5}, {5, 12, 13}, {15, 8, 17}, {20, 21, 29}};
            const auto& triple = triples[random_.below(5)];
            const float cos = sign() * triple[0] / triple[2], sin = sign() * triple[1] / triple[2];
            return {cos, sin};
        } else {
            static constexpr float quadruples[4][5] = {
                {1, 0, 0, 0, 1}, {1, 1, 1, 1, 2}, {1, 2, 2, 4, 5}, {2, 4, 5, 6, 9}};
            const auto& numbers = quadruples[random_.below(4)];
            const float w = numbers[0] / numbers[4], x = sign() * numbers[1] / numbers[4];
            const float y = sign() * numbers[2] / numbers[4], z = sign() * numbers[3] / numbers[4];
            return glm::quat{w, x, y, z};
        }
    }

    /// Calls visit(shape) with a shape, or with a shape at a pose.
    template <class Visit>
    void draw(const Visit& visit, const Vec<D>& about = Vec<D>(0.0f)) {
        const std::uint32_t kind = random_.below(6);
        const bool placed = random_.below(2) == 0;
        const Vec<D> position = about + point(128), shift = placed ? Vec<D>(0.0f) : about;
        const Pose<D> pose{position, rotation()};
        const auto visit_placed = [&](const auto& shape) {
            if (placed)
                visit(at(shape, pose));
            else
                visit(shape);
        };
        const Vec<D> a = shift + point(192), b = shift + point(192), c = shift + point(192);
        const float radius = size();
        switch (kind) {
            case 0:
                return visit_placed(Ball<D>{a, radius});
            case 1:
                return visit_placed(Capsule<D>{a, b, radius});
            case 2:
                return visit_placed(Segment<D>{a, b});
            case 3:
                return visit_placed(Triangle<D>{a, b, c});
            case 4: {
                Vec<D> half;
                for (int i = 0; i < D; ++i) half[i] = size();
                return visit_placed(Box<D>{a, half, rotation()});
            }
            default: {
                std::vector<Vec<D>> points(4 + random_.below(9));
                for (Vec<D>& p : points) p = shift + point(128);
                return visit_placed(*Polytope::build(points));
            }
        }
    }

private:
    using Polytope = std::conditional_t<D == 2, Polygon, Polyhedron>;
    oracle::Random random_;
};

template <int D, class A, class B>
void add_answers(Hash& hash, PlainShapes<D>& shapes, const A& a, const B& b, Cache& cache) {
    hash.add(std::uint64_t{overlaps(a, b)});
    add_closest(hash, closest(a, b));
    add_contact(hash, contact(a, b));
    add_contact(hash, contact(a, b, {.cache = &cache, .margin = 0.25f}));
    for (int i = 0; i < 2; ++i) add_closest(hash, closest(a, b, {.cache = &cache}));
    hash.add(std::uint64_t{overlaps(a, b, {.cache = &cache})});
    const Vec<D> from = shapes.point(512), to = shapes.point(64);
    add_hit(hash, raycast(Ray<D>::between(from, to), a));
}

template <int D>
std::uint64_t hash_of_closed_forms() {
    Hash hash;
    Cache cache;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        PlainShapes<D> shapes(seed);
        shapes.draw(
            [&](const auto& a) { shapes.draw([&](const auto& b) { add_answers(hash, shapes, a, b, cache); }); });
    }
    return hash.value();
}

/// Sweeps of 2D pairs that start a few sizes apart, on both sides.
std::uint64_t hash_of_sweeps() {
    Hash hash;
    for (std::uint64_t seed = 0; seed < 100000; ++seed) {
        PlainShapes<2> shapes(seed);
        const Vec2 from = shapes.point(512), to = shapes.point(128), motion_b = shapes.point(128);
        const Vec2 motion_a = to - from + motion_b;
        const auto put_answers = [&](const auto& a, const auto& b) {
            add_hit(hash, sweep(a, motion_a, b, motion_b));
            add_hit(hash, sweep(b, motion_b, a, motion_a));
        };
        shapes.draw([&](const auto& a) { shapes.draw([&](const auto& b) { put_answers(a, b); }); }, from);
    }
    return hash.value();
}

class GoldenDirect : public oracle::BySimdTarget {};

TEST_P(GoldenDirect, AnswersInThePlaneHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_closed_forms<2>(), 5117989531242403468u);
}
TEST_P(GoldenDirect, AnswersInSpaceHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_closed_forms<3>(), 355353316068991486u);
}
TEST_P(GoldenDirect, SweepsInThePlaneHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_sweeps(), 4110434063458142389u);
}

INSTANTIATE_TEST_SUITE_P(Targets, GoldenDirect, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
