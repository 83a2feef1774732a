// Ray traversal of a mesh's tree: conservative float tests of boxes and triangles in SIMD, then decisions in double.
// Included once for each Highway target.

#if defined(ABUT_MESH_RAYS) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MESH_RAYS
#undef ABUT_MESH_RAYS
#else
#define ABUT_MESH_RAYS
#endif

#include <abut/convex/ray/triangle.hpp>
#include <abut/math/simd/compiler-inl.h>
#include <abut/shape/mesh/ray_tests_simd-inl.h>
#include <abut/shape/mesh/traversal_stack_simd-inl.h>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// Calls search(leaf, test, max_time) for the leaves within reach. It may reduce the time, and returns true to stop.
/// Returns false, without a call, if the numbers exceed the range of floats.
template <class Search>
HWY_INLINE bool traverse(const MeshTree& tree, const LocalRay& local, Search& search) {
    const Ray3& ray = local.ray;
    // The reach is limited to the mesh, since rounding bounds grow with it.
    const DVec<3> to_middle = DVec<3>(ray.origin) - tree.middle;
    const double beyond = std::abs(to_middle.x) + std::abs(to_middle.y) + std::abs(to_middle.z) + tree.spread;
    if (!(beyond < max_mesh_extent)) return false;
    const double reach = std::min(static_cast<double>(ray.length), 2 * beyond);
    if (!(reach >= 0)) return true;
    // The fourth lanes are the next members of the ray.
    const lanes::Floats4 origin = lanes::at(&ray.origin.x), direction = lanes::at(&ray.direction.x);
    const RayBoxTest hits_boxes(origin, direction, static_cast<float>(local.origin_error));
    const RayTriangleTest hits_triangles(origin, direction, local);
    const TreeAddresses addresses(tree);
    typename Search::Stack stack;
    float max_time = rounded_up(reach) * time_margin, times[mesh_lanes];
    std::uint32_t ref = tree.root(0).ref;
    for (;;) {
        if (is_leaf(ref)) {
            if (ref == bvh_none) return true;
            if (search(addresses.leaf(ref), hits_triangles, max_time)) return true;
            ref = stack.pop(addresses, max_time);
        } else {
            const MeshNode& node = addresses.node(ref);
            prefetch(node.child);  // it is on another cache line and is needed after the boxes
            const std::uint32_t bits = hits_boxes(node, max_time, times);
            ref = stack.descend(addresses, node, bits, times, max_time);
        }
    }
}

/// Vertices of the mesh relative to the ray's origin.
struct ToRayByMap {
    const Affine<3>& place;

    HWY_INLINE DVec<3> operator()(const DVec<3>& corner) const { return place.point(corner); }
};
struct ToRayByOffset {
    const DVec<3>& origin;

    HWY_INLINE DVec<3> operator()(const DVec<3>& corner) const { return corner - origin; }
};

/// Decides in double whether and where the ray hits a triangle before `max_length`.
template <class ToRay>
class TriangleTest {
public:
    HWY_INLINE TriangleTest(const MeshRay& ray, const ToRay& to_ray, const RobustTriangleTest& undecided)
        : direction_(ray.world.direction),
          facing_sign_(ray.local.facing_sign),
          to_ray_(to_ray),
          undecided_(undecided) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, std::uint32_t lane, double max_length, RayEntry<3>& entry) const {
        const std::uint32_t numbers = leaf.triangle[lane];
        const auto corner = [&](std::uint32_t number) HWY_ATTR {
            return to_ray_({leaf.corner[0][number], leaf.corner[1][number], leaf.corner[2][number]});
        };
        const DVec<3> a = corner(numbers & 7u), b = corner(numbers >> 3 & 7u), c = corner(numbers >> 6 & 7u);
        if (facing_sign_ != 0 && !(dot(cross(b - a, c - a), direction_) * facing_sign_ < 0)) return false;
        const RayAnswer answer = decide_triangle(direction_, max_length, a, b, c, entry);
        if (answer != RayAnswer::undecided) return answer == RayAnswer::enters;
        // The address of `entry` stays here, so that it lives in registers.
        RayEntry<3> robust;
        const bool hits = undecided_(leaf.at(lane), max_length, robust);
        entry = robust;
        return hits;
    }

