// Walk meshes of the C API.

#include <abut/c/detail/answers.hpp>

#include <span>

using namespace abut::detail;

namespace {

using abut::Vec3;
using abut::WalkPoint;

abut_walk_point to_c(const WalkPoint& place) {
    return {place.triangle, abut::detail::to_c<3>(place.weights)};
}
WalkPoint from_c(const abut_walk_point& place) {
    return {place.triangle, same_bytes<Vec3>(place.weights)};
}

Fault valid(const abut_walk_mesh* mesh, const abut_walk_point& place, const char* name) {
    if (mesh == nullptr || mesh->tag != abut_walk_mesh::own_tag) return {};  // another fault
    if (place.triangle >= mesh->mesh.triangles().size() || !mesh->mesh.is_walkable(place.triangle))
        return {ABUT_INDEX_OUT_OF_RANGE, name, "is in no triangle of the mesh"};
    const abut_vec3& w = place.weights;
    const bool valid = all_finite(w) && w.x >= 0 && w.y >= 0 && w.z >= 0 && w.x + w.y + w.z > 0;
    return valid ? Fault() : Fault{ABUT_BAD_ARGUMENT, name, "has weights below 0, or all are 0"};
}

abut_walked walk(const abut::WalkMesh& mesh, const abut_walk_point& place, const abut_vec3& step) {
    const abut::Walked walked = mesh.walk(from_c(place), same_bytes<Vec3>(step));
    return {to_c(walked.place),
            abut::detail::to_c<3>(mesh.to_world(walked.place)),
            walked.length,
            walked.lost,
            static_cast<uint32_t>(walked.met),
            {walked.side.triangle, walked.side.side},
            same_bytes<abut_quat>(walked.turn.in_space()),
            walked.turn.mirrored() ? 1u : 0u,
            walked.crossings};
}

abut_code give_mesh(const abut::Result<abut::WalkMesh>& built, abut_walk_mesh** out) {
    if (!built) return report(built.problem());
    *out = new abut_walk_mesh{.mesh = *built};
    return ABUT_OK;
}

/// Writes a vector of a place.
template <class Question>
abut_code at_place(const abut_walk_mesh* mesh, const abut_walk_point& place, abut_vec3* out, const Question& question) {
    return entry({present(mesh, "mesh"), valid(mesh, place, "place"), present(out, "out")},
                 [&] { *out = abut::detail::to_c<3>(question(mesh->mesh, from_c(place))); });
}

}  // namespace

abut_code abut_walk_mesh_build(const abut_vec3* points, uint32_t stride, uint32_t point_count,
                               const uint32_t* triangles, uint32_t triangle_count, const abut_vec3* normals,
                               const uint8_t* areas, abut_walk_mesh** out) {
    const Strided points_of(points, stride, point_count, "points");
    return entry({points_of.fault(), array(triangles, triangle_count, "triangles"), present(out, "out")}, [&] {
        std::vector<glm::uvec3> corners(triangle_count);
        for (std::size_t i = 0; i < triangle_count; ++i)
            corners[i] = {triangles[3 * i], triangles[3 * i + 1], triangles[3 * i + 2]};
        std::vector<Vec3> own_normals;
        if (normals != nullptr) own_normals = Strided(normals, 0, point_count, "normals").copied<Vec3>();
        std::span<const uint8_t> own_areas;
        if (areas != nullptr) own_areas = {areas, triangle_count};
        return give_mesh(abut::WalkMesh::build(points_of.copied<Vec3>(), corners, own_normals, own_areas), out);
    });
}

void abut_walk_mesh_release(abut_walk_mesh* mesh) {
    release(mesh);
}

abut_code abut_walk_mesh_get_report(const abut_walk_mesh* mesh, abut_walk_mesh_report* out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] {
        const abut::WalkMeshReport& own = mesh->mesh.report();
        const auto number = [](std::size_t count) { return static_cast<uint32_t>(count); };
        *out = {number(own.duplicates),
                number(own.flat),
                number(own.left_out),
                number(own.turned),
                number(own.non_manifold_edges),
                number(own.mirrored),
                number(own.border),
                number(own.non_manifold_vertices),
                number(own.components)};
    });
}

abut_code abut_walk_mesh_nearest(const abut_walk_mesh* mesh, abut_vec3 point, abut_walk_point* out) {
    return entry({present(mesh, "mesh"), finite(point, "point"), present(out, "out")},
                 [&] { *out = to_c(mesh->mesh.nearest(same_bytes<Vec3>(point))); });
}

abut_code abut_walk_mesh_nearest_many(const abut_walk_mesh* mesh, const abut_vec3* points, uint32_t stride,
                                      uint32_t count, abut_walk_point* out) {
    const Strided points_of(points, stride, count, "points");
    return entry({present(mesh, "mesh"), points_of.fault_of_elements(), array(out, count, "out")}, [&] {
        for (uint32_t i = 0; i < count; ++i) out[i] = to_c(mesh->mesh.nearest(same_bytes<Vec3>(points_of[i])));
    });
}

