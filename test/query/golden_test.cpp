// Determinism: a hash over the bits of a million answers of every query equals a constant, with each SIMD target of
// this machine.
//
// The shapes have integer coordinates, so this file's arithmetic does not affect the answers. After a change that is
// meant to change answers, the constant is renewed from the failing test's output. First, gcc and clang with -O0 and
// -O3 -march=native must agree on it.

#include "../oracle/simd_targets.hpp"
#include "hashed_answers.hpp"
#include <abut/query/intersection.hpp>
#include <abut/query/minkowski_sum.hpp>

#include <gtest/gtest.h>

namespace abut {
namespace {

/// The queries that return polytopes.
template <int D>
void add_polytopes(Hash& hash, WholeNumbers<D>& make) {
    const auto add = [&](const PolytopeOf<D>& polytope) {
        for (const Vec<D>& point : polytope.points()) hash.add<D>(point);
        hash.add<D>(polytope.centroid());
        hash.add<D>(polytope.normal());
    };
    const Box<D> box{make.point(), make.half(), make.rotation()};
    const PolytopeOf<D> hull = *PolytopeOf<D>::build(make.points(12));
    const Triangle<D> triangle{make.point(), make.point(), make.point()};
    if (const auto overlap = intersection(box, hull)) add(*overlap);
    if (const auto overlap = intersection(hull, triangle)) add(*overlap);
    add(minkowski_sum(box, triangle));
    add(minkowski_difference(hull, box));
    const Ball<D> ball{make.point(), make.size()};
    add(polytope(ball, ball.radius / 4));
}

template <int D>
std::uint64_t hash_of_answers() {
    Hash hash;
    Cache cache;
    for (std::uint64_t seed = 0; seed < 60000; ++seed) {
        WholeNumbers<D> make(seed);
        const View<D> a = make.shape(), b = make.shape();
        add_cheap_answers<D>(hash, make, a, b, cache);
        if (seed % 25 == 0) add_polytopes<D>(hash, make);
    }
    return hash.value();
}

class Golden : public oracle::BySimdTarget {};

TEST_P(Golden, AnswersInThePlaneHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_answers<2>(), 11006715603740303977u);
}
TEST_P(Golden, AnswersInSpaceHaveTheSameBitsEverywhere) {
    EXPECT_EQ(hash_of_answers<3>(), 3257546053351324941u);
}

INSTANTIATE_TEST_SUITE_P(Targets, Golden, oracle::simd_targets(), oracle::simd_target_name);

}  // namespace
}  // namespace abut
