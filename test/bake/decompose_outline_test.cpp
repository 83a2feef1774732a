#include "../../scenes/outlines.hpp"
#include "../oracle/bake/outline_parts.hpp"
#include "../oracle/is_long.hpp"
#include "../oracle/random.hpp"
#include <abut/bake/decompose_outline.hpp>
#include <abut/query/contains.hpp>

#include <map>
#include <utility>

#include <gtest/gtest.h>

namespace abut {

using namespace detail;

namespace {

using oracle::Integer;
using oracle::OutlineParts;
using scenes::Outline;

using Ring = std::vector<Vec2>;
using Rings = std::vector<Ring>;

constexpr float infinity = std::numeric_limits<float>::infinity();

Ring square(float x, float y, float size) {
    return {{x, y}, {x + size, y}, {x + size, y + size}, {x, y + size}};
}

Ring reversed(Ring ring) {
    std::ranges::reverse(ring);
    return ring;
}

/// The checked parts of an outline.
std::vector<Polygon> checked(const Ring& ring, const Rings& holes, const Integer& twice_area,
                             OutlineOptions options = {}, OutlineReport* report_out = nullptr) {
    OutlineReport report;
    options.report = &report;
    const Result<std::vector<Polygon>> parts = decompose(ring, holes, options);
    EXPECT_TRUE(parts) << parts.problem().message;
    if (!parts) return {};
    const OutlineParts oracle(ring, holes, *parts);
    if (report.thin_pieces == 0) {
        EXPECT_EQ(oracle.fault(twice_area), "");
    }
    if (options.conforming) {
        EXPECT_EQ(oracle.fault_of_junctions(), "");
    }
    EXPECT_EQ(report.pieces, parts->size());
    EXPECT_LE(report.min_pieces, parts->size());
    if (report_out != nullptr) *report_out = report;
    return *parts;
}

std::vector<Polygon> checked(const Ring& ring, const Rings& holes = {}, const OutlineOptions& options = {}) {
    return checked(ring, holes, oracle::twice_area(ring, holes), options);
}

/// In units of the rings' own coordinates.
Integer twice_of(int area) {
    return oracle::to_integer(1) * oracle::to_integer(1) * 2 * area;
}

TEST(DecomposeOutline, LeavesAConvexRingAsItIs) {
    const Ring ring{{2, 0}, {1, 0}, {0, 0}, {0, 3}, {2, 3}};  // clockwise, with a point in a straight stretch
    const std::vector<Polygon> parts = checked(ring);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_EQ(Ring(parts[0].points().begin(), parts[0].points().end()), (Ring{{0, 0}, {2, 0}, {2, 3}, {0, 3}}));
}

TEST(DecomposeOutline, CutsAtReflexCorners) {
    EXPECT_EQ(checked({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}).size(), 2u);  // an L
    // A cross of two bars: four reflex corners, and the square between them.
    EXPECT_EQ(checked({{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}})
                  .size(),
              3u);
    EXPECT_EQ(checked(square(0, 0, 3), {square(1, 1, 1)}).size(), 4u);
}

TEST(DecomposeOutline, TellsWhatItDid) {
    OutlineReport report;
    const Ring ring{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    EXPECT_EQ(checked(ring, {}, oracle::twice_area(ring), {}, &report).size(), 2u);
    EXPECT_EQ(report.reflex_corners, 1u);
    EXPECT_EQ(report.min_pieces, 2u);
    EXPECT_TRUE(report.optimal);
    EXPECT_EQ(report.area, 3);
    EXPECT_EQ(report.area_added, 0);
}

// ---- problems of the input

TEST(DecomposeOutline, LeavesOutRepeatedPointsAndSpikes) {
    OutlineReport report;
    const Ring ring{{0, 0}, {4, 0}, {4, 0}, {4, 4}, {6, 6}, {4, 4}, {2, 4}, {2, 2}, {2, 4}, {0, 4}, {0, 0}};
    const auto parts = decompose(ring, {}, {.report = &report});
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), 1u);
    EXPECT_TRUE(std::ranges::equal(parts->front().points(), square(0, 0, 4)));
    EXPECT_EQ(report.repeated_points, 2u);
    EXPECT_EQ(report.cancelled_edges, 2u);
    EXPECT_EQ(report.touching_points, 2u);
}

TEST(DecomposeOutline, LeavesOutWhatIsGoneAlongAndBackInPart) {
    // Too far along the floor, and back; and upwards, where the path back has two steps.
    EXPECT_EQ(checked({{0, 0}, {6, 0}, {3, 0}, {3, 4}, {0, 4}}, {}, twice_of(12)).size(), 1u);
    EXPECT_EQ(checked({{0, 0}, {3, 0}, {3, 9}, {3, 7}, {3, 4}, {0, 4}}, {}, twice_of(12)).size(), 1u);
    EXPECT_EQ(checked({{0, 0}, {9, 0}, {7, 0}, {9, 0}, {3, 0}, {3, 4}, {0, 4}, {0, 5}}, {}, twice_of(12)).size(), 1u);
    // A spike to the inside, of which nothing remains.
    const std::vector<Polygon> clean = checked({{0, 0}, {3, 0}, {3, -1}, {9, -1}, {9, 4}, {0, 4}});
    const auto parts = decompose(Ring{{0, 0}, {6, 0}, {3, 0}, {3, -1}, {9, -1}, {9, 4}, {0, 4}});
    ASSERT_TRUE(parts);
    ASSERT_EQ(parts->size(), clean.size());
    for (std::size_t i = 0; i < clean.size(); ++i)
        EXPECT_TRUE(std::ranges::equal((*parts)[i].points(), clean[i].points()));
}

TEST(DecomposeOutline, TakesHolesThatTouchTheOutline) {
    const Ring outline = square(0, 0, 4);
    checked(outline, {{{0, 0}, {2, 1}, {1, 2}}}, twice_of(16) - twice_of(3) / 2);             // a corner on a corner
    checked(outline, {{{1, 0}, {2, 1}, {1, 2}}}, twice_of(15));                               // a corner on an edge
    EXPECT_EQ(checked(outline, {square(1, 0, 2)}, twice_of(12)).size(), 3u);                  // along an edge
    EXPECT_EQ(checked(outline, {square(0, 0, 2)}, twice_of(12)).size(), 2u);                  // along two
    EXPECT_EQ(checked(outline, {{{0, 0}, {4, 0}, {4, 2}, {0, 2}}}, twice_of(8)).size(), 1u);  // along three
}

TEST(DecomposeOutline, TakesHolesThatTouchEachOther) {
    const Ring outline = square(0, 0, 8);
    checked(outline, {square(1, 1, 2), square(3, 1, 2)}, twice_of(56));
    checked(outline, {square(1, 1, 2), square(3, 3, 2), square(1, 5, 2), square(5, 5, 2)}, twice_of(48));
    checked(outline, {square(1, 1, 4), square(2, 2, 2)}, twice_of(48));            // one in the other
    checked(outline, {square(1, 1, 4), square(1, 1, 4)}, twice_of(48));            // twice the same
    checked(outline, {square(1, 1, 2), reversed(square(3, 2, 2))}, twice_of(56));  // along a part of an edge
}

TEST(DecomposeOutline, TakesOutlinesThatTouchThemselves) {
    // Two squares that share a corner, as one ring, with either winding.
    EXPECT_EQ(checked({{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {1, 2}, {1, 1}, {0, 1}}, {}, twice_of(2)).size(), 2u);
    EXPECT_EQ(checked({{0, 0}, {1, 0}, {1, 1}, {1, 2}, {2, 2}, {2, 1}, {1, 1}, {0, 1}}, {}, twice_of(2)).size(), 2u);
    // A ring around a square hole, with a slit.
    const Ring slit{{0, 0}, {3, 0}, {3, 3}, {2, 2}, {2, 1}, {1, 1}, {1, 2}, {2, 2}, {3, 3}, {0, 3}};
    EXPECT_EQ(checked(slit, {}, twice_of(8)).size(), 4u);
    // The square twice around is empty by the even-odd rule; three times is once.
    const Ring once = square(0, 0, 1);
    Ring rounds = once;
    rounds.insert(rounds.end(), once.begin(), once.end());
    EXPECT_EQ(decompose(rounds).problem().code, ProblemCode::degenerate);
    rounds.insert(rounds.end(), once.begin(), once.end());
    EXPECT_EQ(checked(rounds, {}, twice_of(1)).size(), 1u);
}

TEST(DecomposeOutline, TellsOfHolesThatTakeNothing) {
    OutlineReport report;
    checked(square(0, 0, 4), {square(9, 9, 1), square(1, 1, 2), {{1.5f, 1.5f}, {2, 2}, {1.5f, 2}}}, twice_of(12), {},
            &report);
    EXPECT_EQ(report.idle_holes, 2u);
}

TEST(DecomposeOutline, NamesEdgesThatCross) {
    const Result<std::vector<Polygon>> bow = decompose(Ring{{0, 0}, {2, 2}, {2, 0}, {0, 2}});
    ASSERT_FALSE(bow);
    EXPECT_EQ(bow.problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(bow.problem().index, 0u);
    EXPECT_EQ(bow.problem().message.substr(0, 58), "edge 0 of the outline crosses edge 2 of the outline, left ");
    const Result<std::vector<Polygon>> hole = decompose(square(0, 0, 4), Rings{square(1, 1, 1), square(3, 1, 2)});
    ASSERT_FALSE(hole);
    EXPECT_EQ(hole.problem().message.substr(0, 47), "edge 1 of the outline crosses edge 0 of hole 1,");
    EXPECT_EQ(hole.problem().index, 1u);
}

TEST(DecomposeOutline, NamesWhatIsWrong) {
    EXPECT_EQ(decompose(Ring{}).problem().code, ProblemCode::empty_input);
    const Result<std::vector<Polygon>> infinite = decompose(square(0, 0, 1), Rings{{}, {{0, 0}, {1, infinity}}});
    EXPECT_EQ(infinite.problem().code, ProblemCode::not_finite);
    EXPECT_EQ(infinite.problem().index, 1u);
    EXPECT_EQ(infinite.problem().message, "point 1 of hole 1 is not finite");
    for (const Ring& nothing : Rings{{{1, 2}}, {{1, 2}, {3, 4}}, {{0, 0}, {1, 1}, {2, 2}}})
        EXPECT_EQ(decompose(nothing).problem().code, ProblemCode::degenerate);
    EXPECT_EQ(decompose(square(0, 0, 1), Rings{square(-1, -1, 3)}).problem().code, ProblemCode::degenerate);
    EXPECT_EQ(decompose(square(0, 0, 1), {}, {.concavity = -1}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(decompose(square(0, 0, 1), {}, {.concavity = NAN}).problem().code, ProblemCode::bad_argument);
    EXPECT_EQ(decompose(square(0, 0, 1), {}, {.concavity = 1, .conforming = true}).problem().code,
              ProblemCode::bad_argument);
}

// ---- invariants

TEST(DecomposeOutline, TakesScenesApart) {
    for (const bool conforming : {false, true}) {
        SCOPED_TRACE(conforming);
        const OutlineOptions options{.conforming = conforming};
        for (const std::uint32_t corners : {5u, 30u, 100u, 300u, 1200u}) {
            SCOPED_TRACE(corners);
            for (const double inner : {0.05, 0.5, 0.9}) checked(scenes::star(corners, inner, 3), {}, options);
        }
        checked(scenes::spiky_star(400, 3), {}, options);
        for (const std::uint32_t teeth : {1u, 2u, 20u, 300u}) {
            const std::size_t parts = checked(scenes::comb(teeth), {}, options).size();
            if (!conforming) {
                EXPECT_EQ(parts, teeth == 1 ? 1u : teeth + 1);
            }
        }
        const Outline plate = scenes::plate(5, 24, 3);
        checked(plate.ring, plate.holes, options);
    }
}

TEST(DecomposeOutline, TakesRandomRingsApart) {
    std::size_t rings = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const double scale = random.power_of_two(-140, 120);
        const auto offset = random.chance(0.3) ? random.in_cube<2>() * (scale * 1000) : DVec<2>(0.0);
        Ring points;
        const std::uint32_t count = 4 + random.below(60);
        for (std::uint32_t i = 0; i < count; ++i) points.push_back(to_float(offset + random.in_cube<2>() * scale));
        const Ring ring = scenes::simple_ring(points);
        if (ring.empty()) continue;
        ++rings;
        checked(ring, {}, {.conforming = random.chance(0.5)});
    }
    EXPECT_GT(rings, 40u);
}

/// Unit cells as holes, in any number: they share corners and edges with each other and the outline.
TEST(DecomposeOutline, TakesCellsOutOfASquare) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const int size = 2 + static_cast<int>(random.below(9));
        Rings holes;
        int left = size * size;
        const double share = random.unit();
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                if (random.chance(share) && left > 1) {
                    Ring hole = square(static_cast<float>(x), static_cast<float>(y), 1);
                    std::rotate(hole.begin(), hole.begin() + random.below(4), hole.end());
                    holes.push_back(random.chance(0.5) ? hole : reversed(hole));
                    --left;
                }
        checked(square(0, 0, static_cast<float>(size)), holes, twice_of(left), {.conforming = random.chance(0.5)});
    }
}

/// Random rings on a small grid, which touch themselves and each other without crossing.
TEST(DecomposeOutline, TakesRingsThatTouchAnyhow) {
    std::size_t taken = 0, touching = 0, refused = 0;
    const std::uint64_t samples = oracle::is_long() ? 200'000 : 5000;
    for (std::uint64_t seed = 0; seed < samples; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const std::uint32_t cells = 3 + random.below(4);
        Rings rings(1 + random.below(4));
        for (Ring& ring : rings) {
            // Steps to neighbours on the grid cross only in corners; longer ones may not.
            Vec2 at(static_cast<float>(random.below(cells)), static_cast<float>(random.below(cells)));
            const Vec2 first = at;
            const bool in_steps = random.chance(0.8);
            for (std::uint32_t i = 0, count = 3 + random.below(24); i < count; ++i) {
                ring.push_back(at);
                const auto step = [&] { return static_cast<float>(random.below(3)) - 1; };
                at = in_steps ? (random.chance(0.5) ? at + Vec2(step(), 0) : at + Vec2(0, step()))
                              : Vec2(static_cast<float>(random.below(cells)), static_cast<float>(random.below(cells)));
            }
            if (in_steps) ring.emplace_back(at.x, first.y);
        }
        const Ring outline = rings.back();
        rings.pop_back();
        OutlineReport report;
        const bool conforming = random.chance(0.5);
        const auto parts = decompose(outline, rings, {.conforming = conforming, .report = &report});
        if (!parts) {
            refused += parts.problem().code == ProblemCode::bad_argument ? 1u : 0u;
            EXPECT_TRUE(parts.problem().code == ProblemCode::bad_argument ||
                        parts.problem().code == ProblemCode::degenerate);
            continue;
        }
        ++taken;
        touching += report.touching_points > 0 ? 1u : 0u;
        const OutlineParts oracle(outline, rings, *parts);
        EXPECT_EQ(oracle.fault_of_corners(), "");
        EXPECT_EQ(oracle.fault_of_overlaps(), "");
        EXPECT_EQ(oracle.fault_of_middles(), "");
        if (conforming) {
            EXPECT_EQ(oracle.fault_of_junctions(), "");
        }
        for (int i = 0; i < 20; ++i)
            EXPECT_EQ(oracle.fault_at({random.uniform_float(-2, 8), random.uniform_float(-2, 8)}), "");
    }
    EXPECT_GT(taken, samples / 3);
    EXPECT_GT(touching, samples / 4);
    EXPECT_GT(refused, samples / 20);
}

TEST(DecomposeOutline, DoesNotDependOnWhereARingBegins) {
    const Ring ring = scenes::star(300, 0.2, 5);
    const std::vector<Polygon> parts = checked(ring);
    Ring other = reversed(ring);
    std::rotate(other.begin(), other.begin() + 77, other.end());
    const std::vector<Polygon> others = checked(other);
    ASSERT_EQ(parts.size(), others.size());
    for (std::size_t i = 0; i < parts.size(); ++i)
        EXPECT_TRUE(std::ranges::equal(parts[i].points(), others[i].points())) << i;
}

TEST(DecomposeOutline, LeavesJunctionsOnlyWhereAllowed) {
    // A comb whose teeth are cut off along one line: the bar has all their roots in an edge.
    const Ring comb = scenes::comb(5);
    const std::vector<Polygon> parts = checked(comb);
    EXPECT_NE(OutlineParts(comb, {}, parts).fault_of_junctions(), "");
    EXPECT_GT(checked(comb, {}, {.conforming = true}).size(), parts.size());
}

// ---- the minimum number of parts

/// Brute force over every cut, recursively: exact, and too slow above about ten corners.
class EveryCut {
public:
    EveryCut(const Ring& ring, bool conforming) : ring_(ring), conforming_(conforming) {
        std::vector<std::uint32_t> all(ring.size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        fewest_ = fewest(all);
    }
    std::size_t fewest() const { return fewest_; }

private:
    int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return orientation(ring_[a], ring_[b], ring_[c]);
    }
    /// Extends only along edges of the ring, where no other piece can have a corner, if the parts must be conforming.
    bool may_turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        const auto count = static_cast<std::uint32_t>(ring_.size());
        const int side = turn(a, b, c);
        return side > 0 || (side == 0 && (!conforming_ || ((a + 1) % count == b && (b + 1) % count == c)));
    }
    bool between(std::uint32_t a, std::uint32_t p, std::uint32_t b) const {
        const DVec<2> u(ring_[a] - ring_[p]), v(ring_[b] - ring_[p]);
        return turn(a, b, p) == 0 && dot(u, v) < 0;
    }
    bool is_cut(const std::vector<std::uint32_t>& loop, std::size_t i, std::size_t k) const {
        const std::size_t count = loop.size();
        const std::uint32_t a = loop[i], b = loop[k];
        for (std::size_t j = 0; j < count; ++j) {
            const std::uint32_t p = loop[j], q = loop[(j + 1) % count];
            if (between(a, p, b)) return false;
            if (turn(a, b, p) * turn(a, b, q) < 0 && turn(p, q, a) * turn(p, q, b) < 0) return false;
        }
        const std::uint32_t last = loop[(i + count - 1) % count], next = loop[(i + 1) % count];
        const bool left = turn(a, next, b) > 0, right = turn(last, a, b) > 0;
        if (turn(a, next, b) == 0 && turn(last, a, b) == 0) return false;
        return turn(last, a, next) > 0 ? left && right : left || right;
    }
    std::size_t fewest(const std::vector<std::uint32_t>& loop) {
        if (const auto found = known_.find(loop); found != known_.end()) return found->second;
        const std::size_t count = loop.size();
        bool convex = true;
        for (std::size_t i = 0; i < count; ++i)
            convex = convex && may_turn(loop[i], loop[(i + 1) % count], loop[(i + 2) % count]);
        if (convex) return known_[loop] = 1;
        std::size_t best = count;
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t k = i + 2; k < count; ++k) {
                if ((i == 0 && k + 1 == count) || !is_cut(loop, i, k)) continue;
                std::vector<std::uint32_t> inner(loop.begin() + static_cast<std::ptrdiff_t>(i),
                                                 loop.begin() + static_cast<std::ptrdiff_t>(k) + 1);
                std::vector<std::uint32_t> outer(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(i) + 1);
                outer.insert(outer.end(), loop.begin() + static_cast<std::ptrdiff_t>(k), loop.end());
                best = std::min(best, fewest(inner) + fewest(outer));
            }
        return known_[loop] = best;
    }

