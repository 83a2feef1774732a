// Meshes as data: building, watertightness, and containment.

#include "meshes.hpp"
#include <abut/query/contains.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>

#include <algorithm>
#include <iostream>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

namespace abut::test {

using namespace detail;

namespace {

const Surface cube = box_surface({0, 0, 0}, {1, 1, 1});

/// A bend of three cells, as long as it is high.
bool bend(int x, int y, int z) {
    return z == 0 && (x == 0 || y == 0) && x < 2 && y < 2;
}
/// A square ring of one cell around one cell's hole.
bool ring(int x, int y, int z) {
    return z == 0 && x < 3 && y < 3 && !(x == 1 && y == 1);
}

TEST(MeshBuild, KeepsTheInput) {
    const Mesh mesh = cube.mesh();
    EXPECT_TRUE(std::equal(mesh.points().begin(), mesh.points().end(), cube.points.begin(), cube.points.end()));
    EXPECT_TRUE(
        std::equal(mesh.triangles().begin(), mesh.triangles().end(), cube.triangles.begin(), cube.triangles.end()));
    for (std::uint32_t i = 0; i < 12; ++i) {
        const Triangle3 t = mesh.triangle(i);
        EXPECT_EQ(t.a, cube.points[cube.triangles[i].x]);
        EXPECT_EQ(t.b, cube.points[cube.triangles[i].y]);
        EXPECT_EQ(t.c, cube.points[cube.triangles[i].z]);
    }
    EXPECT_EQ(bounds(mesh), (Aabb3{{0, 0, 0}, {1, 1, 1}}));
}

TEST(MeshBuild, NamesWhatIsWrong) {
    const auto problem = [](const Surface& surface) {
        const Result<Mesh> result = Mesh::build(surface.points, surface.triangles);
        EXPECT_FALSE(result);
        return result ? Problem{} : result.problem();
    };
    EXPECT_EQ(problem({}).code, ProblemCode::empty_input);
    EXPECT_EQ(problem({cube.points, {}}).code, ProblemCode::empty_input);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            Surface surface = cube;
            surface.points[5][axis] = bad;
            surface.points[7][axis] = bad;
            const Problem found = problem(surface);
            EXPECT_EQ(found.code, ProblemCode::not_finite);
            EXPECT_EQ(found.index, 5u);
            EXPECT_NE(found.message.find("point 5"), std::string::npos) << found.message;
        }
    for (int corner = 0; corner < 3; ++corner)
        for (const std::uint32_t bad : {8u, 0xffffffffu}) {
            Surface surface = cube;
            surface.triangles[3][corner] = bad;
            surface.triangles[9][corner] = bad;
            const Problem found = problem(surface);
            EXPECT_EQ(found.code, ProblemCode::index_out_of_range);
            EXPECT_EQ(found.index, 3u);
            EXPECT_NE(found.message.find("triangle 3"), std::string::npos) << found.message;
            EXPECT_NE(found.message.find(std::to_string(bad)), std::string::npos) << found.message;
        }
    EXPECT_EQ(problem({{}, {{0, 1, 2}}}).code, ProblemCode::index_out_of_range);
}

TEST(MeshBuild, TakesFlatDoubledAndCrossingTriangles) {
    const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}};
    const std::vector<glm::uvec3> triangles{{0, 0, 0}, {0, 1, 2}, {0, 1, 3}, {0, 1, 3}, {2, 3, 4}, {1, 1, 4}};
    const Result<Mesh> mesh = Mesh::build(points, triangles);
    ASSERT_TRUE(mesh);
    EXPECT_FALSE(mesh->closed());
    EXPECT_TRUE(contains(*mesh, {1.5f, 0, 0}));
    EXPECT_TRUE(contains(*mesh, {0.25f, 0.25f, 0}));
    EXPECT_FALSE(contains(*mesh, {0.25f, 0.25f, 0.25f}));
}

TEST(MeshBuild, CopiesShareAndOutlive) {
    std::optional<Mesh> original = cube.mesh();
    const Mesh copy = *original;
    EXPECT_EQ(copy.points().data(), original->points().data());
    original.reset();
    EXPECT_EQ(copy.triangles().size(), 12u);
    EXPECT_TRUE(contains(copy, {0.5f, 0.5f, 0.5f}));
    const auto placed = at(Mesh(copy), {{5, 0, 0}});
    EXPECT_TRUE(contains(placed, {5.5f, 0.5f, 0.5f}));
}

