// Ray casts against a mesh's tree. Compiled for each SIMD target by Highway, which selects one at run time.

#include <abut/shape/mesh/rays.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh/rays.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/rays_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

template <class Test>
bool find_any_by(const MeshTree& tree, const MeshRay& ray, const Test& test, bool& found) {
    const auto is_hit = [&](const MeshLeaf& leaf, std::uint32_t lane) {
        RayEntry<3> entry;
        return test(leaf, lane, ray.world.length, entry);
    };
    return find_any(tree, ray.local, is_hit, found);
}

bool any_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, bool& found) {
    if (ray.to_ray == nullptr)
        return find_any_by(tree, ray, TriangleTest<ToRayByOffset>(ray, {ray.world.origin}, undecided), found);
    return find_any_by(tree, ray, TriangleTest<ToRayByMap>(ray, {*ray.to_ray}, undecided), found);
}

bool first_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, MeshHit& hit) {
    if (ray.to_ray == nullptr)
        return find_first(tree, ray, TriangleTest<ToRayByOffset>(ray, {ray.world.origin}, undecided), hit);
    return find_first(tree, ray, TriangleTest<ToRayByMap>(ray, {*ray.to_ray}, undecided), hit);
}

bool each_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, const MeshHitCall& visit) {
    if (ray.to_ray == nullptr)
        return find_each(tree, ray, TriangleTest<ToRayByOffset>(ray, {ray.world.origin}, undecided), visit);
    return find_each(tree, ray, TriangleTest<ToRayByMap>(ray, {*ray.to_ray}, undecided), visit);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(first_hit);
HWY_EXPORT(any_hit);
HWY_EXPORT(each_hit);

bool find_first_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, MeshHit& hit) {
    return HWY_DYNAMIC_DISPATCH(first_hit)(tree, ray, undecided, hit);
}

bool find_any_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, bool& found) {
    return HWY_DYNAMIC_DISPATCH(any_hit)(tree, ray, undecided, found);
}

bool find_each_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided,
                   const MeshHitCall& visit) {
    return HWY_DYNAMIC_DISPATCH(each_hit)(tree, ray, undecided, visit);
}

}  // namespace abut::detail
#endif
