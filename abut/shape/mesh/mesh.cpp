#include <abut/math/assert.hpp>
#include <abut/math/detail/coincident.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/line_crossing.hpp>
#include <abut/shape/mesh.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/surface.hpp>

#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace abut {

using namespace detail;

namespace {

/// True if the plane of the triangle lies at larger x than the point.
bool is_beyond(const Triangle3& t, const Vec3& point) {
    const DVec<3> a(t.a);
    const DVec<3> normal = cross(DVec<3>(t.b) - a, DVec<3>(t.c) - a);
    const double height = dot(normal, DVec<3>(point) - a);
    return normal.x > 0 ? height < 0 : height > 0;
}

}  // namespace

Result<Mesh> Mesh::build(const PointSpan<3>& given, std::span<const glm::uvec3> triangles) {
    detail::enter_library();
    const PackedPoints<3> packed(given);
    const std::span<const Vec3> points = packed.points();
    if (std::optional<Problem> problem = problem_of_faces<3>(points, triangles, "a mesh")) return *std::move(problem);
    auto data = std::make_shared<MeshSurface>();
    data->points.assign(points.begin(), points.end());
    data->triangles.assign(triangles.begin(), triangles.end());
    const std::vector<std::uint32_t> same = first_coincident(points);
    data->adjacency = build_mesh_adjacency(triangles, same);
    data->tree = build_mesh_tree(points, triangles, same);
    if (data->adjacency.closed) find_components(*data);
    return Mesh(std::move(data));
}

std::span<const Vec3> Mesh::points() const {
    return data_->points;
}
std::span<const glm::uvec3> Mesh::triangles() const {
    return data_->triangles;
}
bool Mesh::closed() const {
    return data_->adjacency.closed;
}

std::uint32_t Mesh::neighbour(std::uint32_t triangle, std::uint32_t edge) const {
    ABUT_ASSERT(triangle < data_->triangles.size() && edge < 3);
    return data_->adjacency.neighbours[triangle][edge];
}

Triangle3 Mesh::triangle(std::uint32_t index) const {
    detail::enter_library();
    const glm::uvec3& t = data_->triangles[index];
    return {data_->points[t.x], data_->points[t.y], data_->points[t.z]};
}

Aabb3 bounds(const Mesh& mesh) {
    detail::enter_library();
    return mesh.data_->tree.root(0).box;
}

void each_part(const Mesh& mesh, const Aabb3& box,
               FunctionRef<bool(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    find_overlapping(mesh.data_->tree, box,
                     [&](std::uint32_t index) -> bool { return visit(mesh.triangle(index), index); });
}

void each_part_along(const Mesh& mesh, const MovingBox<3>& box,
                     FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    find_within(mesh.data_->tree, RayReach<3>::of_box(box),
                [&](std::uint32_t index) -> float { return visit(mesh.triangle(index), index); });
}

void each_part_near(const Mesh& mesh, const Aabb3& box,
                    FunctionRef<float(const Triangle3& part, std::uint32_t index)> visit) {
    detail::enter_library();
    constexpr float any = std::numeric_limits<float>::infinity();
    find_within(mesh.data_->tree, BoxReach<3>(box, any),
                [&](std::uint32_t index) -> float { return visit(mesh.triangle(index), index); });
}

const MeshTree& triangle_tree(const Mesh& mesh) {
    return mesh.data_->tree;
}

const MeshSurface& mesh_surface(const Mesh& mesh) {
    return *mesh.data_;
}

bool solid_contains(const Mesh& mesh, const Vec3& point) {
    detail::enter_library();
    if (!mesh.closed()) return false;
    Aabb3 ahead{point, point};
    ahead.max.x = std::numeric_limits<float>::infinity();
    int winding = 0;
    find_overlapping(mesh.data_->tree, ahead, [&](std::uint32_t index) -> bool {
        const Triangle3 t = mesh.triangle(index);
        const int crossing = crossing_by_line({DVec<3>(t.a), DVec<3>(t.b), DVec<3>(t.c)}, DVec<3>(point), 0);
        if (crossing != 0 && is_beyond(t, point)) winding += crossing;
        return true;
    });
    return winding != 0;
}

}  // namespace abut
