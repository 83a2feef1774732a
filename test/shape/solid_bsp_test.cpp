// Solid BSP trees: containment against exact winding numbers, the order of faces, and building.

#include "solid_levels.hpp"
#include <abut/math/dvec.hpp>

#include <iostream>
#include <limits>
#include <map>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

struct Count {
    int inside = 0, checked = 0;
};

template <int D>
void expect_solid(const Level<D>& level, const SolidBsp<D>& tree, const Vec<D>& p, bool hollow, Count& count) {
    const Place place = place_in(level, p, hollow);
    if (place == Place::on_nothing) return;
    const bool expected = place == Place::inside;
    ASSERT_EQ(tree.contains(p), expected) << p.x << " " << p.y << " " << p[D - 1];
    count.inside += expected ? 1 : 0;
    ++count.checked;
}

template <int D>
void expect_solid_everywhere(const Level<D>& level, bool hollow, oracle::Random& random, int points, Count& count) {
    const SolidBsp<D> tree = level.tree();
    Aabb<D> box = tree.bounds();
    const Vec<D> extent = box.max - box.min;
    for (int i = 0; i < points; ++i) {
        Vec<D> p;
        for (int axis = 0; axis < D; ++axis) p[axis] = box.min[axis] + extent[axis] * random.uniform_float(-0.1, 1.1);
        if (i % 4 == 1)
            for (int axis = 0; axis < D; ++axis) p[axis] = std::floor(p[axis]);
        if (i % 4 == 2)
            p[static_cast<int>(random.below(D))] =
                level.points[random.below(static_cast<std::uint32_t>(level.points.size()))][0];
        if (i % 4 == 3) {
            const std::size_t face = random.below(static_cast<std::uint32_t>(level.faces.size()));
            p = 0.5f * (level.corner(face, 0) + level.corner(face, 1));
        }
        expect_solid(level, tree, p, hollow, count);
        if (testing::Test::HasFatalFailure()) return;
    }
    for (const Vec<D>& p : level.points) {
        expect_solid(level, tree, p, hollow, count);
        if (testing::Test::HasFatalFailure()) return;
    }
}

/// A pillar with a courtyard in it, and a smaller one in that.
Level<2> random_block(oracle::Random& random, double size) {
    Level<2> level;
    const int count = 12 + static_cast<int>(random.below(30));  // so many that each outline goes round the next
    add_outline(level, star(random, count, Vec2(0), 0.6 * size, size));
    Level<2> hole;
    add_outline(hole, star(random, 12 + static_cast<int>(random.below(20)), Vec2(0), 0.3 * size, 0.5 * size));
    turn_around(hole);
    const auto first = static_cast<std::uint32_t>(level.points.size());
    level.points.insert(level.points.end(), hole.points.begin(), hole.points.end());
    for (const auto& face : hole.faces) level.faces.push_back(face + first);
    add_outline(level, star(random, 5, Vec2(0), 0.1 * size, 0.25 * size));
    return level;
}

TEST(SolidBsp2, ContainsWhatOutlinesWindAround) {
    oracle::Random random(61);
    Count count;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 61 level " << i);
        Level<2> level = random_block(random, i % 6 == 3 ? 8 : 100);
        if (i % 2 == 0) snap(level);
        const bool hollow = i % 5 == 0;
        if (hollow) turn_around(level);
        expect_solid_everywhere(level, hollow, random, 100, count);
        if (HasFatalFailure()) return;
    }
    std::cout << count.inside << " of " << count.checked << " inside\n";
    EXPECT_GT(count.inside, count.checked / 4);
    EXPECT_LT(count.inside, count.checked * 3 / 4);
}

