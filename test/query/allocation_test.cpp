// No query allocates memory.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/kit.hpp"
#include "../oracle/check.hpp"
#include "../oracle/pair.hpp"
#include "user_functions.hpp"
#include <abut/bake/field.hpp>
#include <abut/convex/features.hpp>
#include <abut/query/certify.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/contains.hpp>
#include <abut/query/intersection.hpp>
#include <abut/query/raycast.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/chain.hpp>
#include <abut/shape/compound.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/height_field.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_mesh.hpp>
#include <abut/shape/tile_map.hpp>
#include <abut/shape/voxel_map.hpp>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> allocations = 0;

void* counted(std::size_t bytes) {
    ++allocations;
    if (void* memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
}
}  // namespace

void* operator new(std::size_t bytes) {
    return counted(bytes);
}
void* operator new[](std::size_t bytes) {
    return counted(bytes);
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    ++allocations;
    return std::malloc(bytes > 0 ? bytes : 1);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace abut {

using namespace detail;

namespace {

template <int D>
long allocations_of_all_queries(const View<D>& a, const View<D>& b, const Ray<D>& ray) {
    const long before = allocations;
    Cache cache;
    overlaps(a, b);
    overlaps(a, b, {.cache = &cache});
    closest(a, b, {.cache = &cache});
    certify(a, b, closest(a, b));
    contact(a, b);
    contact(a, b, {.margin = 1});
    contains(a, ray.origin);
    closest(a, ray.origin);
    raycast(ray, a);
    sweep(a, ray.direction, b);
    sweep(b, ray.direction * ray.length, a, ray.direction);
    Motion<D> rotating{{ray.origin, no_rotation<D>}, -ray.origin};
    rotating.turn = Angle<D>(3);
    sweep(a, rotating, b, Motion<D>{}, {.cache = &cache});
    sweep(b, Pose<D>{}, pose_at(rotating, 1), a, Pose<D>{}, rotating.from);
    each_hit(ray, a, [](const Hit<D>&) {});
    if (const auto* convex = std::get_if<Convex<D>>(&a); convex != nullptr && has_features(*convex))
        closest_feature(*convex, DVec<D>(ray.origin));
    return allocations - before;
}

TEST(Allocation, IsCounted) {
    const long before = allocations;
    const std::vector<int> numbers(100);
    EXPECT_EQ(allocations - before, 1) << numbers.size();
}

template <int D>
void expect_none() {
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        SCOPED_TRACE(seed);
        oracle::Random random(seed);
        const auto pair = oracle::random_pair<D>(random, static_cast<oracle::Kind>(random.below(oracle::kind_count)),
                                                 static_cast<oracle::Kind>(random.below(oracle::kind_count)));
        const auto ray = Ray<D>::between(to_float(random.direction<D>()), to_float(oracle::middle(pair.a.solid)));
        EXPECT_EQ(allocations_of_all_queries<D>(pair.a.view, pair.b.view, ray), 0);
        EXPECT_EQ(allocations_of_all_queries<D>(pair.a.view, view(HalfSpace<D>{ray.direction, ray.length}), ray), 0);
    }
}

TEST(Allocation, OfQueriesIn2DIsNone) {
    expect_none<2>();
}
TEST(Allocation, OfQueriesIn3DIsNone) {
    expect_none<3>();
}

TEST(Allocation, OfMeshAndRoundShapeQueriesIsNone) {
    oracle::Random random(5);
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 0; i < 300; ++i) {
        points.push_back(to_float(random.in_cube<3>()));
        triangles.push_back({i, random.below(300), random.below(300)});
    }
    const Mesh mesh = *Mesh::build(points, triangles);
    const Ray3 ray = Ray3::between({-3, -2, -1}, {2, 2, 2});
    const Cylinder cylinder{{0, 0, 0}, {1, 1, 0}, 0.5f};
    const Cone cone{{0.5f, 0, 0}, {1, 1, 1}, 0.5f};
    EXPECT_EQ(allocations_of_all_queries<3>(view(mesh), view(cylinder), ray), 0);
    EXPECT_EQ(allocations_of_all_queries<3>(view(cone), view(cylinder), ray), 0);
    EXPECT_EQ(allocations_of_all_queries<3>(view(mesh), view(at(mesh, Pose3{{0.5f, 0, 0}})), ray), 0);
}

TEST(Allocation, OfSolidQueriesIsNone) {
    oracle::Random random(7);
    const scenes::BumpyBall surface = scenes::bumpy_ball(12, 0.3, 0.01, random);
    const Mesh ball = *Mesh::build(surface.points, surface.triangles);
    const std::vector<scenes::KitPiece> pieces = scenes::kit();
    const Mesh t = *Mesh::build(pieces[0].points, pieces[0].triangles);
    const Ray3 ray = Ray3::between({-3, -2, -1}, {2, 2, 2});
    for (const float x : {0.5f, 1.5f, 3.0f, 4.0f}) {
        const Pose3 pose{{x, 0, 0}};
        for (const View<3>& other : {View<3>(view(at(solid(ball), pose))), View<3>(view(at(solid(t), pose))),
                                     View<3>(view(Box3{{x, 0, 0}, {1, 1, 1}})), View<3>(view(Sphere{{x, 0, 0}, 1}))}) {
            EXPECT_EQ(allocations_of_all_queries<3>(view(solid(ball)), other, ray), 0);
            EXPECT_EQ(allocations_of_all_queries<3>(view(solid(t)), other, ray), 0);
        }
    }
}

TEST(Allocation, OfLevelQueriesIsNone) {
    oracle::Random random(6);
    std::vector<Vec2> corners;
    std::vector<Tile> tiles;
    std::vector<float> heights;
    for (std::uint32_t i = 0; i < 100; ++i) {
        corners.push_back(to_float(random.in_cube<2>() * 3.0));
        tiles.push_back(static_cast<Tile>(random.below(14)));
        heights.push_back(random.uniform_float(-1, 1));
    }
    const Chain chain = *Chain::build(corners, true);
    const TileMap map = *TileMap::build(tiles, 10, 0.3f);
    const Compound2 both = *Compound2::build({chain, at(map, Pose2{{1, 1}}), Circle{{0, 0}, 1}});
    const HeightField field = *HeightField::build(heights, 10, 0.4f);
    const Compound3 ground = *Compound3::build({field, at(field, Pose3{{0, 0, 1}}), Sphere{{0, 0, 0}, 1}});
    std::vector<std::uint64_t> bits(8 * 8 * 8 / 64);
    for (std::uint64_t& word : bits) word = random.bits();
    const VoxelMap voxels = *VoxelMap::build(bits, {8, 8, 8}, 0.3f);
    const Ray2 ray = Ray2::between({-3, -2}, {4, 3});
    for (const View<2>& level : {View<2>(view(chain)), View<2>(view(map)), View<2>(view(both))})
        for (const View<2>& other : {View<2>(view(Box2{{2, 2}, {1, 1}})), View<2>(view(HalfSpace2{{0, 1}, 0.5f}))})
            EXPECT_EQ(allocations_of_all_queries<2>(level, other, ray), 0);
    EXPECT_EQ(allocations_of_all_queries<2>(view(chain), view(map), ray), 0);
    const Ray3 in_space = Ray3::between({-3, -2, -1}, {5, 5, 1});
    for (const View<3>& level : {View<3>(view(field)), View<3>(view(voxels)), View<3>(view(ground))})
        EXPECT_EQ(allocations_of_all_queries<3>(level, view(Box3{{2, 2, 0}, {1, 1, 1}}), in_space), 0);
}

TEST(Allocation, OfDistanceFunctionQueriesIsNone) {
    const users::Brick<3> brick;
    const Field<3> field = *bake_field(Box3{{0.5f, 0, 0}, {1, 0.5f, 0.75f}}, FieldOptions<3>{.cell = 0.25f});
    const std::vector<Vec3> corners{{-1, 0, -1}, {1, 0, -1}, {0, 0, 1}};
    const Mesh mesh = *Mesh::build(corners, std::vector<glm::uvec3>{{0, 1, 2}});
    const Cylinder cylinder{{0, 0, 0}, {1, 1, 0}, 0.5f};
    const Polyhedron hull = *Polyhedron::build({{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
    const Ray3 ray = Ray3::between({-3, -2, -1}, {5, 5, 1});
    for (const View<3>& function : {View<3>(view(brick)), View<3>(view(field))}) {
        for (const View<3>& other :
             {View<3>(view(cylinder)), View<3>(view(hull)), View<3>(view(mesh)), View<3>(view(brick)),
              View<3>(view(Box3{{2, 2, 0}, {1, 1, 1}})), View<3>(view(HalfSpace3{{0, 1, 0}, 0.5f}))})
            EXPECT_EQ(allocations_of_all_queries<3>(function, other, ray), 0);
    }
}

template <class A, class B>
long allocations_of_basic_queries(const A& a, const B& b) {
    constexpr int D = dimension<A>;
    const Ray<D> ray = Ray<D>::between(Vec<D>(-5), Vec<D>(5));
    const long before = allocations;
    Cache cache;
    overlaps(a, b);
    closest(a, b);
    closest(a, b, {.cache = &cache});
    contact(a, b);
    contact(a, b, {.cache = &cache, .margin = 1});
    raycast(ray, a);
    sweep(a, ray.direction, b);
    sweep(b, ray.direction * ray.length, a, ray.direction);
    closest(a, Vec<D>(3));
    return allocations - before;
}

TEST(Allocation, OfPlainShapeQueriesIsNone) {
    const Polygon polygon = *Polygon::build({{-1, -1}, {1, -1}, {1.5f, 0.5f}, {0, 1}});
    const Polyhedron hull = *Polyhedron::build({{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}});
    for (const float along : {0.0f, 1.2f, 4.0f}) {
        const auto placed = at(polygon, Pose2{{along, 0.1f}, Turn::by(along)});
        EXPECT_EQ(allocations_of_basic_queries(placed, polygon), 0);
        EXPECT_EQ(allocations_of_basic_queries(placed, Circle{{0, 0}, 1}), 0);
        EXPECT_EQ(allocations_of_basic_queries(placed, Box2{{0, 0}, {1, 2}}), 0);
        const Box3 box{{along, 0.1f, 0.2f}, {1, 2, 1}, turn_about({0, 0, 1}, along)};
        EXPECT_EQ(allocations_of_basic_queries(box, Box3{{0, 0, 0}, {1, 1, 1}}), 0);
        EXPECT_EQ(allocations_of_basic_queries(box, Sphere{{0, 0, 0}, 1}), 0);
        EXPECT_EQ(allocations_of_basic_queries(Capsule3{{along, 0, 0}, {2, 1, 1}, 0.5f}, box), 0);
        EXPECT_EQ(allocations_of_basic_queries(at(hull, Pose3{{along, 0, 0}}), box), 0);
    }
}

TEST(Allocation, OfOverlapsOfPolygonsIsNoneWhereThereIsRoom) {
    const Polygon a = *Polygon::build({{-1, -1}, {1, -1}, {1.5f, 0.5f}, {0, 1}});
    const Polygon b = *Polygon::build({{-1.2f, -0.5f}, {0.2f, -1.5f}, {1, 1}, {-0.5f, 1.2f}});
    Polygon out;
    int overlapping = 0;
    for (int i = 0; i < 200; ++i) {
        const auto turned = at(b, Pose2{{0.2f, 0.01f * static_cast<float>(i)}, Turn::by(0.1f * static_cast<float>(i))});
        if (i < 100) {
            intersection(a, turned, out);  // allocates the capacity
            continue;
        }
        const long before = allocations;
        const bool intersects = intersection(a, turned, out);
        overlapping += intersects && out.area() > 0.01 ? 1 : 0;
        if (intersects && out.area() > 0.01) {
            EXPECT_EQ(allocations - before, 0) << i;
        }
    }
    EXPECT_GT(overlapping, 50);
}

}  // namespace
}  // namespace abut
