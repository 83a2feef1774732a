// The hull engines: exact arithmetic, hulls by brute force over all planes, and the invariants of every hull.
#include "point_sets.hpp"
#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/hull_input.hpp>
#include <abut/convex/hull/quickhull.hpp>
#include <abut/math/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <tuple>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

std::vector<std::vector<std::uint32_t>> loops_of(const Hull3& hull) {
    std::vector<std::vector<std::uint32_t>> result;
    std::size_t begin = 0;
    for (const std::uint32_t end : hull.loop_ends) {
        result.emplace_back(hull.loops.begin() + static_cast<std::ptrdiff_t>(begin), hull.loops.begin() + end);
        begin = end;
    }
    return result;
}

std::tuple<float, float, float> key(const Vec3& p) {
    return {p.x, p.y, p.z};
}

template <class T>
void shuffle(std::vector<T>& items, Random& random) {
    for (std::size_t i = items.size(); i > 1; --i)
        std::swap(items[i - 1], items[random.below(static_cast<std::uint32_t>(i))]);
}

void expect_one_closed_surface(const Hull3& hull) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    std::set<std::uint32_t> used;
    for (const auto& loop : loops_of(hull)) {
        ASSERT_GE(loop.size(), 3u);
        EXPECT_EQ(*std::min_element(loop.begin(), loop.end()), loop[0]);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            ASSERT_LT(loop[i], hull.points.size());
            used.insert(loop[i]);
            EXPECT_TRUE(edges.emplace(loop[i], loop[(i + 1) % loop.size()]).second) << "an edge twice in one direction";
        }
    }
    for (const auto& [from, to] : edges) EXPECT_TRUE(edges.contains({to, from})) << "an edge of one face alone";
    EXPECT_EQ(used.size(), hull.points.size());
    EXPECT_EQ(hull.points.size() + hull.loop_ends.size(), edges.size() / 2 + 2) << "Euler";
    EXPECT_EQ(hull.normals.size(), hull.loop_ends.size());
    EXPECT_EQ(hull.offsets.size(), hull.loop_ends.size());
}

void expect_faces_hold_all(const Hull3& hull, const std::vector<Vec3>& points, double extent) {
    const double tolerance = 1e-6 * extent;
    const auto loops = loops_of(hull);
    for (std::size_t face = 0; face < loops.size(); ++face) {
        const DVec<3> normal(hull.normals[face]);
        EXPECT_NEAR(length(normal), 1, 1e-6);
        for (const Vec3& point : points) ASSERT_LE(dot(normal, DVec<3>(point)), hull.offsets[face]);
        const DVec<3> origin(hull.points[loops[face][0]]);
        DVec<3> area(0.0);
        for (std::size_t i = 0; i < loops[face].size(); ++i) {
            const DVec<3> a(hull.points[loops[face][i]]), b(hull.points[loops[face][(i + 1) % loops[face].size()]]);
            EXPECT_GE(dot(normal, a), hull.offsets[face] - 1.3 * tolerance) << "a corner off its face";
            const DVec<3> c(hull.points[loops[face][(i + 2) % loops[face].size()]]);
            EXPECT_GE(dot(cross(b - a, c - b), normal), -0.2 * tolerance * length(c - a)) << "not convex";
            area += cross(a - origin, b - origin);
        }
        // Slivers as narrow as the rounding of floats are exempt.
        if (length(area) > 1e-4 * extent * extent) {
            EXPECT_GT(dot(area, normal), 0.999 * length(area)) << "clockwise";
        }
    }
}

double volume_below_faces(const Hull3& hull) {
    double six_times = 0;
    const DVec<3> origin(hull.points[0]);
    for (const auto& loop : loops_of(hull))
        for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
            const DVec<3> a(hull.points[loop[0]]), b(hull.points[loop[i]]), c(hull.points[loop[i + 1]]);
            six_times += dot(cross(b - a, c - a), a - origin);
        }
    return six_times / 6;
}