    const Ring& ring_;
    bool conforming_;
    std::map<std::vector<std::uint32_t>, std::size_t> known_;
    std::size_t fewest_ = 0;
};

TEST(DecomposeOutline, MakesAsFewPartsAsEveryCut) {
    std::size_t rings = 0, straight = 0, conforming_has_more = 0;
    const std::uint64_t samples = oracle::is_long() ? 20'000 : 600;
    for (std::uint64_t seed = 0; seed < samples; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const std::uint32_t count = 4 + random.below(6), cells = 3 + random.below(4);
        const bool on_grid = random.chance(0.7);
        Ring points;
        for (std::uint32_t i = 0; i < count; ++i)
            points.push_back(
                on_grid ? Vec2(static_cast<float>(random.below(cells)), static_cast<float>(random.below(cells)))
                        : to_float(random.in_cube<2>()));
        Ring ring = scenes::simple_ring(points);
        if (ring.empty()) continue;
        ++rings;
        if (oracle::twice_area(ring) < 0) ring = reversed(ring);
        for (std::size_t i = 0; i < ring.size(); ++i)
            straight += orientation(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) == 0 ? 1u : 0u;
        OutlineReport report;
        std::size_t fewest[2];
        for (const bool conforming : {false, true}) {
            const Integer area = oracle::twice_area(ring);
            const std::size_t parts = checked(ring, {}, area, {.conforming = conforming}, &report).size();
            fewest[conforming ? 1 : 0] = EveryCut(ring, conforming).fewest();
            EXPECT_EQ(parts, fewest[conforming ? 1 : 0]);
            EXPECT_TRUE(report.optimal);
        }
        conforming_has_more += fewest[1] > fewest[0] ? 1u : 0u;
    }
    EXPECT_GT(rings, samples / 3);
    EXPECT_GT(straight, samples / 20);
    EXPECT_GT(conforming_has_more, samples / 100);
}