TEST(MeshParts, VisitsAtLeastWhatTheBoxOverlapsUntilStopped) {
    oracle::Random random(1);
    const Surface surface = random_soup(random, 500, 4, 1);
    const Mesh mesh = surface.mesh();
    int visits = 0;
    for (int i = 0; i < 100; ++i) {
        const Vec3 low = to_float(random.in_cube<3>() * 5.0);
        const Aabb3 box{low, low + Vec3(random.uniform_float(0, 2))};
        std::vector<std::uint32_t> visited;
        each_part(mesh, box, [&](const Triangle3& part, std::uint32_t index) {
            EXPECT_EQ(part.a, mesh.triangle(index).a);
            visited.push_back(index);
            return true;
        });
        std::sort(visited.begin(), visited.end());
        EXPECT_EQ(std::adjacent_find(visited.begin(), visited.end()), visited.end());
        for (std::uint32_t t = 0; t < 500; ++t)
            if (overlaps(bounds(convex(mesh.triangle(t))), box)) {
                EXPECT_TRUE(std::binary_search(visited.begin(), visited.end(), t));
            }
        visits += static_cast<int>(visited.size());
        std::size_t left = visited.size() / 2;
        if (left == 0) continue;
        each_part(mesh, box, [&](const Triangle3&, std::uint32_t) { return --left > 0; });
        EXPECT_EQ(left, 0u);
    }
    EXPECT_GT(visits, 500);
}

TEST(MeshClosed, TellsWhetherTrianglesBoundAVolume) {
    EXPECT_TRUE(cube.mesh().closed());
    EXPECT_TRUE(reversed(cube).mesh().closed());
    EXPECT_TRUE(cell_surface(3, ring).mesh().closed()) << "points of its own for each square";
    EXPECT_TRUE(joined(cube, box_surface({5, 5, 5}, {6, 6, 6})).mesh().closed());
    EXPECT_TRUE(joined(cube, cube).mesh().closed()) << "the same twice";
    // Two cubes that share an edge: it has four triangles, two in each direction.
    EXPECT_TRUE(joined(cube, box_surface({1, 1, 0}, {2, 2, 1})).mesh().closed());

    for (std::size_t i = 0; i < 12; ++i) {
        Surface open = cube;
        open.triangles.erase(open.triangles.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_FALSE(open.mesh().closed()) << "without triangle " << i;
        Surface turned = cube;
        std::swap(turned.triangles[i].x, turned.triangles[i].y);
        EXPECT_FALSE(turned.mesh().closed()) << "triangle " << i << " reversed";
    }
    EXPECT_FALSE(Surface({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}).mesh().closed());
    EXPECT_TRUE(Surface({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 1}}}).mesh().closed());
    // Closed except for a crack of one ulp.
    Surface cracked = cell_surface(3, ring);
    cracked.points[0].x = std::nextafter(cracked.points[0].x, -1.0f);
    EXPECT_FALSE(cracked.mesh().closed());
}

TEST(MeshClosed, ZerosOfBothSignsAndTrianglesWithoutExtentChangeNothing) {
    Surface surface = cell_surface(2, bend);
    for (std::size_t i = 0; i < surface.points.size(); i += 2)
        for (int axis = 0; axis < 3; ++axis)
            if (surface.points[i][axis] == 0) surface.points[i][axis] = -0.0f;
    surface.triangles.emplace_back(0, 0, 1);
    surface.triangles.emplace_back(2, 2, 2);
    EXPECT_TRUE(surface.mesh().closed());
    EXPECT_TRUE(contains(surface.mesh(), {0.5f, 0.5f, 0.5f}));
    EXPECT_FALSE(contains(surface.mesh(), {1.5f, 1.5f, 0.5f}));
}