void expect_laws(const Hull3& hull, const std::vector<Vec3>& points, Random& random) {
    const double extent = abut::detail::extent<3>(points);
    std::set<std::tuple<float, float, float>> given;
    for (const Vec3& point : points) given.insert(key(point));
    for (const Vec3& point : hull.points) EXPECT_TRUE(given.contains(key(point))) << "a corner from nowhere";
    EXPECT_TRUE(std::is_sorted(hull.points.begin(), hull.points.end(),
                               [](const Vec3& a, const Vec3& b) { return key(a) < key(b); }));

    // The support of the hull equals that of the points, in every direction.
    for (int i = 0; i < 50; ++i) {
        const DVec<3> direction = random.direction<3>();
        const auto reach = [&](const std::vector<Vec3>& set) {
            double most = dot(direction, DVec<3>(set[0]));
            for (const Vec3& point : set) most = std::max(most, dot(direction, DVec<3>(point)));
            return most;
        };
        EXPECT_NEAR(reach(hull.points), reach(points), 1.5e-7 * extent);
    }
    if (hull.rank < 2) {
        EXPECT_EQ(hull.points.size(), static_cast<std::size_t>(hull.rank) + 1);
        EXPECT_TRUE(hull.loops.empty());
        return;
    }
    expect_one_closed_surface(hull);
    expect_faces_hold_all(hull, points, extent);
    EXPECT_NEAR(hull.volume, volume_below_faces(hull), 1e-6 * extent * hull.area);
    const double rounding = 2e-7 * largest(DVec<3>(hull.centroid)) + 2e-45;
    for (std::size_t face = 0; face < hull.normals.size(); ++face)
        EXPECT_LE(dot(DVec<3>(hull.normals[face]), DVec<3>(hull.centroid)),
                  hull.offsets[face] + 1e-6 * extent + rounding);
}

TEST(GridDot, IsExactWhereDoubleIsNot) {
    constexpr std::int64_t most = std::int64_t{1} << grid_bits;
    Random random(71);
    const auto coordinate = [&] { return static_cast<std::int64_t>(random.below(2 * most + 1)) - most; };
    const auto point = [&] { return GridPoint{coordinate(), coordinate(), coordinate()} / std::int64_t{2}; };
    int wrong_in_double = 0;
    for (int i = 0; i < 20000; ++i) {
        const GridPoint a = point(), b = point(), c = point();
        const GridPoint normal = grid_normal(a, b, c);
        // Next to the plane: the corner of a parallelogram, moved by one ulp.
        const GridPoint step(static_cast<std::int64_t>(random.below(3)) - 1, 0, 0);
        const GridPoint in_plane = (b - a) - (c - a);
        EXPECT_EQ(grid_dot(normal, in_plane), 0);
        const double expected = static_cast<double>(normal.x) * static_cast<double>(step.x);
        EXPECT_EQ(grid_dot(normal, in_plane + step), expected);
        wrong_in_double += dot(DVec<3>(normal), DVec<3>(in_plane)) != 0 ? 1 : 0;
    }
    EXPECT_GT(wrong_in_double, 5000);
    EXPECT_EQ(grid_dot({-most * most * 2, 0, 0}, {most, 0, 0}), -0x1p85);
    EXPECT_EQ(grid_dot({most * most * 2, most * most * 2, 1}, {most, -most, -1}), -1);
}

TEST(HullLoop, LeavesOutWhatLiesOnAnEdge) {
    std::vector<Vec2> points;
    for (int x = 0; x <= 6; ++x)
        for (int y = 0; y <= 4; ++y) points.emplace_back(static_cast<float>(x), static_cast<float>(y));
    const std::vector<std::uint32_t> loop = hull_loop(points);
    std::vector<Vec2> corners;
    for (const std::uint32_t i : loop) corners.push_back(points[i]);
    EXPECT_EQ(corners, (std::vector<Vec2>{{0, 0}, {6, 0}, {6, 4}, {0, 4}}));
}