abut_code abut_walk_mesh_nearest_along(const abut_walk_mesh* mesh, abut_ray3 ray, abut_walk_point* out, bool* found) {
    return entry({present(mesh, "mesh"), finite(ray, "ray"), present(out, "out"), present(found, "found")}, [&] {
        const auto place =
            mesh->mesh.nearest_along(same_bytes<Vec3>(ray.origin), same_bytes<Vec3>(ray.direction), ray.length);
        *found = place.has_value();
        if (place) *out = to_c(*place);
    });
}

abut_code abut_walk_mesh_to_world(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out) {
    return at_place(mesh, place, out, [](const auto& own, const WalkPoint& at) { return own.to_world(at); });
}

abut_code abut_walk_mesh_normal(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out) {
    return at_place(mesh, place, out, [](const auto& own, const WalkPoint& at) { return own.normal(at); });
}

abut_code abut_walk_mesh_smooth_normal(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3* out) {
    return at_place(mesh, place, out, [](const auto& own, const WalkPoint& at) { return own.smooth_normal(at); });
}

abut_code abut_walk_mesh_walk(const abut_walk_mesh* mesh, abut_walk_point place, abut_vec3 step, abut_walked* out) {
    return entry({present(mesh, "mesh"), valid(mesh, place, "place"), finite(step, "step"), present(out, "out")},
                 [&] { *out = walk(mesh->mesh, place, step); });
}

abut_code abut_walk_mesh_walk_many(const abut_walk_mesh* mesh, const abut_walk_point* places, uint32_t place_stride,
                                   const abut_vec3* steps, uint32_t step_stride, uint32_t count, abut_walked* out) {
    const Strided places_of(places, place_stride, count, "places");
    const Strided steps_of(steps, step_stride, count, "steps");
    return entry({present(mesh, "mesh"), places_of.fault(), steps_of.fault_of_elements(), array(out, count, "out")},
                 [&] {
                     for (uint32_t i = 0; i < count; ++i) {
                         Fault fault = valid(mesh, places_of[i], "places");
                         fault.index = i;
                         if (fault.code != ABUT_OK) return report(fault);
                     }
                     for (uint32_t i = 0; i < count; ++i) out[i] = walk(mesh->mesh, places_of[i], steps_of[i]);
                     return ABUT_OK;
                 });
}

abut_code abut_walk_mesh_path(const abut_walk_mesh* mesh, abut_walk_point from, abut_walk_point to,
                              const abut_walk_path_options* options, abut_walk_path* out, abut_vec3* points,
                              abut_walk_point* places, uint32_t capacity, uint32_t* count) {
    const Fault costs =
        options == nullptr ? Fault() : array(options->area_costs, options->area_cost_count, "options->area_costs");
    return entry({present(mesh, "mesh"), valid(mesh, from, "from"), valid(mesh, to, "to"), costs, present(out, "out"),
                  array(points, capacity, "points"), present(count, "count")},
                 [&] {
                     abut::WalkPathOptions own;
                     if (options != nullptr) {
                         own.area_costs = {options->area_costs, options->area_cost_count};
                         own.nearest_reachable = options->nearest_reachable != 0;
                         for (const float cost : own.area_costs)
                             if (!(cost > 0))
                                 return report(Fault{ABUT_BAD_ARGUMENT, "options->area_costs", "is not above 0",
                                                     static_cast<std::size_t>(&cost - own.area_costs.data())});
                     }
                     const auto path = mesh->mesh.find_path(from_c(from), from_c(to), own);
                     *out = {};
                     *count = 0;
                     if (!path) return ABUT_OK;
                     *out = {1, path->reached ? 1u : 0u, path->length, path->cost};
                     *count = static_cast<uint32_t>(path->points.size());
                     for (uint32_t i = 0; i < std::min(*count, capacity); ++i) {
                         points[i] = abut::detail::to_c<3>(path->points[i]);
                         if (places != nullptr) places[i] = to_c(path->places[i]);
                     }
                     return ABUT_OK;
                 });
}

abut_code abut_walk_mesh_save(const abut_walk_mesh* mesh, abut_buffer* out) {
    return entry({present(mesh, "mesh"), present(out, "out")}, [&] { out->bytes = save(mesh->mesh); });
}

abut_code abut_walk_mesh_load(const uint8_t* bytes, size_t size, abut_walk_mesh** out) {
    return entry({array(bytes, size, "bytes"), present(out, "out")}, [&] {
        return give_mesh(abut::load_walk_mesh({reinterpret_cast<const std::byte*>(bytes), size}), out);
    });
}
