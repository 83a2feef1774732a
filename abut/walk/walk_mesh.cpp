// The walk mesh (navigation mesh): its places, its normals and its report.

#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/walk/data.hpp>
#include <abut/walk/frame.hpp>

#include <string>

namespace abut {

using namespace detail;

namespace {

std::string counted(std::size_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

}  // namespace

const WalkMeshReport& WalkMesh::report() const {
    return data_->report;
}
std::span<const Vec3> WalkMesh::points() const {
    return data_->points;
}
std::span<const glm::uvec3> WalkMesh::triangles() const {
    return data_->triangles;
}
bool WalkMesh::is_walkable(std::uint32_t triangle) const {
    return data_->walk[triangle].is_walkable();
}
std::uint8_t WalkMesh::area(std::uint32_t triangle) const {
    return static_cast<std::uint8_t>(data_->walk[triangle].area);
}
std::uint32_t WalkMesh::component(std::uint32_t triangle) const {
    return data_->components[triangle];
}

std::optional<WalkSide> WalkMesh::beyond(const WalkSide& side) const {
    const WalkLink link = data_->walk[side.triangle].link[side.side];
    if (link.is_border()) return std::nullopt;
    return WalkSide{link.triangle(), link.side()};
}

Vec3 WalkMesh::to_world(const WalkPoint& place) const {
    detail::enter_library();
    return to_float(position_of(data_->walk[place.triangle], place));
}

Vec3 WalkMesh::normal(const WalkPoint& place) const {
    detail::enter_library();
    return to_float(WalkFrame(data_->walk[place.triangle]).normal());
}

Vec3 WalkMesh::smooth_normal(const WalkPoint& place) const {
    detail::enter_library();
    const glm::uvec3& of = data_->corner_normals[place.triangle];
    const WalkWeights weights = normalised_weights(place.weights);
    const DVec<3> sum = DVec<3>(data_->normals[of.x]) * weights.first + DVec<3>(data_->normals[of.y]) * weights.second +
                        DVec<3>(data_->normals[of.z]) * weights.third;
    if (!(length_squared(sum) > 1e-12)) return normal(place);
    return to_float(normalized(sum));
}

Vec2 WalkMesh::to_plane(std::uint32_t triangle, const Vec3& vector) const {
    detail::enter_library();
    return to_float(to_plane_of(data_->walk[triangle], vector));
}
Vec3 WalkMesh::to_space(std::uint32_t triangle, const Vec2& vector) const {
    detail::enter_library();
    return to_float(WalkFrame(data_->walk[triangle]).to_space(DVec<2>(vector)));
}

Aabb3 bounds(const WalkMesh& mesh) {
    detail::enter_library();
    return mesh.data().bounds;
}

bool changed(const WalkMeshReport& report) {
    return report.duplicates + report.flat + report.left_out + report.turned + report.non_manifold_edges != 0;
}

std::string described(const WalkMeshReport& report) {
    std::string result = counted(report.components, "component", "components");
    const auto add_count = [&](std::size_t count, const char* one, const char* many) {
        if (count != 0) result += ", " + counted(count, one, many);
    };
    add_count(report.duplicates, "triangle there twice", "triangles there twice");
    add_count(report.flat, "triangle without area cut away", "triangles without area cut away");
    add_count(report.left_out, "triangle without area left out", "triangles without area left out");
    add_count(report.turned, "triangle turned", "triangles turned");
    add_count(report.non_manifold_edges, "edge of more than two triangles", "edges of more than two triangles");
    add_count(report.mirrored, "edge where the surface turns over", "edges where the surface turns over");
    add_count(report.non_manifold_vertices, "non-manifold vertex", "non-manifold vertices");
    add_count(report.border, "border edge", "border edges");
    return result;
}

}  // namespace abut
