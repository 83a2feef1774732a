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
bool find_each(const MeshTree& tree, const MeshRay& ray, const Test& test, const MeshHitCall& visit) {
    RayEntry<3> found;
    double reach = ray.world.length;
    return traverse(tree, ray, [&](const MeshLeaf& leaf, std::uint32_t lane, const std::uint32_t& index) {
        if (test(leaf, lane, reach, found)) reach = visit(found, index);
        return reach;
    });
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
HWY_EXPORT(each_hit);

bool find_first_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided, MeshHit& hit) {
    return HWY_DYNAMIC_DISPATCH(first_hit)(tree, ray, undecided, hit);
}

bool find_each_hit(const MeshTree& tree, const MeshRay& ray, const RobustTriangleTest& undecided,
                   const MeshHitCall& visit) {
    return HWY_DYNAMIC_DISPATCH(each_hit)(tree, ray, undecided, visit);
}

}  // namespace abut::detail
#endif
