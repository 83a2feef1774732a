// The oracle itself: its depths against every candidate axis, in double and in rational numbers, and its gaps against
// the separating plane.

#include "../oracle/axes.hpp"
#include "../oracle/rational.hpp"
#include "pairs.hpp"

#include <gtest/gtest.h>

namespace abut::corpus {

using namespace detail;

namespace {

template <class T>
class OracleTruth : public testing::Test {};
using Dimensions = testing::Types<std::integral_constant<int, 2>, std::integral_constant<int, 3>>;
TYPED_TEST_SUITE(OracleTruth, Dimensions);

/// The minimal extent of A - B over all axes, without the radii, in rational numbers.
template <int D>
double exact_extent(const Polytope<D>& a, const Polytope<D>& b) {
    using oracle::Rational;
    const oracle::LocalPair<Rational, D> exact(a, b, oracle::middle(a));
    double least = std::numeric_limits<double>::infinity();
    const bool flat = oracle::is_nearly_flat(oracle::LocalPair<double, D>(a, b, oracle::middle(a)));
    oracle::each_candidate_axis(exact, flat, [&](const std::array<Rational, static_cast<std::size_t>(D)>& axis) {
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

/// The tolerance of the oracle, a hundredth of the library's.
template <int D>
double oracle_tolerance(const Polytope<D>& a, const Polytope<D>& b) {
    return 1e-8 * oracle::largest_coordinate(a, b) + 1e-14 * (largest(oracle::middle(a)) + largest(oracle::middle(b)));
}

/// Visits the pairs of the families in turn.
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
    for (std::uint64_t seed = 0; judged < oracle::case_count(2000); ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        const SamplePair<D> pair = pair_of<D>(seed);
        if (!no_more_edges(pair, 30)) continue;
        ++judged;
        const Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::floating_point);
        const double core_distance = truth.distance + pair.a.solid.radius + pair.b.solid.radius;
        const double extent = oracle::min_extent(pair.a.solid, pair.b.solid, Arithmetic::floating_point).extent;
        const double tolerance = oracle_tolerance(pair.a.solid, pair.b.solid);
        // Rounding rotates the plane in a tiny gap.
        EXPECT_LE(truth.duality_gap, 10 * tolerance);
        if (core_distance > 0) {
            EXPECT_LE(-extent, core_distance + tolerance);
            EXPECT_LE(std::isfinite(extent) ? extent : 0, tolerance);
        } else {
            EXPECT_NEAR(-core_distance, std::isfinite(extent) ? extent : 0, tolerance);
        }
        overlapping += extent > tolerance ? 1 : 0;
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
        const Truth<D> truth = oracle::truth(pair.a.solid, pair.b.solid, Arithmetic::floating_point);
        const double core_distance = truth.distance + pair.a.solid.radius + pair.b.solid.radius;
        const double tolerance = oracle_tolerance(pair.a.solid, pair.b.solid);
        if (core_distance > tolerance) continue;
        ++judged;
        EXPECT_NEAR(core_distance, -exact_extent(pair.a.solid, pair.b.solid), tolerance);
        overlapping += core_distance < -tolerance ? 1 : 0;
    }
    EXPECT_GT(overlapping, judged / 10);
}

}  // namespace
}  // namespace abut::corpus
