// Values of all types that packaging/debug/abut_gdb.py prints. expected.cmake stops at `done` and prints them.
#include <abut/abut.hpp>

#include <initializer_list>
#include <vector>

namespace {

int count = 0;

[[gnu::noinline]] void done(const void* value) {
    count += value != nullptr ? 1 : 0;
}

}  // namespace

int main() {
    const abut::Vec3 vec3(1, 2.5f, -3);
    const abut::Vec2 vec2(1, 2);
    const abut::Pose3 pose3{{1, 2, 3}, glm::quat(0.5f, 0.5f, 0.5f, 0.5f)};
    const abut::Pose2 pose2{{1, 2}, abut::Turn(0, 1)};
    const abut::Aabb2 aabb{{0, 1}, {2, 3}};
    const abut::Sphere ball{{1, 2, 3}, 0.5f};
    const abut::Box2 box{{0, 0}, {1, 2}, abut::Turn(0, 1)};
    const abut::Ray3 ray{{0, 0, 0}, {1, 0, 0}, 4};
    const abut::Id null, id{3, 1};
    const abut::IdPair pair{{1, 0}, {3, 1}};
    const abut::Polygon polygon = *abut::Polygon::build({{0, 0}, {1, 0}, {0, 1}});
    const abut::Result<abut::Polygon> good = polygon, bad = abut::Polygon::build(std::initializer_list<abut::Vec2>{});
    const abut::Result<abut::Polyhedron> hull = abut::Polyhedron::build({{0, 0, 0}, {1, 0, 0}});
    for (const void* value : std::vector<const void*>{&vec3, &vec2, &pose3, &pose2, &aabb, &ball, &box, &ray, &null,
                                                      &id, &pair, &polygon, &good, &bad, &hull})
        done(value);
    return count == 15 ? 0 : 1;
}