/// Whether a point is in one of the full cells, their faces included.
bool in_cells(int size, const Cells& full, const Vec3& p) {
    for (int x = 0; x < size; ++x)
        for (int y = 0; y < size; ++y)
            for (int z = 0; z < size; ++z) {
                const Vec3 low(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                if (full(x, y, z) && contains(Aabb3{low, low + Vec3(1)}, p)) return true;
            }
    return false;
}

/// Tests points at every quarter of a cell: on corners, edges and faces, level with them, and between. All arithmetic
/// is exact.
void expect_cells(int size, const Cells& full) {
    const Surface surface = cell_surface(size, full);
    const Mesh mesh = surface.mesh(), inwards = reversed(surface).mesh();
    ASSERT_TRUE(mesh.closed());
    int inside = 0, wrong = 0;
    const int last = 4 * size + 2;
    for (int i = -2; i <= last; ++i)
        for (int j = -2; j <= last; ++j)
            for (int k = -2; k <= last; ++k) {
                const Vec3 point = 0.25f * Vec3(static_cast<float>(i), static_cast<float>(j), static_cast<float>(k));
                const bool expected = in_cells(size, full, point);
                inside += expected ? 1 : 0;
                if (contains(mesh, point) != expected || contains(inwards, point) != expected) {
                    ++wrong;
                    ADD_FAILURE() << point.x << " " << point.y << " " << point.z << " is inside: " << expected;
                }
                if (wrong > 5) return;
            }
    EXPECT_GT(inside, 100);
}

TEST(MeshContains, SolidsOfCellsExactly) {
    expect_cells(1, [](int, int, int) { return true; });
    expect_cells(2, bend);
    expect_cells(3, ring);
    expect_cells(3, [](int x, int y, int z) { return x != 1 || y != 1 || z != 1; });  // hollow
    expect_cells(3, [](int x, int y, int z) { return (x + y + z) % 2 == 0; });  // cells that share edges and corners
}

TEST(MeshContains, RandomCellsExactly) {
    oracle::Random random(2);
    for (int i = 0; i < 5; ++i) {
        std::array<bool, 27> full{};
        for (bool& each : full) each = random.chance(0.5);
        expect_cells(3, [&](int x, int y, int z) { return full[static_cast<std::size_t>(9 * x + 3 * y + z)]; });
    }
}

TEST(MeshContains, NestedBoxesByTheirWinding) {
    const Surface outer = box_surface({-2, -2, -2}, {2, 2, 2}), inner = box_surface({-1, -1, -1}, {1, 1, 1});
    const Vec3 middle(0.25f, 0.5f, 0.125f), between(1.5f, 0.25f, 0.5f), outside(3, 0.25f, 0.5f), on_inner(1, 0.25f, 0);
    const Mesh hollow = joined(outer, reversed(inner)).mesh(), twice = joined(outer, inner).mesh();
    for (const Mesh& mesh : {hollow, twice}) {
        EXPECT_TRUE(mesh.closed());
        EXPECT_TRUE(contains(mesh, between));
        EXPECT_TRUE(contains(mesh, on_inner));
        EXPECT_FALSE(contains(mesh, outside));
        EXPECT_FALSE(contains(mesh, -outside));
    }
    EXPECT_FALSE(contains(hollow, middle));
    EXPECT_TRUE(contains(twice, middle));
}

TEST(MeshContains, OpenMeshIsItsTrianglesAlone) {
    Surface open = cube;
    open.triangles.pop_back();
    const Mesh mesh = open.mesh();
    EXPECT_FALSE(contains(mesh, {0.5f, 0.5f, 0.5f}));
    EXPECT_TRUE(contains(mesh, {0.5f, 0.5f, 0}));
    EXPECT_TRUE(contains(mesh, {0, 0, 0}));
}

// The ray that counts crossings is parallel to x: here it hits slanted triangles in corners and along edges.
TEST(MeshContains, SlantedSurfaceAlsoLevelWithItsCorners) {
    oracle::Random random(3);
    const Terrain terrain = random_terrain(random, 12, 4);
    const Mesh mesh = terrain.solid(-1).mesh();
    ASSERT_TRUE(mesh.closed());
    int inside = 0, checked = 0;
    for (int i = 0; i < 4000; ++i) {
        Vec3 p{random.uniform_float(0, 12), random.uniform_float(0, 12), random.uniform_float(-1.5, 5)};
        const int x = static_cast<int>(random.below(12)), y = static_cast<int>(random.below(12));
        if (i % 4 != 0) p.y = static_cast<float>(y);  // along a line of the grid
        if (i % 4 == 2) p.z = terrain.height(x, y);   // through a corner
        if (i % 4 == 3) p.z = -1;                     // in the plane of the floor
        const double above =
            static_cast<double>(p.z) - terrain.height_at(static_cast<double>(p.x), static_cast<double>(p.y));
        if (std::abs(above) < 1e-4) continue;
        const bool expected = above < 0 && p.z >= -1;
        EXPECT_EQ(contains(mesh, p), expected) << p.x << " " << p.y << " " << p.z;
        inside += expected ? 1 : 0;
        ++checked;
    }
    std::cout << "inside " << inside << " of " << checked << "\n";
    EXPECT_GT(inside, checked / 4);
    EXPECT_LT(inside, checked * 3 / 4);
}

/// The faces of a hull as triangles.
Surface hull_surface(const Polyhedron& hull) {
    Surface result{{hull.points().begin(), hull.points().end()}, {}};
    const Facets& facets = hull.facets();
    std::uint32_t begin = 0;
    for (const std::uint32_t end : facets.loop_ends) {
        for (std::uint32_t i = begin + 1; i + 1 < end; ++i)
            result.triangles.emplace_back(facets.loops[begin], facets.loops[i], facets.loops[i + 1]);
        begin = end;
    }
    return result;
}

/// The height of a point above the highest of the planes; below zero inside.
double height_over(const Polyhedron& hull, const DVec<3>& point) {
    double highest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < hull.facets().normals.size(); ++i)
        highest = std::max(highest, dot(DVec<3>(hull.facets().normals[i]), point) - hull.offsets()[i]);
    return highest;
}

