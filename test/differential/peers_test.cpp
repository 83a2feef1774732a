// Distances and decisions against Bullet's GJK and EPA, and against FCL in double with both of its solvers.

#include "compare.hpp"

namespace abut::differential {
namespace {

TEST(Bullet, AgreesOnDistancesAndOverlaps) {
    const Tally tally = compare("bullet", ask_bullet, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

TEST(Fcl, AgreesOnDistancesAndOverlapsWithLibccd) {
    const Tally tally = compare("fcl with libccd", ask_fcl_libccd, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
    EXPECT_LE(tally.too_small + tally.too_large, tally.pairs / 200);
}

// Its penetration search goes wrong for most pairs of hulls; its gaps and decisions are sound.
TEST(Fcl, AgreesOnDistancesAndOverlapsWithItsOwnSolver) {
    const Tally tally = compare("fcl with its own solver", ask_fcl_indep, 200);
    EXPECT_LE(tally.wrong_but_for_depths(), tally.pairs / 200) << "too often wrong to tell anything";
}

}  // namespace
}  // namespace abut::differential
