// The oracle itself: its depths against every axis there is, in double and in rational numbers, and its gaps against
// the plane that proves them.

#include "../oracle/axes.hpp"
#include "pairs.hpp"

#include <boost/multiprecision/cpp_int.hpp>
#include <gtest/gtest.h>

namespace abut::corpus {
namespace {

template <class T>
class OracleTruth : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(OracleTruth, Dimensions);

/// The least extent of A - B over all axes, without the radii, from rational numbers.
template <int D>
double exact_extent(const Polytope<D>& a, const Polytope<D>& b) {
    using Rational = boost::multiprecision::cpp_rational;
    const oracle::Setting<Rational, D> exact(a, b, oracle::middle(a));
    double least = std::numeric_limits<double>::infinity();
    const bool flat = oracle::nearly_flat(oracle::Setting<double, D>(a, b, oracle::middle(a)));
    oracle::each_axis(exact, flat, [&](const std::array<Rational, static_cast<std::size_t>(D)>& axis) {
        const Rational length_squared = oracle::dot(axis, axis);
        if (length_squared == 0) return;
        for (const Rational& extent : oracle::extents(exact, axis)) {
            const Rational squared = extent * extent / length_squared;
            const double size = std::sqrt(squared.template convert_to<double>());
            least = std::min(least, extent < 0 ? -size : size);
        }
    });
    return least;
}

/// What the oracle may be wrong by; the margin of doubt is a hundred times as much.
template <int D>
double own_doubt(const Polytope<D>& a, const Polytope<D>& b) {
    return 1e-8 * oracle::largest_coordinate(a, b) + 1e-14 * (largest(oracle::middle(a)) + largest(oracle::middle(b)));
}

/// What the families have in them, in turn.
template <int D>
SamplePair<D> pair_of(std::uint64_t seed) {
    constexpr std::uint64_t polytope_families = family_count - 2;
    return sample_pair<D>(static_cast<Family>(seed % polytope_families), seed);
}

template <int D>
bool no_more_edges(const SamplePair<D>& pair, std::size_t most) {
    return pair.a.solid.edge_directions.size() + pair.b.solid.edge_directions.size() <= most;
}

TYPED_TEST(OracleTruth, IsAsDeepAsTheLeastOverAllAxes) {
    constexpr int D = TypeParam::value;
    int overlapping = 0, judged = 0;
    for (std::uint64_t seed = 0; judged < oracle::amount(2000); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const SamplePair<D> pair = pair_of<D>(seed);
        if (!no_more_edges(pair, 30)) continue;
        ++judged;
        const Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::rough);
        const double core_distance = truth.distance + pair.a.solid.radius + pair.b.solid.radius;
        const double extent = oracle::least_extent(pair.a.solid, pair.b.solid, Arithmetic::rough).extent;
        const double doubt = own_doubt(pair.a.solid, pair.b.solid);
        // The plane across a tiny gap is turned by rounding.
        EXPECT_LE(truth.unproved, 10 * doubt);
        if (core_distance > 0) {
            EXPECT_LE(-extent, core_distance + doubt);
            EXPECT_LE(std::isfinite(extent) ? extent : 0, doubt);
        } else {
            EXPECT_NEAR(-core_distance, std::isfinite(extent) ? extent : 0, doubt);
        }
        overlapping += extent > doubt ? 1 : 0;
    }
    EXPECT_GT(overlapping, judged / 5);
}

TYPED_TEST(OracleTruth, IsAsDeepAsInRationalNumbers) {
    constexpr int D = TypeParam::value;
    int overlapping = 0, judged = 0;
    for (std::uint64_t seed = 500; judged < (D == 2 ? 300 : 100); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const SamplePair<D> pair = pair_of<D>(seed);
        if (!no_more_edges(pair, 14)) continue;
        const Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::rough);
        const double core_distance = truth.distance + pair.a.solid.radius + pair.b.solid.radius;
        const double doubt = own_doubt(pair.a.solid, pair.b.solid);
        if (core_distance > doubt) continue;
        ++judged;
        EXPECT_NEAR(core_distance, -exact_extent(pair.a.solid, pair.b.solid), doubt);
        overlapping += core_distance < -doubt ? 1 : 0;
    }
    EXPECT_GT(overlapping, judged / 10);
}

}  // namespace
}  // namespace abut::corpus