// Moved, rotated, scaled and mirrored, at sizes from 1e-3 to 1e4, against the planes of the hull.
TEST(MeshContains, PlacedHullsAgreeWithTheirPlanes) {
    oracle::Random random(4);
    int inside = 0, checked = 0;
    for (int i = 0; i < 60; ++i) {
        const double size = random.power_of_two(-10, 13);
        std::vector<Vec3> points;
        for (int j = 0; j < 20; ++j) points.push_back(to_float(random.in_cube<3>() * size));
        const Polyhedron hull = *Polyhedron::build(points);
        const Mesh mesh = hull_surface(hull).mesh();
        ASSERT_TRUE(mesh.closed());
        const Vec3 scale = random_scale(random);
        const Pose3 pose{to_float(random.in_cube<3>() * (3 * size)), random.rotation<3>()};
        const auto placed = at(stretched(mesh, scale), pose);
        const Affine<3> place = affine(pose) * scaling<3>(scale);
        for (int j = 0; j < 50; ++j) {
            const DVec<3> point = random.in_cube<3>() * size;
            const double height = height_over(hull, point);
            if (std::abs(height) < 1e-4 * size) continue;
            EXPECT_EQ(contains(placed, to_float(place.point(point))), height < 0)
                << "size " << size << " height " << height;
            inside += height < 0 ? 1 : 0;
            ++checked;
        }
    }
    EXPECT_GT(inside, checked / 4);
    EXPECT_LT(inside, checked * 3 / 4);
}

TEST(MeshContains, RoundedMeshReachesFarther) {
    const Mesh mesh = cell_surface(3, ring).mesh();
    const auto thick = rounded(mesh, 0.25f);
    EXPECT_TRUE(contains(thick, {0.5f, 0.5f, 0.5f}));
    EXPECT_TRUE(contains(thick, {1.25f, 1.5f, 0.5f})) << "in the hole, on the rounding";
    EXPECT_FALSE(contains(thick, {1.375f, 1.5f, 0.5f}));
    EXPECT_TRUE(contains(thick, {-0.25f, 0.5f, 0.5f}));
    EXPECT_FALSE(contains(thick, {-0.2f, -0.2f, 0.5f})) << "round at the corners";
}

TEST(MeshContains, FlattenedMeshHasNoInside) {
    const Mesh mesh = cube.mesh();
    const auto flat = stretched(mesh, {1, 0, 1});
    EXPECT_TRUE(contains(flat, {0.5f, 0, 0.5f}));
    EXPECT_FALSE(contains(flat, {0.5f, 0.5f, 0.5f}));
}

}  // namespace
}  // namespace abut::test
