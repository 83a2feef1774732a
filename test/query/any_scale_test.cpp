// Coordinates of all magnitudes together: every answer is finite.

#include "../oracle/finite_answers.hpp"
#include "../oracle/random.hpp"
#include <abut/shape/any_shape.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Random;

/// Lengths from 1e-30 to 1e30. Most lengths of a shape are of one magnitude, some of any other.
class Lengths {
public:
    explicit Lengths(Random& random) : random_(random) {
        size_ = random.chance(0.4) ? 1 : any();
        offset_ = random.chance(0.7) ? 0 : any();
    }

    float length() {
        const double choice = random_.unit();
        return static_cast<float>(choice < 0.1 ? 0 : choice < 0.25 ? any() : size_ * random_.uniform(0, 2));
    }
    template <int D>
    Vec<D> half() {
        Vec<D> result;
        for (int a = 0; a < D; ++a) result[a] = length();
        return result;
    }
    template <int D>
    Vec<D> place() {
        Vec<D> result;
        for (int a = 0; a < D; ++a)
            result[a] = (random_.chance(0.5) ? length() : -length()) + static_cast<float>(offset_);
        return result;
    }
    template <int D>
    std::vector<Vec<D>> places(int count) {
        std::vector<Vec<D>> result;
        for (int i = 0; i < count; ++i) result.push_back(place<D>());
        return result;
    }

private:
    double any() { return random_.power_of_two(-100, 100); }

    Random& random_;
    double size_, offset_;
};

template <class S>
std::optional<AnyShape<dimension<S>>> shape_of(const Result<S>& result) {
    if (!result) return std::nullopt;
    return AnyShape<dimension<S>>(*result);
}

template <int D>
std::optional<AnyShape<D>> shape_of_its_own(std::uint32_t kind, Lengths& lengths, Random& random);
template <>
std::optional<AnyShape<2>> shape_of_its_own<2>(std::uint32_t kind, Lengths& lengths, Random& random) {
    if (kind % 2 == 0) return shape_of(Polygon::build(lengths.places<2>(9)));
    return shape_of(Chain::build(lengths.places<2>(6), random.chance(0.5)));
}
template <>
std::optional<AnyShape<3>> shape_of_its_own<3>(std::uint32_t kind, Lengths& lengths, Random&) {
    if (kind == 0) return shape_of(Polyhedron::build(lengths.places<3>(9)));
    if (kind == 1) return AnyShape<3>(Cylinder{lengths.place<3>(), lengths.place<3>(), lengths.length()});
    if (kind == 2) return AnyShape<3>(Cone{lengths.place<3>(), lengths.place<3>(), lengths.length()});
    if (kind == 3) {
        const std::vector<glm::uvec3> triangles{{0, 1, 2}, {2, 1, 3}, {3, 4, 5}, {0, 4, 2}};
        return shape_of(Mesh::build(lengths.places<3>(6), triangles));
    }
    std::vector<float> heights;
    for (int i = 0; i < 12; ++i) heights.push_back(lengths.length());
    return shape_of(HeightField::build(heights, 4, lengths.half<2>()));
}

template <int D>
std::optional<AnyShape<D>> any_shape(Random& random, std::uint32_t& kind) {
    Lengths lengths(random);
    const auto place = [&] { return lengths.place<D>(); };
    kind = random.below(13);
    switch (kind) {
        case 0:
            return AnyShape<D>(Ball<D>{place(), lengths.length()});
        case 1:
            return AnyShape<D>(Capsule<D>{place(), place(), lengths.length()});
        case 2:
            return AnyShape<D>(Box<D>{place(), lengths.half<D>(), random.rotation<D>()});
        case 3: {
            const Vec<D> a = place(), b = place();
            return AnyShape<D>(Aabb<D>{glm::min(a, b), glm::max(a, b)});
        }
        case 4:
            return AnyShape<D>(Segment<D>{place(), place()});
        case 5:
            return AnyShape<D>(Triangle<D>{place(), place(), place()});
        case 6:
            return AnyShape<D>(HalfSpace<D>{to_float<D>(random.direction<D>()), lengths.length()});
        case 7: {
            const Pose<D> pose{place(), random.rotation<D>()};
            return AnyShape<D>(
                rounded(at(Box<D>{place(), lengths.half<D>(), random.rotation<D>()}, pose), lengths.length()));
        }
        default: {
            const std::optional<AnyShape<D>> own = shape_of_its_own<D>(kind - 8, lengths, random);
            if (!own || random.chance(0.8)) return own;
            return shape_of(Compound<D>::build({AnyShape<D>(Ball<D>{place(), lengths.length()}), *own}));
        }
    }
}

/// Regression: for a polygon and a segment without length, 1e16 times the polygon's size away, all edges of the polygon
/// were lost. No separating axis was tried, the distance was minus infinity, and the normal was zero. This happened in
/// 45 of 97,000 random pairs.
template <int D>
void expect_finite(std::uint64_t first_seed, int rounds) {
    int pairs = 0, hits = 0;
    for (std::uint64_t seed = first_seed; pairs < rounds; ++seed) {
        Random random(seed);
        std::uint32_t kind_a = 0, kind_b = 0;
        const std::optional<AnyShape<D>> a = any_shape<D>(random, kind_a), b = any_shape<D>(random, kind_b);
        if (!a || !b || (kind_a == 6 && kind_b == 6)) continue;
        ++pairs;
        Lengths lengths(random);
        const Vec<D> from = lengths.place<D>(), to = lengths.place<D>();
        const char* of_two = oracle::non_finite_pair_query(*a, *b, to);
        const char* of_one = oracle::non_finite_shape_query(*a, from, to);
        ASSERT_EQ(of_two, nullptr) << of_two << ", seed " << seed << ": shapes " << kind_a << " and " << kind_b;
        ASSERT_EQ(of_one, nullptr) << of_one << ", seed " << seed << ": shape " << kind_a;
        hits += overlaps(*a, *b);
    }
    EXPECT_GT(hits, pairs / 10);
    EXPECT_LT(hits, pairs * 9 / 10);
}

TEST(AnyScale, AnswersAreFinite) {
    expect_finite<2>(1, 20000);
    expect_finite<3>(1, 10000);
}

TEST(AnyScale, APolygonAndAPointFarAway) {
    const Polygon polygon = *Polygon::build({{1, 0}, {0.3f, 0.9f}, {-0.8f, 0.6f}, {-0.7f, -0.7f}, {0.5f, -0.8f}});
    for (const float far : {1e9f, 1e15f, 1e16f, 1e17f, 1e20f, 1e30f}) {
        const Segment<2> point{{far, -far}, {far, -far}};
        const Closest<2> found = closest(point, polygon);
        EXPECT_NEAR(found.distance / far, std::sqrt(2.0f), 1e-6f);
        EXPECT_NEAR(found.normal.x, -std::sqrt(0.5f), 1e-6f);
        EXPECT_NEAR(found.normal.y, std::sqrt(0.5f), 1e-6f);
        EXPECT_FALSE(contact(point, polygon));
    }
}

}  // namespace
}  // namespace abut