/// The result of optimal_convex_partition_2 of CGAL 5.5.
TEST(DecomposeOutline, MakesAsFewPartsAsOthersFindAtLeast) {
    const std::pair<double, std::size_t> known[] = {{0.001, 37}, {0.02, 38}, {0.1, 43},
                                                    {0.3, 45},   {0.5, 41},  {0.8, 35}};
    for (const auto& [inner, fewest] : known) EXPECT_EQ(checked(scenes::star(100, inner, 1)).size(), fewest) << inner;
    EXPECT_EQ(checked(scenes::spiky_star(100, 1)).size(), 66u);
    EXPECT_EQ(checked(scenes::comb(25)).size(), 26u);
}

// ---- parts that may add area

bool covered(std::span<const Polygon> parts, const Vec2& point) {
    return std::ranges::any_of(parts, [&](const Polygon& part) {
        const std::span<const Vec2> loop = part.points();
        for (std::size_t i = 0; i < loop.size(); ++i)
            if (orientation(loop[i], loop[(i + 1) % loop.size()], point) < 0) return false;
        return true;
    });
}

TEST(DecomposeOutline, CoversAllWithFewerPartsThatAdd) {
    const Ring ring = scenes::star(400, 0.8, 9);
    const std::vector<Polygon> exact = checked(ring);
    std::size_t last = exact.size();
    double last_added = 0;
    for (const double concavity : {0.01, 0.05, 0.1, 0.15}) {
        SCOPED_TRACE(concavity);
        OutlineReport report;
        const Result<std::vector<Polygon>> parts = decompose(ring, {}, {.concavity = concavity, .report = &report});
        ASSERT_TRUE(parts);
        EXPECT_LT(parts->size(), last);
        EXPECT_GT(report.area_added, last_added);
        last = parts->size();
        last_added = report.area_added;
        oracle::Random random(1);
        for (const Polygon& part : exact) {
            for (const Vec2& corner : part.points()) EXPECT_TRUE(covered(*parts, corner));
            const DVec<2> a(part.points()[0]), b(part.points()[1]), c(part.points()[2]);
            const double u = random.unit(), v = random.unit() * (1 - u);
            EXPECT_TRUE(covered(*parts, to_float(a + (b - a) * u + (c - a) * v)));
        }
    }
}