TEST(SolidBsp2, OutlinesThatOverlapThemselvesAndOneAnother) {
    oracle::Random random(62);
    Count count;
    for (int i = 0; i < 200; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 62 level " << i);
        Level<2> level;
        for (int k = 0; k < 4; ++k)
            add_outline(level,
                        star(random, 4 + static_cast<int>(random.below(4)), Vec2(random.in_cube<2>() * 6.0), 2, 8));
        if (i % 2 == 0) snap(level);
        if (i % 3 == 0) {  // twice, and split at T-junctions that aren't corners of the other
            const Level<2> once = level;
            for (const auto& face : once.faces) level.faces.push_back(face);
        }
        expect_solid_everywhere(level, false, random, 100, count);
        if (HasFatalFailure()) return;
    }
    EXPECT_GT(count.inside, count.checked / 4);
    EXPECT_LT(count.inside, count.checked * 9 / 10);
}

TEST(SolidBsp2, SliversOfAMillionth) {
    oracle::Random random(63);
    Count count;
    for (int i = 0; i < 100; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 63 level " << i);
        Level<2> level;
        for (int k = 0; k < 6; ++k) {
            const DVec<2> a = random.in_cube<2>() * 3.0, along = random.direction<2>() * 2.0,
                          across = DVec<2>(-along.y, along.x) * 1e-6;
            add_outline(level, {Vec2(a), Vec2(a + along), Vec2(a + along + across), Vec2(a + across * 0.3)});
        }
        const SolidBsp<2> tree = level.tree();
        for (int k = 0; k < 200; ++k) {
            const std::size_t face = random.below(static_cast<std::uint32_t>(level.faces.size()));
            const DVec<2> a(level.corner(face, 0)), b(level.corner(face, 1));
            const Vec2 p(a + (b - a) * random.unit() + random.in_cube<2>() * 1e-6);
            expect_solid(level, tree, p, false, count);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(count.inside, count.checked / 20);
}

TEST(SolidBsp2, ByHand) {
    // A square with a notch at a T-junction: the right side is in two parts.
    Level<2> level{{{0, 0}, {4, 0}, {4, 1}, {4, 4}, {0, 4}}, {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 0}}};
    const SolidBsp2 block = level.tree();
    EXPECT_TRUE(block.contains({2, 2}));
    EXPECT_TRUE(block.contains({4, 4}));
    EXPECT_TRUE(block.contains({4, 2.5f}));
    EXPECT_FALSE(block.contains({std::nextafter(4.0f, 5.0f), 2.5f}));
    EXPECT_FALSE(block.contains({0, std::nextafter(0.0f, -1.0f)}));
    EXPECT_EQ(block.bounds(), (Aabb2{{0, 0}, {4, 4}}));
    EXPECT_EQ(bounds(block), block.bounds());
    EXPECT_EQ(block.node_count(), 4u) << "two faces in one plane";
    EXPECT_EQ(block.piece_count(), 5u);
    turn_around(level);
    const SolidBsp2 hollow = level.tree();
    EXPECT_FALSE(hollow.contains({2, 2}));
    EXPECT_TRUE(hollow.contains({4, 2.5f}));
    EXPECT_TRUE(hollow.contains({-1, 9}));
}

TEST(SolidBsp2, OpenGeometryIsSolidBehindItsFaces) {
    const Level<2> wall{{{0, 0}, {4, 0}}, {{0, 1}}};
    const SolidBsp2 tree = wall.tree();
    EXPECT_TRUE(tree.contains({2, 1}));
    EXPECT_TRUE(tree.contains({2, 0}));
    EXPECT_TRUE(tree.contains({9, 1}));
    EXPECT_FALSE(tree.contains({2, -1}));
}

TEST(SolidBsp2, ARegularOutlineOfManySidesIsNotAList) {
    oracle::Random random(64);
    Level<2> level;
    add_outline(level, star(random, 5000, Vec2(0), 1000, 1000));
    const SolidBsp2 tree = level.tree();
    EXPECT_LE(tree.depth(), 60u);
    EXPECT_LT(tree.node_count(), 3u * 5000);
    Count count;
    for (int i = 0; i < 500; ++i) {
        const Vec2 p(random.in_cube<2>() * 1000.0);
        expect_solid(level, tree, p, false, count);
    }
}

template <int D>
void expect_refused() {
    using Face = glm::vec<D, std::uint32_t>;
    std::vector<Vec<D>> points(D + 1, Vec<D>(0));
    for (int i = 0; i < D; ++i) points[static_cast<std::size_t>(i) + 1][i] = 1;
    Face good;
    for (int i = 0; i < D; ++i) good[i] = static_cast<std::uint32_t>(i);
    const auto problem = [&](const std::vector<Face>& faces) { return SolidBsp<D>::build(points, faces).problem(); };
    EXPECT_EQ(problem({}).code, ProblemCode::empty_input);
    Face bad = good;
    bad[D - 1] = D + 1;
    EXPECT_EQ(problem({good, bad}).code, ProblemCode::index_out_of_range);
    EXPECT_EQ(problem({good, bad}).index, 1u);
    for (const float x : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        points[1][0] = x;
        EXPECT_EQ(problem({good}).code, ProblemCode::not_finite);
        EXPECT_EQ(problem({good}).index, 1u);
    }
    points[1][0] = 1;
    // Faces without extent are dropped, and nothing is solid.
    const auto empty = SolidBsp<D>::build(points, std::vector<Face>{Face(1), Face(2)});
    ASSERT_TRUE(empty);
    EXPECT_EQ(empty->node_count(), 0u);
    EXPECT_FALSE(empty->contains(Vec<D>(0)));
    EXPECT_EQ(empty->bounds(), Aabb<D>::empty());
}

TEST(SolidBsp, RefusesWhatIsNoLevel) {
    expect_refused<2>();
    expect_refused<3>();
}

TEST(SolidBsp3, ContainsWhatSurfacesWindAround) {
    oracle::Random random(65);
    Count count;
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 65 level " << i);
        std::array<bool, 64> full{};
        for (bool& each : full) each = random.chance(0.5);
        const auto cells = [&](int x, int y, int z) { return full[static_cast<std::size_t>(16 * x + 4 * y + z)]; };
        expect_solid_everywhere(level_of(cell_surface(4, cells)), false, random, 400, count);
        if (HasFatalFailure()) return;
        expect_solid_everywhere(level_of(random_terrain(random, 6, 3).solid(-1)), false, random, 400, count);
        if (HasFatalFailure()) return;
    }
    std::cout << count.inside << " of " << count.checked << " inside\n";
    EXPECT_GT(count.inside, count.checked / 4);
    EXPECT_LT(count.inside, count.checked * 4 / 5);
}

