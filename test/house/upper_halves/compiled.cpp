// Compiled without AVX: neither the compiler nor the library's headers clear the upper halves before a call. The public
// functions that are compiled in the library clear them at their entry. On an Intel Xeon (Sapphire Rapids) each of them
// once took 100 to 200 ns more if the caller had left the upper halves in use, such as 196 ns instead of 1 for the
// bounds of a mesh.

#include "probe.hpp"
#include <abut/broad_phase/choose_broad_phase.hpp>

#include <array>
#include <span>
#include <vector>

#include <glm/ext/matrix_float4x4.hpp>

namespace probe {
namespace {

using namespace abut;

volatile float sink;

template <class Phase>
void change_broad_phase() {
    const std::vector<Aabb3> boxes{{{0, 0, 0}, {1, 1, 1}}, {{5, 5, 5}, {6, 6, 6}}};
    Phase phase;
    expect_cleared_after("BroadPhase::build", [&] { phase.build(boxes); });
    expect_cleared_after("BroadPhase::update", [&] { phase.update(boxes); });
    if constexpr (requires { phase.set(0, boxes[0]); })
        expect_cleared_after("BroadPhase::set", [&] { phase.set(0, boxes[0]); });
    if constexpr (requires { phase.insert(boxes[0]); }) {
        expect_cleared_after("BroadPhase::insert", [&] { phase.insert(boxes[0]); });
        expect_cleared_after("BroadPhase::erase", [&] { phase.erase(2); });
    }
}

void change_broad_phases() {
    change_broad_phase<BruteForce<3>>();
    change_broad_phase<Grid<3>>();
    change_broad_phase<LayeredGrid<3>>();
    change_broad_phase<SweepAndPrune<3>>();
    change_broad_phase<Bvh<3>>();
    change_broad_phase<Bsp<3>>();
    change_broad_phase<ChosenBroadPhase<3>>();

    const std::vector<Aabb3> boxes{{{0, 0, 0}, {1, 1, 1}}, {{5, 5, 5}, {6, 6, 6}}};
    const std::vector<float> speeds{1, 1};
    expect_cleared_after("choose_broad_phase", [&] { choose_broad_phase<3>(boxes); });
    Temporal<3> temporal;
    std::vector<detail::ItemPair> pairs;
    expect_cleared_after("Temporal::build", [&] { temporal.build(boxes, speeds); });
    expect_cleared_after("Temporal::update", [&] { temporal.update(boxes, 0.1); });
    expect_cleared_after("Temporal::set_top_speed", [&] { temporal.set_top_speed(0, 1); });
    expect_cleared_after("Temporal::sorted_pairs", [&] { temporal.sorted_pairs(pairs); });
}

void call_arithmetic() {
    const Pose2 pose2{{1, 2}};
    const Pose3 pose{{1, 2, 3}};
    const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1};
    const Ray3 ray{{0, 0, 2}, {0, 0, -1}, 5};
    expect_cleared_after("Turn::by", [&] { sink = Turn::by(1).cos; });
    expect_cleared_after("turn_about", [&] { sink = turn_about(d, 1).w; });
    expect_cleared_after("rotate", [&] { sink = rotate(pose.rotation, a).x; });
    expect_cleared_after("Pose2 * point", [&] { sink = (pose2 * Vec2(1, 2)).x; });
    expect_cleared_after("Pose3 * point", [&] { sink = (pose * a).x; });
    expect_cleared_after("Pose2 * Pose2", [&] { sink = (pose2 * pose2).position.x; });
    expect_cleared_after("Pose3 * Pose3", [&] { sink = (pose * pose).position.x; });
    expect_cleared_after("inverse of a Pose2", [&] { sink = inverse(pose2).position.x; });
    expect_cleared_after("inverse of a Pose3", [&] { sink = inverse(pose).position.x; });
    expect_cleared_after("pose_from", [&] { sink = pose_from(glm::mat4(1))->position.x; });
    expect_cleared_after("Motion::between", [&] { sink = Motion3::between(pose, pose).move.x; });
    expect_cleared_after("pose_at", [&] { sink = pose_at(Motion3{}, 0.5f).position.x; });
    expect_cleared_after("Ray::between", [&] { sink = Ray3::between(a, b).length; });
    expect_cleared_after("on_line", [&] { sink = on_line(a, b, c) ? 1.0f : 0.0f; });
    expect_cleared_after("in_plane", [&] { sink = in_plane(a, b, c, d) ? 1.0f : 0.0f; });
    expect_cleared_after("reflect", [&] { sink = reflect(ray, Hit<3>{}).length; });
    expect_cleared_after("ray_through", [&] { sink = ray_through(Vec2(1), Vec2(2), glm::mat4(1)).length; });
    expect_cleared_after("expected_cost", [&] {
        sink = static_cast<float>(expected_cost(std::array{TestCost{1, 0.5}, TestCost{2, 0.5}}));
    });
}

void call_hulls() {
    const std::vector<Vec2> square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<Vec3> tetrahedron{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Polygon polygon;
    Polyhedron polyhedron;
    expect_cleared_after("Polygon::build", [&] { polygon = *Polygon::build(square); });
    expect_cleared_after("Polygon::set_outline", [&] { polygon.set_outline(square); });
    expect_cleared_after("Polygon::area", [&] { sink = static_cast<float>(polygon.area()); });
    expect_cleared_after("Polygon::centroid", [&] { sink = polygon.centroid().x; });
    expect_cleared_after("Polygon::normal", [&] { sink = polygon.normal().x; });
    expect_cleared_after("Polyhedron::build", [&] { polyhedron = *Polyhedron::build(tetrahedron); });
    expect_cleared_after("Polyhedron::volume", [&] { sink = static_cast<float>(polyhedron.volume()); });
    expect_cleared_after("Polyhedron::area", [&] { sink = static_cast<float>(polyhedron.area()); });
    expect_cleared_after("Polyhedron::centroid", [&] { sink = polyhedron.centroid().x; });
    expect_cleared_after("Polyhedron::normal", [&] { sink = polyhedron.normal().x; });
    expect_cleared_after("Polyhedron::ball", [&] { sink = static_cast<float>(polyhedron.ball().radius); });
    expect_cleared_after("polytope", [&] { sink = static_cast<float>(polytope(Aabb2{{0, 0}, {1, 1}}).area()); });
}

/// The parts of a level that a query finds. Nothing is within the boxes: a visitor leaves the upper halves clear.
template <int D, class Level>
void visit_parts(const char* name, const Level& level) {
    std::printf("%s\n", name);
    const Aabb<D> far{Vec<D>(50), Vec<D>(51)};
    MovingBox<D> moving;
    moving.center = detail::DVec<D>(50.0);
    moving.direction[0] = 1;
    moving.length = 1;
    expect_cleared_after("bounds", [&] { sink = bounds(level).min.x; });
    expect_cleared_after("each_part", [&] { each_part(level, far, [](const auto&, std::uint32_t) { return true; }); });
    expect_cleared_after("each_part_along",
                         [&] { each_part_along(level, moving, [](const auto&, std::uint32_t) { return 0.0f; }); });
    expect_cleared_after("each_part_near",
                         [&] { each_part_near(level, far, [](const auto&, std::uint32_t) { return 0.0f; }); });
    if constexpr (requires { solid_contains(level, far.min); })
        expect_cleared_after("solid_contains", [&] { sink = solid_contains(level, far.min) ? 1.0f : 0.0f; });
}

const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 2, 3}};

