// Ray casts against a mesh without a pose, from the ray to the hit in one function. Compiled for each SIMD target by
// Highway, which selects one at run time.

#include <abut/math/simd/compiler-inl.h>
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

/// The ray, or if its direction isn't of length 1 to within 5e-6, one in `storage` whose direction is.
HWY_INLINE const Ray<3>& with_unit_direction(const Ray<3>& ray, Ray<3>& storage) {
    const DVec<3> direction(ray.direction);
    if (std::abs(length_squared(direction) - 1) < 1e-5) return ray;
    storage = {ray.origin, to_float(unit(direction)), ray.length};
    return storage;
}

/// Calls answer(mesh_ray, test) with the exact test of a mesh without a pose.
template <class Answer>
HWY_INLINE bool with_exact_test(const DRay<3>& beam, const LocalRay& local, Trace<3>* trace, const Answer& answer) {
    const auto undecided = by_advance(
        beam, [](const Triangle3& triangle) { return convex(triangle); }, trace);
    const RobustTriangleTest robust(undecided);
    const MeshRay ray{beam, local};
    return answer(ray, TriangleTest<ToRayByOffset>(ray, {beam.origin}, robust));
}

double facing_sign(const QueryOptions<3>& options) {
    return options.back_faces ? 0 : 1;
}

/// Returns false, without an answer, if the numbers exceed the range of floats.
bool cast_at_mesh(const Ray<3>& ray, const MeshTree& tree, const QueryOptions<3>& options,
                  std::optional<Hit<3>>& result) {
    if (!is_valid_query(ray) || ray.direction == Vec3(0.0f)) return true;
    Ray<3> storage;
    const LocalRay local{with_unit_direction(ray, storage), 0, facing_sign(options)};
    const DRay<3> beam = to_dray(ray);
    MeshHit first;
    const auto find = [&](const MeshRay& mesh_ray, const auto& test)
                          ABUT_INLINE_LAMBDA { return find_first(tree, mesh_ray, test, first); };
    if (!with_exact_test(beam, local, options.trace, find)) return false;
    if (first.triangle == nullptr) return true;
    Hit<3>& hit = result.emplace();
    write_hit(beam, first.entry.along, first.entry.normal, hit);
    hit.feature = {*first.triangle, first.entry.index, first.entry.kind};
    return true;
}

/// Likewise; `result` is whether there is a hit.
bool cast_any_at_mesh(const Ray<3>& ray, const MeshTree& tree, const QueryOptions<3>& options, bool& result) {
    if (!is_valid_query(ray) || ray.direction == Vec3(0.0f)) return true;
    Ray<3> storage;
    const LocalRay local{with_unit_direction(ray, storage), 0, facing_sign(options)};
    // Few rays need the exact test, so it makes its numbers itself.
    const auto is_hit = [&](const MeshLeaf& leaf, std::uint32_t lane) {
        const DRay<3> beam = to_dray(ray);
        return with_exact_test(beam, local, options.trace, [&](const MeshRay&, const auto& test) {
            RayEntry<3> entry;
            return test(leaf, lane, beam.length, entry);
        });
    };
    return find_any(tree, local, is_hit, result);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

using namespace detail;

namespace detail {
HWY_EXPORT(cast_at_mesh);
HWY_EXPORT(cast_any_at_mesh);
}  // namespace detail

std::optional<Hit<3>> raycast(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options) {
    detail::enter_library();
    std::optional<Hit<3>> result;
    if (!HWY_DYNAMIC_DISPATCH(cast_at_mesh)(ray, triangle_tree(mesh), options, result))
        result = raycast(ray, view(mesh), options);
    return result;
}

bool raycast_any(const Ray<3>& ray, const Mesh& mesh, const QueryOptions<3>& options) {
    detail::enter_library();
    bool result = false;
    if (!HWY_DYNAMIC_DISPATCH(cast_any_at_mesh)(ray, triangle_tree(mesh), options, result))
        result = raycast(ray, view(mesh), options).has_value();
    return result;
}

}  // namespace abut
#endif