TEST(HullLoop, KeepsAllThatIsExtremeAndNoMore) {
    Random random(72);
    int corners = 0, left_out = 0;
    for (int round = 0; round < 500; ++round) {
        SCOPED_TRACE("seed 72, round " + std::to_string(round));
        std::vector<Vec2> points;
        for (std::uint32_t i = 0, count = 1 + random.below(12); i < count; ++i)
            points.push_back({static_cast<float>(random.below(6)), static_cast<float>(random.below(6))});
        std::set<std::pair<float, float>> found;
        for (const std::uint32_t i : hull_loop(points)) EXPECT_TRUE(found.emplace(points[i].x, points[i].y).second);

        // A point is no vertex if it lies between two others or in a triangle of three others.
        const auto turn = [](const Vec2& a, const Vec2& b, const Vec2& c) {
            return cross(DVec<2>(b) - DVec<2>(a), DVec<2>(c) - DVec<2>(a));
        };
        for (const Vec2& p : points) {
            bool inside = false;
            for (const Vec2& a : points)
                for (const Vec2& b : points) {
                    if (a == p || b == p) continue;
                    inside =
                        inside || (turn(a, b, p) == 0 && dot(DVec<2>(a) - DVec<2>(p), DVec<2>(b) - DVec<2>(p)) < 0);
                    for (const Vec2& c : points)
                        inside = inside || (c != p && turn(a, b, p) > 0 && turn(b, c, p) > 0 && turn(c, a, p) > 0);
                }
            EXPECT_EQ(found.contains({p.x, p.y}), !inside) << p.x << ' ' << p.y;
            corners += inside ? 0 : 1;
            left_out += inside ? 1 : 0;
        }
    }
    EXPECT_GT(corners, 500);
    EXPECT_GT(left_out, 500);
}

// Nearly collinear points with exponents so far apart that doubles don't decide the orientation.
TEST(HullLoop, IsConvexExactlyWhateverTheExponents) {
    int corners = 0, wrong_in_double = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Random random(seed);
        const DVec<2> along = random.direction<2>();
        const int least = random.chance(0.5) ? -140 : -60, most = random.chance(0.5) ? 127 : 0;
        std::vector<Vec2> points{to_float(along), to_float(-along)};
        for (int i = 0; i < 12; ++i) {
            const DVec<2> on_line = along * random.power_of_two(least, most) * (random.chance(0.5) ? 1.0 : -1.0);
            points.push_back(to_float(on_line));
            points.push_back(to_float(on_line + random.in_cube<2>() * random.power_of_two(least, most)));
        }
        const std::vector<std::uint32_t> loop = hull_loop(points);
        ASSERT_GE(loop.size(), 2u);
        if (loop.size() == 2) continue;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vec2 &a = points[loop[i]], &b = points[loop[(i + 1) % loop.size()]];
            const Vec2& c = points[loop[(i + 2) % loop.size()]];
            ASSERT_EQ(orientation(a, b, c), 1);
            for (const Vec2& point : points) {
                const int side = orientation(a, b, point);
                ASSERT_GE(side, 0) << "a point outside";
                const double turn = cross(DVec<2>(b) - DVec<2>(a), DVec<2>(point) - DVec<2>(a));
                wrong_in_double += (turn > 0) != (side > 0) ? 1 : 0;
            }
            ++corners;
        }
    }
    EXPECT_GT(corners, 5000);
    EXPECT_GT(wrong_in_double, 50);
}

