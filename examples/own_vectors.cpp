// A game with its own vectors and vertex buffers: nothing is copied into containers of abut, and no macro is needed.
#include <abut/abut.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

namespace game {

struct Vec3 {
    float x, y, z;
};

// A vertex as the graphics card takes it: 32 bytes.
struct Vertex {
    Vec3 position;
    Vec3 normal;
    float u, v;
};

// Members of other names: two functions join the type.
struct Place {
    double east, north, height;
};
abut::Vec3 to_vec(const Place& place) {
    return glm::dvec3(place.east, place.height, -place.north);
}
void from_vec(const abut::Vec3& v, Place& out) {
    out = {static_cast<double>(v.x), static_cast<double>(-v.z), static_cast<double>(v.y)};
}

}  // namespace game

int main() {
    // A square floor of two triangles, in buffers that the game draws.
    const std::vector<game::Vertex> vertices{{{-5, 0, -5}, {0, 1, 0}, 0, 0},
                                             {{-5, 0, 5}, {0, 1, 0}, 0, 1},
                                             {{5, 0, 5}, {0, 1, 0}, 1, 1},
                                             {{5, 0, -5}, {0, 1, 0}, 1, 0}};
    const std::vector<std::uint32_t> indices{0, 1, 2, 0, 2, 3};
    const abut::PointSpan<3> positions(&vertices[0].position.x, vertices.size(), sizeof(game::Vertex));
    const abut::Result<abut::Mesh> floor = abut::Mesh::build(positions, abut::as_triangles(indices));
    if (!floor) return 1;

    // Members x, y and z: to_vec in, from_vec out. A vector of them builds a shape as it is.
    const game::Vec3 player{1, 3, 2};
    const abut::Closest<3> below = abut::closest(*floor, abut::to_vec(player));
    const auto ground = abut::from_vec<game::Vec3>(below.on_a);
    std::printf("the floor is %g below, at %g %g %g\n", static_cast<double>(below.distance),
                static_cast<double>(ground.x), static_cast<double>(ground.y), static_cast<double>(ground.z));
    const std::vector<game::Vec3> corners{{0, 1, 0}, {1, 1, 0}, {0, 2, 0}, {0, 1, 1}};
    const abut::Result<abut::Polyhedron> rock = abut::Polyhedron::build(corners);

    const game::Place tower{2, -1, 4};
    const auto roof = abut::from_vec<game::Place>(abut::to_vec(tower) + abut::Vec3(0, 1, 0));
    std::printf("the roof is at height %g\n", roof.height);

    const bool right = below.distance == 3 && ground.x == 1 && ground.z == 2 && rock && rock->points().size() == 4 &&
                       roof.height == 5 && roof.north == -1;
    return right ? 0 : 1;
}