Surface random_box(oracle::Random& random, bool whole) {
    Vec3 low(random.in_cube<3>() * 5.0), high = low + Vec3(DVec<3>(3.0) + random.in_cube<3>() * 2.5);
    if (whole) {
        low = glm::vec3(glm::vec<3, int>(low));
        high = low + glm::vec3(glm::vec<3, int>(high - low)) + Vec3(1);
    }
    return box_surface(low, high);
}

TEST(SolidBsp3, BoxesThatOverlapTouchAndRepeat) {
    oracle::Random random(66);
    Count count;
    for (int i = 0; i < 60; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 66 level " << i);
        Surface surface = random_box(random, i % 2 == 0);
        for (int k = 0; k < 5; ++k) surface = joined(surface, random_box(random, i % 2 == 0));
        if (i % 3 == 0) surface = joined(surface, surface);
        // Some are pillars in a room, where the solid is unbounded.
        const bool hollow = i % 5 == 0;
        if (hollow) surface = joined(surface, reversed(box_surface(Vec3(-9), Vec3(12))));
        expect_solid_everywhere(level_of(surface), hollow, random, 300, count);
        if (HasFatalFailure()) return;
    }
    std::cout << count.inside << " of " << count.checked << " inside\n";
    EXPECT_GT(count.inside, count.checked / 4);
    EXPECT_LT(count.inside, count.checked * 3 / 4);
}