// On a lattice every plane through three points is exact in double, so that brute force finds the faces.
TEST(Hull, HasTheFacesFoundByTryingEveryPlane) {
    Random random(73);
    int solid = 0, faces_of_many_corners = 0;
    for (int round = 0; round < 300; ++round) {
        SCOPED_TRACE("seed 73, round " + std::to_string(round));
        const int count = 4 + static_cast<int>(random.below(12));
        const std::vector<Vec3> points = on_a_lattice(random, count);
        const Hull3 hull = *abut::detail::hull(points);
        if (hull.rank < 3) continue;
        ++solid;

        struct Face {
            DVec<3> normal;
            std::set<std::tuple<float, float, float>> points;
        };
        std::vector<Face> expected;
        const auto face_across = [&](const DVec<3>& normal) {
            return std::find_if(expected.begin(), expected.end(),
                                [&](const Face& face) { return length(face.normal - normal) < 1e-5; });
        };
        for (const Vec3& a : points)
            for (const Vec3& b : points)
                for (const Vec3& c : points) {
                    const DVec<3> normal = cross(DVec<3>(b) - DVec<3>(a), DVec<3>(c) - DVec<3>(a));
                    const auto above = [&](const Vec3& p) { return dot(normal, DVec<3>(p) - DVec<3>(a)); };
                    if (normal == DVec<3>(0.0) || face_across(normalized(normal)) != expected.end() ||
                        std::any_of(points.begin(), points.end(), [&](const Vec3& p) { return above(p) > 0; }))
                        continue;
                    Face& face = expected.emplace_back(Face{normalized(normal), {}});
                    for (const Vec3& p : points)
                        if (above(p) == 0) face.points.insert(key(p));
                }
        const auto loops = loops_of(hull);
        ASSERT_EQ(loops.size(), expected.size());
        for (std::size_t i = 0; i < loops.size(); ++i) {
            const auto found = face_across(DVec<3>(hull.normals[i]));
            ASSERT_TRUE(found != expected.end());
            for (const Vec3& p : points)
                EXPECT_LE(orientation(hull.points[loops[i][0]], hull.points[loops[i][1]], hull.points[loops[i][2]], p),
                          0);
            for (const std::uint32_t point : loops[i]) EXPECT_TRUE(found->points.contains(key(hull.points[point])));
            // Strictly convex, and no point of the plane is outside of it: these are the face's corners.
            for (std::size_t j = 0; j < loops[i].size(); ++j) {
                const DVec<3> a(hull.points[loops[i][j]]), b(hull.points[loops[i][(j + 1) % loops[i].size()]]);
                const DVec<3> next(hull.points[loops[i][(j + 2) % loops[i].size()]]), normal(hull.normals[i]);
                EXPECT_GT(dot(cross(b - a, next - b), normal), 0.1);
                for (const auto& [x, y, z] : found->points)
                    EXPECT_GT(dot(cross(b - a, DVec<3>(x, y, z) - a), normal), -1e-6);
            }
            faces_of_many_corners += loops[i].size() > 3 ? 1 : 0;
        }
    }
    EXPECT_GT(solid, 200);
    EXPECT_GT(faces_of_many_corners, 200);
}

TEST(Hull, KeepsItsLawsAtEveryScale) {
    std::map<int, int> ranks;
    for (std::size_t kind = 0; kind < kinds.size(); ++kind)
        for (const double scale : {1e-44, 1e-38, 1e-6, 1e-3, 1.0, 1e4, 1e6, 1e34, 1.2e38})
            for (const double away : {0.0, 3.0, 1e4})
                for (std::uint64_t round = 0; round < 4; ++round) {
                    const std::uint64_t seed = 1000 * kind + round;
                    if (away > 0 && scale * away > 1e38) continue;
                    SCOPED_TRACE(kinds[kind].name + ", scale " + std::to_string(scale) + ", away " +
                                 std::to_string(away) + ", seed " + std::to_string(seed));
                    Random random(seed);
                    std::vector<Vec3> points = kinds[kind].make(random);
                    const DVec<3> offset = random.direction<3>() * away;
                    for (Vec3& point : points) point = to_float((DVec<3>(point) + offset) * scale);
                    const auto hull = abut::detail::hull(points);
                    ASSERT_TRUE(hull);
                    expect_laws(*hull, points, random);
                    ++ranks[hull->rank];
                }
    EXPECT_GT(ranks[1], 3);
    EXPECT_GT(ranks[2], 10);
    EXPECT_GT(ranks[3], 500);
}

