// Meshes that the exhibits begin with.

#include "scene_mesh.h"

#include "../../scenes/solid_meshes.hpp"
#include <abut/c/detail/handles.hpp>
#include <abut/math/aabb.hpp>

#include <algorithm>

using namespace abut::detail;
using abut::scenes::SolidMesh;

namespace {

SolidMesh scene_mesh(std::uint32_t which) {
    if (which == 0) return abut::scenes::house();
    if (which == 1) return abut::scenes::knotted_tube(96, 10);
    abut::oracle::Random random(1);
    abut::scenes::BumpyBall ball = abut::scenes::bumpy_ball(28, 0.25, 0, random);
    return {std::move(ball.points), std::move(ball.triangles)};
}

/// Turns z up into y up, moves the middle of the box to the origin, and scales its longest side to 4.
void settle(std::vector<abut::Vec3>& points) {
    abut::Aabb3 box = abut::Aabb3::empty();
    for (abut::Vec3& point : points) {
        point = {point.x, point.z, -point.y};
        box = merged(box, abut::Aabb3{point, point});
    }
    const abut::Vec3 size = box.max - box.min;
    const float scale = 4 / std::max({size.x, size.y, size.z});
    for (abut::Vec3& point : points) point = (point - (box.min + size * 0.5f)) * scale;
}

}  // namespace

abut_code abut_play_scene_mesh(uint32_t which, abut_shape3** out) {
    return entry({present(out, "out")}, [&] {
        if (which > 2) return report(Fault{ABUT_BAD_ARGUMENT, "which", "is not the number of a mesh"});
        SolidMesh mesh = scene_mesh(which);
        settle(mesh.points);
        return give_built<3>(abut::Mesh::build(mesh.points, mesh.triangles), out);
    });
}