private:
    const DVec<3>& direction_;
    double facing_sign_;
    ToRay to_ray_;
    const RobustTriangleTest& undecided_;
};

/// Finds the first hit.
template <class Test>
class FirstHitSearch {
public:
    using Stack = NearestFirstStack;

    HWY_INLINE FirstHitSearch(const MeshTree& tree, const MeshRay& ray, const Test& test, MeshHit& hit)
        : tree_(tree), test_(test), hit_(hit), unit_(ray.unit * time_margin), reach_(ray.world.length) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, const RayTriangleTest& hits_triangles, float& max_time) {
        std::uint32_t bits = hits_triangles.possible(leaf);
        // The triangle's index is needed after a hit.
        if (bits != 0) prefetch(&tree_.order[leaf.first]);
        while (bits != 0) {
            const std::uint32_t lane = next_lane(bits);
            const std::uint32_t& index = tree_.order[leaf.first + lane];
            RayEntry<3> found;
            if (!test_(leaf, lane, reach_, found)) continue;
            if (hit_.triangle != nullptr && !(found.along < hit_.entry.along) && !(index < *hit_.triangle)) continue;
            hit_.entry = found;
            hit_.triangle = &index;
            reach_ = found.along;
            max_time = std::min(max_time, rounded_up(reach_ * unit_));
        }
        return false;
    }

private:
    const MeshTree& tree_;
    const Test& test_;
    MeshHit& hit_;
    double unit_, reach_;
};

/// Visits the hits; `visit` returns the new reach.
template <class Test>
class EachHitSearch {
public:
    using Stack = NearestFirstStack;

    HWY_INLINE EachHitSearch(const MeshTree& tree, const MeshRay& ray, const Test& test, const MeshHitCall& visit)
        : tree_(tree), test_(test), visit_(visit), unit_(ray.unit * time_margin), reach_(ray.world.length) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, const RayTriangleTest& hits_triangles, float& max_time) {
        for (std::uint32_t bits = hits_triangles.possible(leaf); bits != 0;) {
            const std::uint32_t lane = next_lane(bits);
            RayEntry<3> found;
            if (!test_(leaf, lane, reach_, found)) continue;
            reach_ = visit_(found, tree_.order[leaf.first + lane]);
            if (reach_ < 0) return true;
            max_time = std::min(max_time, rounded_up(reach_ * unit_));
        }
        return false;
    }

private:
    const MeshTree& tree_;
    const Test& test_;
    const MeshHitCall& visit_;
    double unit_, reach_;
};

/// Finds whether there is a hit. The exact test `test(leaf, lane)` is only for triangles that the float test leaves
/// open.
template <class Test>
class AnyHitSearch {
public:
    using Stack = LaneOrderStack;

    explicit HWY_INLINE AnyHitSearch(const Test& test) : test_(test) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, const RayTriangleTest& hits_triangles, float& max_time) {
        const LeafHits hits = hits_triangles.proven(leaf, max_time);
        found_ = hits.proven != 0 || (hits.possible != 0 && decide(leaf, hits.possible));
        return found_;
    }
    bool found() const { return found_; }

private:
    HWY_NOINLINE bool decide(const MeshLeaf& leaf, std::uint32_t bits) const {
        while (bits != 0)
            if (test_(leaf, next_lane(bits))) return true;
        return false;
    }

    const Test& test_;
    bool found_ = false;
};

template <class Test>
HWY_INLINE bool find_first(const MeshTree& tree, const MeshRay& ray, const Test& test, MeshHit& hit) {
    FirstHitSearch<Test> search(tree, ray, test, hit);
    return traverse(tree, ray.local, search);
}
template <class Test>
HWY_INLINE bool find_each(const MeshTree& tree, const MeshRay& ray, const Test& test, const MeshHitCall& visit) {
    EachHitSearch<Test> search(tree, ray, test, visit);
    return traverse(tree, ray.local, search);
}
template <class Test>
HWY_INLINE bool find_any(const MeshTree& tree, const LocalRay& ray, const Test& test, bool& found) {
    AnyHitSearch<Test> search(test);
    if (!traverse(tree, ray, search)) return false;
    found = search.found();
    return true;
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