TEST(Hull, DoesNotDependOnTheOrderOfThePoints) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        std::vector<Vec3> points = kinds[kind].make(random);
        points.insert(points.end(), {Vec3(0.0f), Vec3(-0.0f)});
        const Hull3 first = *abut::detail::hull(points);
        for (int round = 0; round < 5; ++round) {
            shuffle(points, random);
            points.push_back(points[random.below(static_cast<std::uint32_t>(points.size()))]);
            const Hull3 again = *abut::detail::hull(points);
            EXPECT_EQ(first.points, again.points);
            EXPECT_EQ(first.normals, again.normals);
            EXPECT_EQ(first.offsets, again.offsets);
            EXPECT_EQ(first.loops, again.loops);
            EXPECT_EQ(first.volume, again.volume);
        }
    }
}

TEST(Hull, OfAHullIsTheSame) {
    for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
        if (kinds[kind].name == "near copies") continue;  // points that differ by about the tolerance
        SCOPED_TRACE(kinds[kind].name + ", seed " + std::to_string(kind));
        Random random(kind);
        const Hull3 once = *abut::detail::hull(kinds[kind].make(random));
        const Hull3 twice = *abut::detail::hull(once.points);
        EXPECT_EQ(once.points, twice.points);
        EXPECT_EQ(once.rank, twice.rank);
    }
}

// Rounding moves the points of a rotated box or cylinder off its faces by about 1e-7 of its size.
TEST(Hull, HasTheFacesThatWereMeantWhereRoundingBentThem) {
    Random random(74);
    int grids_of_six_faces = 0;
    for (int round = 0; round < 50; ++round) {
        SCOPED_TRACE("seed 74, round " + std::to_string(round));
        const Hull3 box = *abut::detail::hull(turned(box_surface(1), random));
        EXPECT_EQ(box.loop_ends.size(), 6u);
        EXPECT_EQ(box.points.size(), 8u);
        const int sides = 3 + static_cast<int>(random.below(62));
        const Hull3 cylinder = *abut::detail::hull(turned(rings(sides), random));
        EXPECT_EQ(cylinder.loop_ends.size(), static_cast<std::size_t>(sides + 2));
        EXPECT_EQ(cylinder.points.size(), static_cast<std::size_t>(2 * sides));
        // Points within a face may stick out by more than the tolerance; then it sometimes becomes two faces.
        grids_of_six_faces += abut::detail::hull(turned(box_surface(5), random))->loop_ends.size() == 6 ? 1 : 0;
    }
    EXPECT_GE(grids_of_six_faces, 46);
}

// Corners that differ only in the sign of a zero are one corner, whichever comes first.
TEST(Hull, HasNoNegativeZeros) {
    const Hull3 hull =
        *abut::detail::hull(std::vector<Vec3>{{1, -0.0f, -0.0f}, {-0.0f, 1, 0}, {-0.0f, 0, 1}, Vec3(-0.0f)});
    for (const Vec3& point : hull.points)
        for (int i = 0; i < 3; ++i) EXPECT_FALSE(std::signbit(point[i]));
    const Hull2 flat = *abut::detail::hull(std::vector<Vec2>{{1, -0.0f}, {-0.0f, 1}, Vec2(-0.0f)});
    for (const Vec2& point : flat.points)
        for (int i = 0; i < 2; ++i) EXPECT_FALSE(std::signbit(point[i]));
}

// All corners lie in a slab as thin as merged faces may be; still there are an upper and a lower side and four between
// them.
TEST(Hull, OfAThinPlateKeepsItsRim) {
    std::vector<Vec3> points = stretched(box_surface(1), {1, 1, 4e-7f});
    const Hull3 hull = *abut::detail::hull(points);
    EXPECT_EQ(hull.rank, 3);
    EXPECT_EQ(hull.loop_ends.size(), 6u);
}

TEST(Hull, OfTenThousandPointsHasThemAll) {
    Random random(75);
    const std::vector<Vec3> points = on_a_sphere(random, 10000);
    const Hull3 hull = *abut::detail::hull(points);
    EXPECT_GT(hull.points.size(), 9990u);
    expect_one_closed_surface(hull);
    EXPECT_NEAR(hull.volume, 4.18879, 0.005);
    EXPECT_NEAR(hull.area, 12.56637, 0.01);
}

}  // namespace
}  // namespace abut::test
