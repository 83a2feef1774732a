// What is built of any triangles: a mesh, a walk mesh, convex parts and a distance field. Each is a Problem with a
// message, or answers with finite numbers.

#include "bytes.hpp"
#include <abut/abut.hpp>
#include <abut/bake.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace {

using namespace abut;
using fuzz::Bytes, fuzz::require;

struct Input {
    std::vector<Vec3> points;
    std::vector<glm::uvec3> triangles;
};

constexpr std::size_t max_points = 32, max_triangles = 48;

Input input_of(Bytes& bytes) {
    Input result;
    const std::size_t count = bytes.byte() % (max_points + 1);
    while (result.points.size() < count) {
        const float x = bytes.coordinate(), y = bytes.coordinate(), z = bytes.coordinate();
        result.points.emplace_back(x, y, z);
    }
    const auto index = [&] {
        const std::uint8_t byte = bytes.byte();
        return count == 0 || byte == 0xff ? std::uint32_t{byte} : static_cast<std::uint32_t>(byte % count);
    };
    while (!bytes.empty() && result.triangles.size() < max_triangles) {
        const std::uint32_t a = index(), b = index(), c = index();
        result.triangles.emplace_back(a, b, c);
    }
    return result;
}

bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

template <class T>
bool is_built(const Result<T>& result) {
    require(result || !result.problem().message.empty(), "a Problem without a message");
    return static_cast<bool>(result);
}

void check_mesh(const Input& input, const Vec3& point) {
    const Result<Mesh> mesh = Mesh::build(input.points, input.triangles);
    if (!is_built(mesh)) return;
    const Closest<3> nearest = closest(Sphere{point, 0.5f}, *mesh);
    require(is_finite(nearest.normal) && is_finite(nearest.on_a) && is_finite(nearest.on_b), "closest");
    require(overlaps(Sphere{point, 0.5f}, *mesh) || nearest.distance >= 0, "overlaps");
    if (const auto hit = raycast(Ray3{point, {0, -1, 0}, 100}, *mesh))
        require(is_finite(hit->point) && hit->distance >= 0 && hit->distance <= 100, "raycast");
}

void check_walk_mesh(const Input& input, const Vec3& point) {
    const Result<WalkMesh> mesh = WalkMesh::build(input.points, input.triangles);
    if (!is_built(mesh)) return;
    const WalkPoint place = mesh->nearest(point);
    require(mesh->is_walkable(place.triangle) && is_finite(mesh->to_world(place)), "nearest");
    const WalkPoint end = mesh->walk(place, {0.7f, 1.3f}).place;
    require(mesh->is_walkable(end.triangle) && is_finite(mesh->to_world(end)), "walk");
    require(mesh->component(place.triangle) == mesh->component(end.triangle), "a walk to another component");
}

void check_parts(const Input& input, std::uint8_t options) {
    DecomposeReport report;
    const auto parts = decompose(input.points, input.triangles,
                                 {.max_parts = 1u + options % 8u,
                                  .concavity = 0.05,
                                  .max_vertices = options % 2 == 0 ? 0u : 8u,
                                  .report = &report});
    if (!is_built(parts)) return;
    require(!parts->empty() && std::isfinite(report.farthest), "no parts");
    for (const Polyhedron& part : *parts)
        for (const Vec3& p : part.points()) require(is_finite(p), "a vertex of a part");
}

void check_field(const Input& input, const Vec3& point) {
    float longest = 0;
    for (const Vec3& p : input.points)
        for (int i = 0; i < 3; ++i) longest = std::max(longest, std::abs(p[i]));
    const Result<Field<3>> field = bake_field(input.points, input.triangles, {.cell = longest / 4, .padding = 1});
    if (!is_built(field)) return;
    const FieldSample<3> sample = field->sample(point);
    require(std::isfinite(sample.distance) && is_finite(sample.normal), "a sample");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const std::uint8_t options = bytes.byte();
    const float x = static_cast<float>(bytes.byte() % 16) * 0.5f, y = static_cast<float>(bytes.byte() % 16) * 0.5f;
    const Vec3 point(x, y, 0.25f);
    const Input input = input_of(bytes);
    check_mesh(input, point);
    check_walk_mesh(input, point);
    check_parts(input, options);
    check_field(input, point);
    return 0;
}
