// A golden hash over the bits of 200,000 walks and of the answers of the lower-level steps.
//
// If a change of the
// library is meant to change answers, replace the constant by the failing test's output, once gcc and clang agree on it
// at -O0 and -O3 -march=native.

#include "hashed_walks.hpp"

#include <gtest/gtest.h>

namespace abut::test {
namespace {

void add_walks_over(Hash& hash, const Surface& surface, std::uint64_t seed) {
    const Result<WalkMesh> mesh = WalkMesh::build(surface.points, surface.triangles);
    ASSERT_TRUE(mesh);
    add_walks(hash, *mesh, surface, seed, 10'000);
}

TEST(WalkGolden, WalksHaveTheSameBitsEverywhere) {
    Hash hash;
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        oracle::Random random(seed);
        add_walks_over(hash, rough_ground(random), seed);
        const int shift = static_cast<int>(seed);
        const Surface solid =
            cell_surface(4, [&](int x, int y, int z) { return (x * 5 + y * 3 + z + shift) % 4 != 0; });
        add_walks_over(hash, solid, seed);
    }
    EXPECT_EQ(hash.value(), 17371007193045632278u);
}

}  // namespace
}  // namespace abut::test