void call_levels() {
    const Ray3 ray{{0.5f, 0.5f, 2}, {0, 0, -1}, 5};
    const Mesh mesh = *Mesh::build(corners, triangles);
    visit_parts<3>("Mesh", mesh);
    expect_cleared_after("Mesh::triangle", [&] { sink = mesh.triangle(0).a.x; });
    expect_cleared_after("raycast on a mesh", [&] { sink = raycast(ray, mesh)->distance; });
    const HeightField field = *HeightField::build(std::array<float, 4>{}, 2, 1.0f);
    visit_parts<3>("HeightField", field);
    expect_cleared_after("HeightField::triangle", [&] { sink = field.triangle(0).a.x; });
    const TileMap map = *TileMap::build(std::array{Tile::full, Tile::full}, 2, 1.0f);
    visit_parts<2>("TileMap", map);
    expect_cleared_after("TileMap::part", [&] { sink = map.part(0).own[0].x; });
    const VoxelMap voxels = *VoxelMap::build(std::array{~std::uint64_t{0}}, {4, 4, 4}, 1.0f);
    visit_parts<3>("VoxelMap", voxels);
    expect_cleared_after("VoxelMap::box", [&] { sink = voxels.box(0).max.x; });
    const Chain chain = *Chain::build({{0, 0}, {1, 0}, {1, 1}}, true);
    visit_parts<2>("Chain", chain);
    expect_cleared_after("Chain::segment", [&] { sink = chain.segment(0).a.x; });
    visit_parts<3>("Compound", *Compound3::build({Sphere{{0, 0, 0}, 1}, Sphere{{1, 0, 0}, 1}}));
    const SolidBsp3 level = *SolidBsp3::build(corners, triangles);
    visit_parts<3>("SolidBsp", level);
    expect_cleared_after("SolidBsp::contains", [&] { sink = level.contains(Vec3(0, 0, 1)) ? 1.0f : 0.0f; });
    expect_cleared_after("raycast on a SolidBsp", [&] { sink = raycast(ray, level) ? 1.0f : 0.0f; });
}

