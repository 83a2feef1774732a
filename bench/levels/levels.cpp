// A box and a capsule against a terrain of a hundred thousand triangles: overlap test, contacts and manifolds. The
// overlap test also against a solid level of three thousand brushes. About half of them touch something.

#include "levels.hpp"

#include "../../scenes/terrain.hpp"
#include <abut/query/contact.hpp>
#include <abut/query/each_contact.hpp>
#include <abut/query/overlaps.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/solid_bsp.hpp>

#include <algorithm>
#include <limits>

namespace abut::bench {

using namespace detail;

namespace {

constexpr std::size_t query_count = 8192;
constexpr std::uint32_t columns = 224;
constexpr std::size_t brush_count = 3000;
constexpr std::uint64_t seed = 1;

/// The peers use tolerances, Bullet floats: for barely touching shapes some answers differ.
constexpr double few = 0.01;

SharedLevelScene scene_of(const std::variant<Box3, Capsule3>& shape) {
    oracle::Random random(seed);
    scenes::Terrain ground = scenes::random_terrain(columns, random);
    auto result =
        std::make_shared<LevelScene>(LevelScene{std::move(ground.points), std::move(ground.triangles), {}, shape, {}});
    const double half = 0.49 * columns;
    for (std::size_t i = 0; i < query_count; ++i) {
        const float x = random.uniform_float(-half, half), y = random.uniform_float(-0.5, 2.5);
        result->poses.push_back({{x, y, random.uniform_float(-half, half)}, random.rotation<3>()});
    }
    return result;
}

template <class Level>
Side overlaps_by_abut(const SharedLevelScene& scene, const Level& level) {
    return {"abut", [scene, level](std::span<double> values) {
                const auto run = [&](const auto& shape) {
                    for (std::size_t i = 0; i < values.size(); ++i)
                        values[i] = overlaps(at(shape, scene->poses[i]), level) ? 1 : 0;
                };
                std::visit(run, scene->shape);
            }};
}

Job overlaps_at_all(const SharedLevelScene& scene) {
    Side bullet = bullet_level_overlaps(scene), fcl = fcl_level_overlaps(scene);
    bullet.strays = fcl.strays = few;
    return {.items = query_count,
            .values = query_count,
            .sides = {overlaps_by_abut(scene, *Mesh::build(scene->points, scene->triangles)), bullet, fcl}};
}

/// Boxes of 1 to 4 with truncated corners, partly overlapping.
Job overlaps_in_solid(const std::variant<Box3, Capsule3>& shape) {
    oracle::Random random(seed);
    constexpr double half = 30;
    std::vector<HalfSpace3> sides;
    std::vector<std::uint32_t> ends;
    for (std::size_t i = 0; i < brush_count; ++i) {
        const Vec3 center(random.in_cube<3>() * half);
        const auto add = [&](const DVec<3>& out, double height) {
            const Vec3 normal = to_float(out);
            sides.push_back({normal, dot(normal, center) + static_cast<float>(height)});
        };
        for (int axis = 0; axis < 3; ++axis)
            for (const double end : {-1.0, 1.0}) add(abut::detail::axis<3>(axis, end), random.uniform(0.5, 2));
        for (int k = 0; k < 3; ++k) add(random.direction<3>(), random.uniform(0.5, 2));
        ends.push_back(static_cast<std::uint32_t>(sides.size()));
    }
    const SolidBsp3 solid = *SolidBsp3::from_brushes(sides, ends);
    auto scene = std::make_shared<LevelScene>(LevelScene{{}, {}, {}, shape, {}});
    each_part(solid, bounds(solid), [&](const Convex<3>& part, std::uint32_t) -> bool {
        std::vector<Vec3> corners;
        for (std::uint32_t i = 0; i < part.count; ++i)
            corners.push_back(to_float(part.place.point(DVec<3>(part.vertices()[i]))));
        scene->brushes.push_back(*Polyhedron::build(corners));
        return true;
    });
    for (std::size_t i = 0; i < query_count; ++i)
        scene->poses.push_back({Vec3(random.in_cube<3>() * half), random.rotation<3>()});
    Side bullet = bullet_level_overlaps(scene);
    bullet.strays = few;
    return {.items = query_count, .values = query_count, .sides = {overlaps_by_abut(scene, solid), bullet}};
}

/// Visits the triangles touched one by one, without joining their manifolds.
template <class Shape, class Visit>
void each_touched(const Shape& shape, const Mesh& mesh, Visit&& visit) {
    each_part(mesh, bounds(shape), [&](const Triangle3& triangle, std::uint32_t index) {
        if (overlaps(shape, triangle)) visit(index);
        return true;
    });
}

/// The count of touched triangles that each_contact leaves out as ghost contacts: peers report them, but their normals
/// are not surface normals. NaN if it reports a triangle that isn't touched, or one twice.
template <class Shape>
double ghosts_of(const Shape& shape, const Mesh& mesh) {
    std::vector<std::uint32_t> touched;
    each_touched(shape, mesh, [&](std::uint32_t index) { touched.push_back(index); });
    bool all_are_touched = true;
    each_contact(shape, mesh, [&](const Contact<3>& contact) {
        all_are_touched = all_are_touched && std::erase(touched, contact.feature_b.part) == 1;
    });
    return all_are_touched ? static_cast<double>(touched.size()) : std::numeric_limits<double>::quiet_NaN();
}

/// All contacts, with positions, normals and depths. Every side reports the count of touched triangles; abut adds its
/// ghost contacts, counted in advance.
Job contacts(const SharedLevelScene& scene) {
    const Mesh mesh = *Mesh::build(scene->points, scene->triangles);
    std::vector<double> ghosts;
    std::visit(
        [&](const auto& shape) {
            for (const Pose3& pose : scene->poses) ghosts.push_back(ghosts_of(at(shape, pose), mesh));
        },
        scene->shape);
    const Side ours{"abut", [scene, mesh, ghosts = std::move(ghosts)](std::span<double> values) {
                        const auto run = [&](const auto& shape) {
                            for (std::size_t i = 0; i < values.size(); ++i) {
                                values[i] = ghosts[i];
                                each_contact(at(shape, scene->poses[i]), mesh, [&](const Contact<3>&) { ++values[i]; });
                            }
                        };
                        std::visit(run, scene->shape);
                    }};
    Side bullet = bullet_level_contacts(scene), fcl = fcl_level_contacts(scene);
    bullet.strays = fcl.strays = few;
    return {.items = query_count, .values = query_count, .sides = {ours, bullet, fcl}};
}

/// Touched triangles only.
Job touched(const SharedLevelScene& scene) {
    const Side ours{"abut", [scene, mesh = *Mesh::build(scene->points, scene->triangles)](std::span<double> values) {
                        const auto run = [&](const auto& shape) {
                            for (std::size_t i = 0; i < values.size(); ++i) {
                                values[i] = 0;
                                each_touched(at(shape, scene->poses[i]), mesh, [&](std::uint32_t) { ++values[i]; });
                            }
                        };
                        std::visit(run, scene->shape);
                    }};
    Side fcl = fcl_level_touched(scene);
    fcl.strays = few;
    return {.items = query_count, .values = query_count, .sides = {ours, fcl}};
}

}  // namespace

std::vector<Bench> level_benches() {
    const Box3 box{{0, 0, 0}, {1, 0.75f, 0.5f}};
    const Capsule3 capsule{{0, -0.5f, 0}, {0, 0.5f, 0}, 0.5f};
    return {
        {"levels/overlaps/terrain/100k/box", [=] { return overlaps_at_all(scene_of(box)); }},
        {"levels/overlaps/terrain/100k/capsule", [=] { return overlaps_at_all(scene_of(capsule)); }},
        {"levels/overlaps/solid/3000/box", [=] { return overlaps_in_solid(box); }},
        {"levels/overlaps/solid/3000/capsule", [=] { return overlaps_in_solid(capsule); }},
        {"levels/touched/terrain/100k/box", [=] { return touched(scene_of(box)); }},
        {"levels/touched/terrain/100k/capsule", [=] { return touched(scene_of(capsule)); }},
        {"levels/contacts/terrain/100k/box", [=] { return contacts(scene_of(box)); }},
        {"levels/contacts/terrain/100k/capsule", [=] { return contacts(scene_of(capsule)); }},
    };
}

}  // namespace abut::bench
