// Distances and decisions against Bullet's GJK and EPA, and against FCL in double with both of its solvers.

#include "compare.hpp"

namespace abut::differential {
namespace {

TEST(Bullet, AgreesOnDistancesAndOverlaps) {
    const Tally tally = compare("bullet", query_bullet, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong for a comparison";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

TEST(Fcl, AgreesOnDistancesAndOverlapsWithLibccd) {
    const Tally tally = compare("fcl with libccd", query_fcl_libccd, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong for a comparison";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

// The depths of this solver are wrong for most pairs of hulls; its gaps and overlap tests are right.
TEST(Fcl, AgreesOnDistancesAndOverlapsWithItsOwnSolver) {
    const Tally tally = compare("fcl with its own solver", query_fcl_indep, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong for a comparison";
}

}  // namespace
}  // namespace abut::differential