void call_walk_mesh() {
    const WalkMesh mesh = *WalkMesh::build(corners, triangles);
    const WalkPoint place{0, {0.25f, 0.25f, 0.5f}}, on_edge{0, {0.5f, 0, 0.5f}};
    expect_cleared_after("WalkMesh::nearest", [&] { sink = mesh.nearest(Vec3(0, 0, 1)).weights.x; });
    expect_cleared_after("WalkMesh::nearest by the last", [&] { sink = mesh.nearest(Vec3(0, 0, 1), place).weights.x; });
    expect_cleared_after("WalkMesh::nearest within reach", [&] { sink = mesh.nearest(Vec3(0), 5.0f)->weights.x; });
    expect_cleared_after("WalkMesh::nearest_along",
                         [&] { sink = mesh.nearest_along(Vec3(0.5f, 0.25f, 1), Vec3(0, 0, -1))->weights.x; });
    expect_cleared_after("WalkMesh::walk", [&] { sink = mesh.walk(place, Vec3(0.5f, 0.5f, 0)).length; });
    expect_cleared_after("WalkMesh::walk in the plane", [&] { sink = mesh.walk(place, Vec2(0.5f, 0.5f)).length; });
    expect_cleared_after("WalkMesh::walk_in_triangle", [&] { sink = mesh.walk_in_triangle(place, Vec3(1)).fraction; });
    expect_cleared_after("WalkMesh::cross_edge", [&] { sink = mesh.cross_edge(on_edge) ? 1.0f : 0.0f; });
    expect_cleared_after("WalkMesh::to_world", [&] { sink = mesh.to_world(place).x; });
    expect_cleared_after("WalkMesh::normal", [&] { sink = mesh.normal(place).x; });
    expect_cleared_after("WalkMesh::smooth_normal", [&] { sink = mesh.smooth_normal(place).x; });
    expect_cleared_after("WalkMesh::to_plane", [&] { sink = mesh.to_plane(0, Vec3(1)).x; });
    expect_cleared_after("WalkMesh::to_space", [&] { sink = mesh.to_space(0, Vec2(1)).x; });
    expect_cleared_after("WalkMesh::find_path",
                         [&] { sink = static_cast<float>(mesh.find_path(place, place)->length); });
    expect_cleared_after("bounds of a WalkMesh", [&] { sink = bounds(mesh).min.x; });
}

/// The distance to the plane z = 0.
Field3 plane_field() {
    detail::FieldData<3> data;
    data.origin = Vec3(-2);
    data.cells = glm::uvec3(4);
    data.surface = {Vec3(-2, -2, 0), Vec3(2, 2, 0)};
    for (int i = 0; i < 125; ++i) data.distance.push_back(static_cast<float>(i / 25 - 2));
    return Field3(std::move(data));
}

void call_field() {
    const Field3 field = plane_field();
    const Vec3 point(0.5f, 0.25f, 0.5f), light(0, 0, 2), up(0, 0, 1);
    const std::span<const Vec3> points(&point, 1), normals(&up, 1);
    std::array<float, 1> distance;
    std::array<FieldSample<3>, 1> sample;
    expect_cleared_after("Field::distance", [&] { sink = field.distance(point); });
    expect_cleared_after("Field::sample", [&] { sink = field.sample(point).distance; });
    expect_cleared_after("Field::closest", [&] { sink = field.closest(point).x; });
    expect_cleared_after("Field::shadow", [&] { sink = field.shadow(point, light); });
    expect_cleared_after("Field::ambient_occlusion", [&] { sink = field.ambient_occlusion(point, up, 1); });
    expect_cleared_after("Field::distance of many", [&] { field.distance(points, distance); });
    expect_cleared_after("Field::sample of many", [&] { field.sample(points, sample); });
    expect_cleared_after("Field::shadow of many", [&] { field.shadow(points, light, 0.1f, distance); });
    expect_cleared_after("Field::ambient_occlusion of many",
                         [&] { field.ambient_occlusion(points, normals, 1, distance); });
    expect_cleared_after("Field::volume", [&] { sink = field.volume().min.x; });
    expect_cleared_after("bounds of a Field", [&] { sink = bounds(field).min.x; });
}

void move_shapes() {
    World3 world;
    world.add(Box3{{0, 0, 0}, {1, 1, 1}});
    world.update();
    const Sphere ball{{0, 0, 0}, 0.25f};
    const Ray3 ray{{0, 0, 5}, {0, 0, -1}, 10};
    std::optional<Laser<3>> laser;
    Mover3 mover;
    expect_cleared_after("Laser", [&] { laser.emplace(world, ray); });
    expect_cleared_after("Laser::bounce", [&] { laser->bounce(); });
    expect_cleared_after("Mover::move", [&] { sink = mover.move(world, ball, Vec3(0, 3, 0), Vec3(1, 0, 0)).motion.x; });
    expect_cleared_after("depenetrate", [&] { sink = depenetrate(Sphere{{0, 5, 0}, 1}, world).depth; });
    const std::vector<Sphere> balls{{{0, 0, 0}, 1}, {{3, 0, 0}, 1}};
    const std::vector<Pose3> poses{{{0, 0, 0}}, {{0, 0, 0}}};
    expect_cleared_after("removal_order", [&] { sink = removal_order(balls, Vec3(1, 0, 0)) ? 1.0f : 0.0f; });
    expect_cleared_after("rearrange", [&] { sink = rearrange(balls, poses, poses) ? 1.0f : 0.0f; });
}

}  // namespace

void call_compiled_functions() {
    change_broad_phases();
    call_arithmetic();
    call_hulls();
    call_levels();
    call_walk_mesh();
    call_field();
    move_shapes();
}

}  // namespace probe
