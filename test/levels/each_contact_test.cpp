// Contacts of levels of every kind, against their parts one by one.

#include "../oracle/pair.hpp"
#include "levels.hpp"
#include <abut/query/closest.hpp>
#include <abut/query/each_contact.hpp>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

/// A reference composite that visits all parts of a level. Its box is the level's, because the size and center of the
/// box affect the surface normals of two level shapes.
template <int D>
struct OneByOne {
    std::vector<LevelPart<D>> parts;
    Aabb<D> box;
};
template <int D>
Aabb<D> bounds(const OneByOne<D>& shape) {
    return shape.box;
}
template <int D, class Visit>
void each_part(const OneByOne<D>& shape, const Aabb<D>& box, Visit&& visit) {
    for (const LevelPart<D>& part : shape.parts) {
        const auto& convex = std::get<Convex<D>>(part.view);
        if (overlaps(bounds(convex), box) && !visit(convex, part.index)) return;
    }
}

namespace {

constexpr float rounding = 2e-5f;

template <int D>
std::vector<Contact<D>> contacts_of(const View<D>& a, const View<D>& b, float margin) {
    std::vector<Contact<D>> result;
    each_contact(a, b, [&](const Contact<D>& contact) { result.push_back(contact); }, {.margin = margin});
    return result;
}

template <int D>
bool has_same_parts(const Contact<D>& one, const Contact<D>& other) {
    return one.feature_a.part == other.feature_a.part && one.feature_b.part == other.feature_b.part;
}
/// Whether two contacts are equal except for rounding.
template <int D>
bool is_same(const Contact<D>& one, const Contact<D>& other) {
    return std::abs(one.depth - other.depth) < rounding && length(DVec<D>(one.normal) - DVec<D>(other.normal)) < 1e-3;
}

struct Counts {
    int samples = 0, touching = 0, reported = 0, alone = 0, own = 0, missed = 0, surface_normals = 0, covered = 0,
        reported_though_covered = 0;
};

/// Counts the contacts of one list that are missing in the other. A substitute contact may come from another part.
template <int D>
void expect_same(const std::vector<Contact<D>>& found, const std::vector<Contact<D>>& others, Counts& counts) {
    for (const Contact<D>& contact : found) {
        ++counts.reported;
        const bool has_it =
            std::any_of(others.begin(), others.end(), [&](const Contact<D>& other) { return is_same(contact, other); });
        counts.missed += has_it ? 0 : 1;
    }
}

template <int D>
void check_lists(const View<D>& level, const View<D>& one_by_one, const std::vector<LevelPart<D>>& parts,
                 const View<D>& other, float margin, Counts& counts) {
    const std::vector<Contact<D>> found = contacts_of(level, other, margin);
    const std::vector<Contact<D>> expected = contacts_of(one_by_one, other, margin);
    expect_same(found, expected, counts);
    expect_same(expected, found, counts);
    // The reported contacts are of touching parts. Unless they are deep in many others, most have their own normal and
    // depth.
    const bool is_convex = !std::holds_alternative<Composite<D>>(other);
    for (const Contact<D>& contact : found) {
        bool touches = false, own = false;
        for (const LevelPart<D>& part : parts) {
            if (part.index != contact.feature_a.part) continue;
            const Contact<D> alone = abut::contact(part.view, other, {.margin = margin});
            touches = touches || alone;
            own = own || (alone && is_same(contact, alone));
        }
        EXPECT_TRUE(touches);
        counts.alone += is_convex ? 1 : 0;
        counts.own += is_convex && own ? 1 : 0;
    }
    // The swapped pair has as many contacts.
    if (is_convex) {
        EXPECT_EQ(contacts_of(other, level, margin).size(), found.size());
    }
    ++counts.samples;
    counts.touching += found.empty() ? 0 : 1;
}

/// Tests the definition for a ball with its center outside of all parts: a part's own normal is a surface normal iff no
/// other part is nearer to a point 1e-3 of the size above the surface.
template <int D>
void check_ball(const View<D>& level, const std::vector<LevelPart<D>>& parts, const Ball<D>& ball, Counts& counts) {
    const auto distance_to = [&](const LevelPart<D>& part, const Vec<D>& point) {
        return closest(part.view, point).distance;
    };
    for (const LevelPart<D>& part : parts)
        if (distance_to(part, ball.center) < 0.05f * ball.radius) return;
    const std::vector<Contact<D>> found = contacts_of(level, View<D>(view(ball)), 0);
    const float s = 1e-3f * ball.radius;
    for (const LevelPart<D>& part : parts) {
        const Contact<D> alone = contact(part.view, ball);
        if (!alone) continue;
        const Vec<D> beside = closest(part.view, ball.center).on_a + alone.normal * s;
        const float own = distance_to(part, beside);
        // A one-sided part covers nothing behind it.
        float others = std::numeric_limits<float>::infinity(), two_sided = others;
        for (const LevelPart<D>& beyond : parts) {
            if (&beyond == &part) continue;
            const float distance = distance_to(beyond, beside);
            others = std::min(others, distance);
            if (!std::get<Convex<D>>(beyond.view).one_sided) two_sided = std::min(two_sided, distance);
        }
        const bool is_reported = std::any_of(found.begin(), found.end(), [&](const Contact<D>& one) {
            return one.feature_a.part == part.index && is_same(one, alone);
        });
        // It may be joined to a deeper one on the same plane.
        const bool is_joined = std::any_of(found.begin(), found.end(), [&](const Contact<D>& one) {
            return one.depth > alone.depth - rounding && length(DVec<D>(one.normal) - DVec<D>(alone.normal)) < 6e-3;
        });
        if (others > own + 0.1f * s) {
            EXPECT_TRUE(is_joined);
            ++counts.surface_normals;
        } else if (two_sided < own - 0.1f * s) {
            ++counts.covered;
            // A substitute contact may be equal by chance.
            counts.reported_though_covered += is_reported ? 1 : 0;
        }
    }
}

template <int D>
void check_levels(std::uint32_t kind, int rounds) {
    Counts counts;
    for (int round = 0; round < rounds; ++round) {
        SCOPED_TRACE("seed " + std::to_string(round) + ", kind " + std::to_string(kind));
        oracle::Random random(static_cast<std::uint64_t>(round) * 5 + kind);
        const Placing<D> placing = random_placing<D>(random);
        const PlacedLevel<D> level(random_level<D>(random, kind), placing);
        const OneByOne<D> one_by_one{level.level.parts, bounds(level.level.shape.view())};
        const View<D> unordered = placing(View<D>(view(one_by_one)));
        const Other<D> other = random_other<D>(random, level);
        const float margin = random.chance(0.5) ? 0 : 0.05f;
        check_lists<D>(level.view, unordered, level.parts, other.view, margin, counts);
        for (int i = 0; i < 4; ++i) {
            const Vec<D> center = near_some_part(random, level) + random_point<D>(random, 0.5);
            check_ball<D>(level.view, level.parts, {center, random.uniform_float(0.1, 0.6)}, counts);
        }
        if (testing::Test::HasFatalFailure() || testing::Test::HasNonfatalFailure()) return;
    }
    // The level and its parts are rounded differently, which decides cases at the threshold.
    EXPECT_LE(counts.missed, 1e-3 * counts.reported) << counts.reported;
    EXPECT_LE(counts.reported_though_covered, 0.05 * counts.covered) << counts.covered;
    // The sample is not vacuous.
    EXPECT_GT(counts.touching, 0.5 * counts.samples) << counts.samples;
    EXPECT_GT(counts.own, 0.5 * counts.alone) << counts.alone;
    EXPECT_GT(counts.surface_normals, counts.samples);
    EXPECT_GT(counts.covered, 0.3 * counts.samples) << counts.samples;
}

TEST(LevelContacts, OfChainsAgreeWithTryingAllSegments) {
    check_levels<2>(0, oracle::case_count(150));
}
TEST(LevelContacts, OfTileMapsAgreeWithTryingAllTiles) {
    check_levels<2>(1, oracle::case_count(100));
}
TEST(LevelContacts, OfCompoundsOfThePlaneAgreeWithTryingAllParts) {
    check_levels<2>(2, oracle::case_count(100));
}
TEST(LevelContacts, OfSolidsOfThePlaneAgreeWithTryingAllParts) {
    check_levels<2>(3, oracle::case_count(100));
}
TEST(LevelContacts, OfHeightFieldsAgreeWithTryingAllTriangles) {
    check_levels<3>(0, oracle::case_count(60));
}
TEST(LevelContacts, OfVoxelMapsAgreeWithTryingAllVoxels) {
    check_levels<3>(4, oracle::case_count(60));
}
TEST(LevelContacts, OfMeshesAgreeWithTryingAllTriangles) {
    check_levels<3>(1, oracle::case_count(60));
}
TEST(LevelContacts, OfCompoundsInSpaceAgreeWithTryingAllParts) {
    check_levels<3>(2, oracle::case_count(60));
}
TEST(LevelContacts, OfSolidsInSpaceAgreeWithTryingAllParts) {
    check_levels<3>(3, oracle::case_count(60));
}

}  // namespace
}  // namespace abut::test