TEST(DecomposeOutline, LeavesNotchesDeeperThanTheLimit) {
    // Two notches, 1 and 2 deep, from above.
    const Ring ring{{0, 0}, {6, 0}, {9, 0}, {9, 4}, {7, 4}, {6, 2}, {5, 4}, {4, 4}, {3, 3}, {2, 4}, {0, 4}};
    const auto count = [&](double concavity) { return decompose(ring, {}, {.concavity = concavity})->size(); };
    EXPECT_EQ(count(0), 3u);
    EXPECT_EQ(count(0.9), 3u);
    EXPECT_EQ(count(1), 2u);
    EXPECT_EQ(count(1.9), 2u);
    EXPECT_EQ(count(2), 1u);
}

TEST(DecomposeOutline, FillsHolesUpToTheLimit) {
    OutlineReport report;
    const Rings holes{square(1, 1, 1), square(4, 4, 3)};
    const auto parts = decompose(square(0, 0, 20), holes, {.concavity = 2, .report = &report});
    ASSERT_TRUE(parts);
    EXPECT_EQ(report.filled_holes, 1u);
    EXPECT_FALSE(covered(*parts, {5.5f, 5.5f}));
    EXPECT_TRUE(covered(*parts, {1.5f, 1.5f}));
}

}  // namespace
}  // namespace abut