TEST(SolidBsp3, SliversOfAMillionth) {
    oracle::Random random(67);
    Count count;
    for (int i = 0; i < 30; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 67 level " << i);
        Level<3> level;
        for (int k = 0; k < 4; ++k) {
            // A thin tetrahedron.
            const DVec<3> a = random.in_cube<3>() * 2.0, u = random.direction<3>(), v = random.direction<3>();
            const DVec<3> up = cross(u, v) * 2e-6;
            const auto first = static_cast<std::uint32_t>(level.points.size());
            for (const DVec<3>& p : {a, a + u, a + v, a + (u + v) * 0.3 + up}) level.points.emplace_back(p);
            for (const glm::uvec3& face : {glm::uvec3(0, 2, 1), {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
                level.faces.push_back(face + first);
        }
        const SolidBsp<3> tree = level.tree();
        for (int k = 0; k < 100; ++k) {
            const std::size_t face = random.below(static_cast<std::uint32_t>(level.faces.size()));
            const DVec<3> a(level.corner(face, 0)), b(level.corner(face, 1)), c(level.corner(face, 2));
            const double s = random.unit(), t = random.unit() * (1 - s);
            const Vec3 p(a + (b - a) * s + (c - a) * t + random.in_cube<3>() * 1e-6);
            expect_solid(level, tree, p, false, count);
            if (HasFatalFailure()) return;
        }
    }
    EXPECT_GT(count.inside, count.checked / 50);
}

/// Compares the pieces along rays from the eye, nearest first. Returns the number of rays with several pieces.
template <int D>
int expect_in_order(const SolidBsp<D>& tree, std::size_t faces, const Vec<D>& eye, oracle::Random& random) {
    struct Piece {
        std::uint32_t face;
        std::vector<Vec<D>> corners;
    };
    std::vector<Piece> pieces;
    std::vector<bool> seen(faces);
    tree.front_to_back(eye, [&](std::uint32_t face, std::span<const Vec<D>> corners) {
        pieces.push_back({face, {corners.begin(), corners.end()}});
        seen[face] = true;
    });
    EXPECT_EQ(pieces.size(), tree.piece_count());
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(faces));
    int several = 0;
    for (int repeat = 0; repeat < 100; ++repeat) {
        const DVec<D> direction = random.direction<D>(), origin(eye);
        double last = 0;
        int crossings = 0;
        for (const Piece& piece : pieces) {
            double along = -1;
            const auto corner = [&](std::size_t i) {
                return DVec<D>(piece.corners[i % piece.corners.size()]) - origin;
            };
            if constexpr (D == 2) {
                const DVec<2> side = corner(1) - corner(0);
                const double slope = cross(side, direction);
                if (std::abs(slope) < 1e-3 * length(side)) continue;
                const double part = cross(direction, corner(0)) / slope;
                if (part > 0.001 && part < 0.999) along = cross(side, corner(0)) / slope;
            } else {
                DVec<3> normal(0.0);
                for (std::size_t i = 1; i + 1 < piece.corners.size(); ++i)
                    normal += cross(corner(i) - corner(0), corner(i + 1) - corner(0));
                const double slope = dot(normal, direction);
                if (std::abs(slope) < 1e-3 * length(normal)) continue;
                const double t = dot(normal, corner(0)) / slope;
                bool inside = true;
                for (std::size_t i = 0; i < piece.corners.size(); ++i) {
                    const DVec<3> side = corner(i + 1) - corner(i);
                    inside = inside &&
                             dot(cross(side, direction * t - corner(i)), normal) > 1e-3 * length(side) * length(normal);
                }
                if (inside) along = t;
            }
            if (along <= 0) continue;
            EXPECT_GE(along, last * (1 - 1e-5) - 1e-5) << "face " << piece.face;
            last = along;
            ++crossings;
        }
        several += crossings > 1 ? 1 : 0;
    }
    return several;
}

TEST(SolidBsp, FrontToBackHidesNothing) {
    oracle::Random random(68);
    int several = 0;
    for (int i = 0; i < 20; ++i) {
        SCOPED_TRACE(testing::Message() << "seed 68 level " << i);
        Level<2> flat = random_block(random, 20);
        if (i % 2 == 0) snap(flat);
        std::erase_if(flat.faces, [&](const glm::uvec2& face) { return flat.points[face.x] == flat.points[face.y]; });
        several += expect_in_order(flat.tree(), flat.faces.size(), Vec2(random.in_cube<2>() * 25.0), random);
        several += expect_in_order(flat.tree(), flat.faces.size(), flat.points[3], random);
        Surface surface = random_box(random, i % 2 == 0);
        for (int k = 0; k < 5; ++k) surface = joined(surface, random_box(random, i % 2 == 0));
        const Level<3> level = level_of(surface);
        several += expect_in_order(level.tree(), level.faces.size(), Vec3(random.in_cube<3>() * 12.0), random);
    }
    EXPECT_GT(several, 1000);
}

TEST(SolidBsp, FrontToBackStopsAndTakesSimpleVisitors) {
    const Level<3> cube = level_of(box_surface({0, 0, 0}, {1, 1, 1}));
    int visits = 0;
    cube.tree().front_to_back(Vec3(5, 0.5f, 0.5f), [&](std::uint32_t) { ++visits; });
    EXPECT_EQ(visits, 12);
    cube.tree().front_to_back(Vec3(5, 0.5f, 0.5f), [&](std::uint32_t) { return --visits > 5; });
    EXPECT_EQ(visits, 5);
}

/// The sides of a box.
std::array<HalfSpace3, 6> box_sides(const Vec3& low, const Vec3& high) {
    return {HalfSpace3{{1, 0, 0}, high.x},  {{-1, 0, 0}, -low.x}, {{0, 1, 0}, high.y},
            HalfSpace3{{0, -1, 0}, -low.y}, {{0, 0, 1}, high.z},  {{0, 0, -1}, -low.z}};
}

TEST(SolidBspFromBrushes, IsTheUnionOfThem) {
    oracle::Random random(69);
    Count count;
    for (int i = 0; i < 40; ++i) {
        std::vector<HalfSpace3> sides;
        std::vector<std::uint32_t> ends;
        for (int k = 0; k < 6; ++k) {
            const Surface box = random_box(random, i % 2 == 0);
            for (const HalfSpace3& side : box_sides(box.points[0], box.points[7])) sides.push_back(side);
            // Corners cut off, and a repeated side.
            if (k % 2 == 0) sides.push_back({Vec3(random.direction<3>()), random.uniform_float(0, 5)});
            if (k % 3 == 0) sides.push_back(sides.back());
            ends.push_back(static_cast<std::uint32_t>(sides.size()));
        }
        const auto tree = SolidBsp3::from_brushes(sides, ends);
        ASSERT_TRUE(tree) << tree.problem().message;
        for (int k = 0; k < 500; ++k) {
            Vec3 p(random.in_cube<3>() * 6.0);
            if (k % 2 == 0) p = glm::vec3(glm::vec<3, int>(p));
            bool expected = false, unsure = false;
            std::uint32_t begin = 0;
            for (const std::uint32_t end : ends) {
                bool inside = true, sure = true;
                for (std::uint32_t s = begin; s < end; ++s) {
                    const double height =
                        dot(DVec<3>(sides[s].normal), DVec<3>(p)) - static_cast<double>(sides[s].offset);
                    inside = inside && height <= 0;
                    sure = sure && (std::abs(height) > 1e-9 || height == 0);
                }
                expected = expected || inside;
                unsure = unsure || !sure;
                begin = end;
            }
            // A flat brush has no volume, and is dropped.
            if (unsure) continue;
            EXPECT_EQ(tree->contains(p), expected) << "seed 69 level " << i << ": " << p.x << " " << p.y << " " << p.z;
            count.inside += expected ? 1 : 0;
            ++count.checked;
        }
        if (HasFailure()) return;
    }
    std::cout << count.inside << " of " << count.checked << " inside\n";
    EXPECT_GT(count.inside, count.checked / 10);
    EXPECT_LT(count.inside, count.checked * 4 / 5);
}

TEST(SolidBspFromBrushes, BrushesThatTouchLeaveNoGap) {
    std::vector<HalfSpace3> sides;
    std::vector<std::uint32_t> ends;
    for (int i = 0; i < 27; ++i) {
        const Vec3 low(static_cast<float>(i % 3), static_cast<float>(i / 3 % 3), static_cast<float>(i / 9));
        if (i == 13) continue;  // hollow
        for (const HalfSpace3& side : box_sides(low, low + Vec3(1))) sides.push_back(side);
        ends.push_back(static_cast<std::uint32_t>(sides.size()));
    }
    const auto tree = SolidBsp3::from_brushes(sides, ends);
    ASSERT_TRUE(tree);
    for (int i = 0; i < 13 * 13 * 13; ++i) {
        const Vec3 p =
            0.25f * Vec3(static_cast<float>(i % 13), static_cast<float>(i / 13 % 13), static_cast<float>(i / 169));
        const bool hollow = p.x > 1 && p.x < 2 && p.y > 1 && p.y < 2 && p.z > 1 && p.z < 2;
        ASSERT_EQ(tree->contains(p), !hollow) << p.x << " " << p.y << " " << p.z;
    }
    EXPECT_FALSE(tree->contains({3.25f, 1, 1}));
    SolidEntry<3> entry;
    ASSERT_TRUE(tree->enter({0.5f, 1.5f, 1.4f}, {1, 0, 0}, 9, entry)) << "through the hollow";
    EXPECT_EQ(entry.along, 1.5);
    EXPECT_TRUE(entry.started_inside);
    EXPECT_FALSE(tree->enter({0.5f, 0.5f, 0.4f}, {1, 0, 0}, 9, entry)) << "from brush to brush";
}

TEST(SolidBspFromBrushes, RefusesWhatIsNone) {
    const auto cube = box_sides(Vec3(0), Vec3(1));
    const std::vector<HalfSpace3> sides(cube.begin(), cube.end());
    const auto code = [](const std::vector<HalfSpace3>& from, const std::vector<std::uint32_t>& ends) {
        const auto tree = SolidBsp3::from_brushes(from, ends);
        return tree ? ProblemCode::cancelled : tree.problem().code;
    };
    EXPECT_EQ(code(sides, {6}), ProblemCode::cancelled) << "a cube is fine";
    EXPECT_EQ(code(sides, {}), ProblemCode::empty_input);
    EXPECT_EQ(code(sides, {7}), ProblemCode::index_out_of_range);
    EXPECT_EQ(code(sides, {6, 5}), ProblemCode::index_out_of_range);
    EXPECT_EQ(code(sides, {5}), ProblemCode::bad_argument) << "open above";
    auto bad = sides;
    bad[2].offset = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(code(bad, {6}), ProblemCode::not_finite);
    bad[2] = {Vec3(0), 1};
    EXPECT_EQ(code(bad, {6}), ProblemCode::degenerate);
    // No volume: nothing is solid.
    auto flat = sides;
    flat[0].offset = 0;
    EXPECT_FALSE(SolidBsp3::from_brushes(flat, std::vector<std::uint32_t>{6})->contains(Vec3(0, 0.5f, 0.5f)));
    flat[0].offset = -1;
    EXPECT_FALSE(SolidBsp3::from_brushes(flat, std::vector<std::uint32_t>{6})->contains(Vec3(-0.5f, 0.5f, 0.5f)));
}

}  // namespace
}  // namespace abut::test
