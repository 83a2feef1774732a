// Bakes a walk mesh of a floor with the installed abut::recast.
#include <abut/recast.hpp>

#include <cstdio>
#include <vector>

int main() {
    const std::vector<abut::Vec3> points{{0, 0, 0}, {0, 0, 8}, {8, 0, 8}, {8, 0, 0}};
    const std::vector<glm::uvec3> triangles{{0, 1, 2}, {0, 2, 3}};
    const abut::Result<abut::WalkMesh> mesh = abut::bake_walk_mesh(points, triangles, {.radius = 0.5f});
    if (!mesh) {
        std::printf("%s\n", mesh.problem().message.c_str());
        return 1;
    }
    return mesh->report().components == 1 ? 0 : 1;
}
