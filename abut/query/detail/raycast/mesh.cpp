// Ray casts against a mesh without a pose, from the ray to the hit in one function. Compiled for each SIMD target by
// Highway, which selects one at run time.

#include <abut/math/simd/library_entry.hpp>
#include <abut/query/detail/raycast/by_advance.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/mesh.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/query/detail/raycast/mesh.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/rays_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// Returns false, without an answer, if the numbers exceed the range of floats.
bool cast_at_mesh(const Ray<3>& ray, const MeshTree& tree, const QueryOptions<3>& options,
                  std::optional<Hit<3>>& result) {
    if (!is_valid_query(ray)) return true;
    const DRay<3> beam = to_dray(ray);
    if (beam.rests()) return true;
    const auto undecided = by_advance(
        beam, [](const Triangle3& triangle) { return convex(triangle); }, options.trace);
    const RobustTriangleTest robust(undecided);
    const MeshRay mesh_ray{beam, beam, 1, 0, nullptr, options.back_faces ? 0.0 : 1.0};
    MeshHit first;
    if (!find_first(tree, mesh_ray, TriangleTest<ToRayByOffset>(mesh_ray, {beam.origin}, robust), first)) return false;
    if (first.triangle == nullptr) return true;
    Hit<3>& hit = result.emplace();
    write_hit(beam, first.entry.along, first.entry.normal, hit);
    hit.feature = {*first.triangle, first.entry.index, first.entry.kind};
    return true;
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

using namespace detail;

namespace detail {
HWY_EXPORT(cast_at_mesh);
}

std::optional<Hit<3>> raycast(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options) {
    detail::enter_library();
    std::optional<Hit<3>> result;
    if (!HWY_DYNAMIC_DISPATCH(cast_at_mesh)(ray, triangle_tree(mesh), options, result))
        result = raycast(ray, view(mesh), options);
    return result;
}

}  // namespace abut
#endif
