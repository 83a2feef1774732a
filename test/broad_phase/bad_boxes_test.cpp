// Boxes and queries with NaN: asserted in debug builds, never visited in any.

#include "scenes.hpp"
#include "structures.hpp"
#include <abut/math/assert.hpp>

#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

namespace {
bool asserts_expected = false;
int asserts_seen = 0;
}  // namespace

void abut::assert_failed(const char* expression, const char* file, int line) {
    ++asserts_seen;
    if (asserts_expected) return;
    std::fprintf(stderr, "%s:%d: %s\n", file, line, expression);
    std::abort();
}

namespace abut::test {

using namespace detail;

namespace {

#ifdef NDEBUG
constexpr bool asserts_on = false;
#else
constexpr bool asserts_on = true;
#endif

template <class T>
class BadBoxes : public EachBroadPhase<T> {
protected:
    void SetUp() override {
        asserts_expected = true;
        asserts_seen = 0;
    }
    void TearDown() override { asserts_expected = false; }
};
TYPED_TEST_SUITE(BadBoxes, AllBroadPhases);

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

template <class T, int D>
std::uint32_t visits(const T& phase, const Aabb<D>& box) {
    std::uint32_t result = 0;
    const auto count = [&](std::uint32_t) { ++result; };
    const auto count_pair = [&](std::uint32_t, std::uint32_t) { ++result; };
    phase.each_pair(count_pair);
    phase.each_overlapping_pair(phase, count_pair);
    phase.each_overlapping(box, count);
    phase.closest(box, count);
    phase.closest(box.min, count);
    phase.raycast(Ray<D>{box.min, Vec<D>(axis<D>(0))}, count);
    return result;
}

template <int D>
void are_never_visited(const AnyBroadPhase<D>& empty) {
    for (int bad = 0; bad < D; ++bad)
        for (const bool low : {false, true}) {
            std::vector<Aabb<D>> boxes(9, {Vec<D>(0), Vec<D>(1)});
            for (Aabb<D>& box : boxes) (low ? box.min : box.max)[bad] = nan;
            AnyBroadPhase<D> phase = empty;
            phase.build(boxes);
            EXPECT_EQ(visits(phase, Aabb<D>{Vec<D>(0), Vec<D>(1)}), 0u);
            phase.build(std::vector<Aabb<D>>(9, {Vec<D>(0), Vec<D>(1)}));
            phase.update(boxes);
            EXPECT_EQ(visits(phase, Aabb<D>{Vec<D>(0), Vec<D>(1)}), 0u);
        }
    EXPECT_EQ(asserts_seen > 0, asserts_on);
}
TYPED_TEST(BadBoxes, AreNeverVisited) {
    are_never_visited(this->empty);
}

template <int D>
void are_empty_where_one_axis_is_the_wrong_way_round(const AnyBroadPhase<D>& empty) {
    for (int bad = 0; bad < D; ++bad) {
        std::vector<Aabb<D>> boxes(9, {Vec<D>(0), Vec<D>(1)});
        for (Aabb<D>& box : boxes) std::swap(box.min[bad], box.max[bad]);
        AnyBroadPhase<D> phase = empty;
        phase.build(boxes);
        EXPECT_EQ(visits(phase, Aabb<D>{Vec<D>(0), Vec<D>(1)}), 0u);
        EXPECT_EQ(phase.bounds(), Aabb<D>::empty());
    }
    EXPECT_EQ(asserts_seen, 0);
}
TYPED_TEST(BadBoxes, AreEmptyWhereOneAxisIsTheWrongWayRound) {
    are_empty_where_one_axis_is_the_wrong_way_round(this->empty);
}

template <int D>
void as_queries_visit_nothing(const AnyBroadPhase<D>& empty) {
    const std::vector<Aabb<D>> boxes(9, {Vec<D>(0), Vec<D>(1)});
    AnyBroadPhase<D> phase = empty;
    phase.build(boxes);
    const std::uint32_t pairs = 9 * 8 / 2 + 9 * 9;
    EXPECT_EQ(visits(phase, boxes[0]), pairs + 4 * 9);
    Vec<D> point(0);
    point[D - 1] = nan;
    EXPECT_EQ(visits(phase, Aabb<D>{point, point}), pairs);
    int found = 0;
    phase.closest(
        Vec<D>(0), [&](std::uint32_t) { ++found; }, nan);
    phase.raycast(Ray<D>{Vec<D>(0), Vec<D>(axis<D>(0)), nan}, [&](std::uint32_t) { ++found; });
    EXPECT_EQ(found, 0);
}
TYPED_TEST(BadBoxes, AsQueriesVisitNothing) {
    as_queries_visit_nothing(this->empty);
}

template <int D>
void another_count_in_an_update_builds_anew(const AnyBroadPhase<D>& empty) {
    AnyBroadPhase<D> phase = empty;
    phase.build(std::vector<Aabb<D>>(3, {Vec<D>(0), Vec<D>(1)}));
    phase.update(std::vector<Aabb<D>>(5, {Vec<D>(0), Vec<D>(1)}));
    EXPECT_EQ(phase.size(), 5u);
    EXPECT_EQ(visits(phase, Aabb<D>::empty()), 10u + 25u);
    EXPECT_EQ(asserts_seen > 0, asserts_on);
}
TYPED_TEST(BadBoxes, AnotherCountInAnUpdateBuildsAnew) {
    another_count_in_an_update_builds_anew(this->empty);
}

}  // namespace
}  // namespace abut::test
