// Solids: overlaps, depths and contacts of pieces of a kit, of bumpy balls, and of these with round shapes.

#include "../../scenes/bumpy_ball.hpp"
#include "../../scenes/kit.hpp"
#include "sections.hpp"
#include <abut/query/each_contact.hpp>
#include <abut/query/sweep.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/cylinder.hpp>
#include <abut/shape/placed.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/solid_mesh.hpp>

namespace abut::everywhere {
namespace {

void add_kit(Hash& hash) {
    oracle::Random random(20269);
    std::vector<Mesh> meshes;
    for (const scenes::KitPiece& piece : scenes::kit()) meshes.push_back(*Mesh::build(piece.points, piece.triangles));
    const auto count = static_cast<std::uint32_t>(meshes.size());
    for (int i = 0; i < 200; ++i) {
        const std::uint32_t first = random.below(count), second = random.below(count);
        const Vec3 position = scenes::kit_position(random, Vec3(0), 2);
        const auto a = at(solid(meshes[first]), Pose3{position});
        Pose3 pose{scenes::kit_position(random, position, 2)};
        if (random.chance(0.5)) pose.rotation = random.rotation<3>();
        const auto b = at(solid(meshes[second]), pose);
        add_closest(hash, closest(a, b));
        add_contact(hash, contact(b, a));
    }
}

void add_bumpy_balls(Hash& hash) {
    oracle::Random random(20288);
    const scenes::BumpyBall surface = scenes::bumpy_ball(8, 0.3, 0.01, random);
    const Mesh mesh = *Mesh::build(surface.points, surface.triangles);
    const auto ball = solid(mesh);
    for (int i = 0; i < 8; ++i) {
        const detail::DVec<3> direction = random.direction<3>();
        const Vec3 place = detail::to_float(direction * random.uniform(0.5, 1.8));
        const Pose3 pose{place, random.rotation<3>()};
        add_closest(hash, closest(ball, at(ball, pose)));
        add_closest(hash, closest(ball, at(*Polyhedron::build(surface.points), pose)));
        add_closest(hash, closest(ball, Sphere{place, 0.25f}));
        const Capsule3 capsule{place, place * 0.5f, 0.125f};
        add_closest(hash, closest(capsule, ball));
        add_closest(hash, closest(ball, Cylinder{place, place * 0.25f, 0.25f}));
        each_contact(ball, capsule, [&](const Contact<3>& contact) { add_contact(hash, contact); });
        add_hit(hash, raycast(Ray3::between(place * 0.25f, -place), ball));
        add_hit(hash, sweep(capsule, place, ball));
        add_hit(hash, sweep(ball, place, capsule));
    }
}

}  // namespace

void add_solids(Hash& hash) {
    add_kit(hash);
    add_bumpy_balls(hash);
}

}  // namespace abut::everywhere
