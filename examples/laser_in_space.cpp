// A 3D laser that is reflected by mirrors until it hits its target.
#include <abut/abut.hpp>

#include <cstdio>

int main() {
    abut::World3 room;
    const abut::Id target = room.add(abut::Box3{{0, 0, 9}, {3, 3, 0.5f}});
    room.add(abut::Box3{{-2, 0, 0}, {0.1f, 4, 8}});  // two mirrors face to face
    room.add(abut::Box3{{2, 0, 0}, {0.1f, 4, 8}});

    int mirrors = 0;
    bool arrived = false;
    follow_laser(room, {{0, 0, -7}, {0.8f, 0, 0.6f}}, [&](const abut::Ray3&, const auto& hit) {
        const abut::Vec3& at = hit.hit.point;
        arrived = hit.id == target;
        std::printf("%s at (%.3f, %.3f, %.3f)\n", arrived ? "the target" : "a mirror", at.x, at.y, at.z);
        return !arrived && ++mirrors < 50;
    });
    return arrived && mirrors > 2 ? 0 : 1;
}
