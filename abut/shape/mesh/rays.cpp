// Ray traversal of a mesh's tree: conservative float tests of boxes and triangles in SIMD, then decisions in double.
// Compiled for each SIMD target by Highway, which selects one at run time.

#include <abut/convex/ray/triangle.hpp>
#include <abut/shape/mesh/rays.hpp>

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh/rays.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/triangle_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// Slab test of a ray against eight boxes; the boxes are padded by the error of the ray's origin.
class RayBoxTest {
public:
    HWY_INLINE RayBoxTest(const DRay<3>& line, double origin_error) {
        for (int i = 0; i < 3; ++i) {
            const float origin = static_cast<float>(line.origin[i]), along = static_cast<float>(line.direction[i]);
            const float wider = static_cast<float>(origin_error) + std::abs(origin) * 0x1p-23f;
            to_low_[i] = hn::Set(bvh_tag, origin + wider);
            to_high_[i] = hn::Set(bvh_tag, origin - wider);
            // A direction component near 0 is replaced, so that every finite time is far enough and 0 times it isn't
            // NaN.
            negated_inverse_direction_[i] =
                hn::Set(bvh_tag, -1 / std::copysign(std::max(std::abs(along), 1e-30f), along));
        }
    }

    /// The boxes that the ray may hit, one bit each, and the times of entry.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float max_time, float (&times)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V x[2] = {low(node, 0, lane), high(node, 0, lane)}, y[2] = {low(node, 1, lane), high(node, 1, lane)},
                    z[2] = {low(node, 2, lane), high(node, 2, lane)};
            const V from = hn::Max(hn::Max(hn::Min(x[0], x[1]), hn::Zero(bvh_tag)),
                                   hn::Max(hn::Min(y[0], y[1]), hn::Min(z[0], z[1])));
            const V to = hn::Min(hn::Min(hn::Max(x[0], x[1]), hn::Set(bvh_tag, max_time)),
                                 hn::Min(hn::Max(y[0], y[1]), hn::Max(z[0], z[1])));
            const auto children = hn::Load(child_tag, node.child + lane);
            const auto used = hn::RebindMask(bvh_tag, hn::Ne(children, hn::Set(child_tag, detail::bvh_none)));
            result |= bits_of(hn::And(used, hn::Le(from, hn::Mul(to, hn::Set(bvh_tag, tolerance))))) << lane;
            hn::StoreU(from, bvh_tag, times + lane);
        }
        return result;
    }

private:
    static constexpr hn::RebindToUnsigned<BvhVectorTag> child_tag{};

    /// More than twice five float roundings.
    static constexpr float tolerance = 1 + 1e-6f;

    HWY_INLINE V low(const MeshNode& node, int axis, std::uint32_t lane) const {
        return hn::Mul(hn::Sub(to_low_[axis], hn::Load(bvh_tag, node.min[axis] + lane)),
                       negated_inverse_direction_[axis]);
    }
    HWY_INLINE V high(const MeshNode& node, int axis, std::uint32_t lane) const {
        return hn::Mul(hn::Sub(to_high_[axis], hn::Load(bvh_tag, node.max[axis] + lane)),
                       negated_inverse_direction_[axis]);
    }

    V to_low_[3], to_high_[3], negated_inverse_direction_[3];  ///< multiplied by (origin - plane) it gives the time
};

/// Conservative test of a ray against the triangles of a leaf: projected along the ray, a triangle is hit if it
/// contains the origin. Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), here with error bounds.
class RayTriangleTest {
public:
    /// `beyond` bounds the distance (sum of magnitudes) of a corner from the ray's origin, which was rounded by
    /// `rounded` along each axis.
    HWY_INLINE RayTriangleTest(const DRay<3>& line, double beyond, double rounded) {
        const double origin[3] = {line.origin.x, line.origin.y, line.origin.z};
        const double direction[3] = {line.direction.x, line.direction.y, line.direction.z};
        // The dominant axis of the direction, by arithmetic since a branch is unpredictable, and the other two.
        const double x = std::abs(direction[0]), y = std::abs(direction[1]), z = std::abs(direction[2]);
        const auto beyond_x = static_cast<unsigned>(y > x), is_z = static_cast<unsigned>(z > std::max(x, y));
        row_[2] = beyond_x + (2 - beyond_x) * is_z;
        row_[0] = row_[2] + 1 - 3 * (row_[2] >> 1);
        row_[1] = 3 - row_[0] - row_[2];
        for (int i = 0; i < 3; ++i) origin_[i] = hn::Set(bvh_tag, static_cast<float>(origin[row_[i]]));
        const double inverse = 1 / direction[row_[2]];
        for (int i = 0; i < 2; ++i) slope_[i] = hn::Set(bvh_tag, static_cast<float>(direction[row_[i]] * inverse));
        corner_error_ = static_cast<float>(8 * 0x1p-24 * beyond + 2 * rounded);
    }

    /// The triangles of a leaf that the line may pass through, one bit each.
    ///
    /// With u = 2^-24 and |.| the sum of the coordinates' magnitudes, the projection of a corner is off by at most 4 u
    /// |corner - origin|. The line passes the leaf's box, so projected corners are no farther from it than the box is
    /// wide; the product of two such coordinates is off by less than six times the product of extent and error.
    HWY_INLINE std::uint32_t operator()(const MeshLeaf& leaf) const {
        std::uint32_t result = 0;
        HWY_ALIGN float places[2][mesh_lanes];
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V along = from_origin(leaf, 2, lane);
            for (int i = 0; i < 2; ++i)
                hn::Store(hn::Sub(from_origin(leaf, i, lane), hn::Mul(along, slope_[i])), bvh_tag, places[i] + lane);
        }
        const V upper = hn::Set(bvh_tag, 8 * corner_error_ * (leaf.extent + corner_error_)), lower = hn::Neg(upper);
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V2 a = numbers.pick<0>(places), b = numbers.pick<1>(places), c = numbers.pick<2>(places);
            const V ab = signed_area(a, b), bc = signed_area(b, c), ca = signed_area(c, a);
            // Written so that a NaN excludes no triangle.
            const auto outside =
                hn::And(hn::Lt(hn::Min(hn::Min(ab, bc), ca), lower), hn::Gt(hn::Max(hn::Max(ab, bc), ca), upper));
            result |= bits_of(outside) << lane;
        }
        return leaf.used & ~result;
    }

private:
    HWY_INLINE V from_origin(const MeshLeaf& leaf, int i, std::uint32_t lane) const {
        return hn::Sub(hn::Load(bvh_tag, leaf.corner[row_[i]] + lane), origin_[i]);
    }
    static HWY_INLINE V signed_area(const V2& a, const V2& b) { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)); }

    unsigned row_[3];  ///< rows of the corners: the two axes across and the one along
    V origin_[3], slope_[2];
    float corner_error_;  ///< error bound of a projected corner
};

/// An entry of the traversal stack: the entry time in the upper half, since bits of non-negative floats are ordered,
/// and the node reference in the lower half.
using StackEntry = std::uint64_t;

HWY_INLINE StackEntry stack_entry(float time, std::uint32_t ref) {
    constexpr std::uint32_t all_but_sign = 0x7FFFFFFF;  // the sign bit of -0
    return static_cast<StackEntry>(std::bit_cast<std::uint32_t>(time) & all_but_sign) << 32 | ref;
}
/// By arithmetic: the order is unpredictable, and compilers turn a choice into a branch.
HWY_INLINE void order_pair(StackEntry& first, StackEntry& second) {
    const StackEntry differ = (first ^ second) & (0 - static_cast<StackEntry>(second < first));
    first ^= differ;
    second ^= differ;
}

/// Prefetches a node or leaf that is likely to be visited soon.
HWY_INLINE void prefetch(const MeshTree& tree, StackEntry soon) {
    const auto ref = static_cast<std::uint32_t>(soon);
    const auto* bytes =
        is_leaf(ref) ? reinterpret_cast<const char*>(&tree.leaf(ref)) : reinterpret_cast<const char*>(&tree.node(ref));
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + 64);
}

/// Returns the nearest of a node's hit children and pushes the others, nearest on top.
HWY_INLINE StackEntry first_of(const MeshTree& tree, const MeshNode& node, std::uint32_t bits,
                               const float (&times)[mesh_lanes], StackEntry*& stack) {
    const auto next = [&] {
        const std::uint32_t lane = next_lane(bits);
        return stack_entry(times[lane], node.child[lane]);
    };
    StackEntry first = next();
    if (bits == 0) return first;
    StackEntry second = next();
    order_pair(first, second);
    if (bits == 0) {
        prefetch(tree, second);
        *stack++ = second;
        return first;
    }
    StackEntry third = next();
    order_pair(first, third);
    order_pair(second, third);
    StackEntry* const bottom = stack;
    *stack++ = third;
    while (bits != 0) {
        StackEntry other = next();
        order_pair(first, other);
        order_pair(second, other);
        StackEntry* place = stack++;
        for (; place > bottom && place[-1] < other; --place) *place = place[-1];
        *place = other;
    }
    prefetch(tree, second);
    *stack++ = second;
    return first;
}

/// `on_candidate(leaf, lane, index)` returns the new reach in world-space lengths. Returns false if the numbers exceed
/// the range of floats.
template <class OnCandidate>
bool traverse(const MeshTree& tree, const MeshRay& ray, OnCandidate on_candidate) {
    // The reach is limited to the mesh, since rounding bounds grow with it.
    const DVec<3> to_middle = ray.local.origin - tree.middle;
    const double beyond = std::abs(to_middle.x) + std::abs(to_middle.y) + std::abs(to_middle.z) + tree.spread;
    if (!(beyond < max_mesh_extent)) return false;
    const double reach = std::min(ray.local.length, 2 * beyond);
    if (!(reach >= 0)) return true;
    const double unit = ray.unit * reach_tolerance;
    const RayBoxTest hits_boxes(ray.local, ray.origin_error);
    const RayTriangleTest hits_triangles(ray.local, beyond, ray.origin_error + 0x1p-24 * (beyond + tree.off_center));
    StackEntry entries[max_stack_size];
    StackEntry* stack = entries;
    float max_time = rounded_up(reach * reach_tolerance), times[mesh_lanes];
    std::uint32_t ref = tree.root(0).ref;
    for (;;) {
        if (is_leaf(ref)) {
            const MeshLeaf& leaf = tree.leaf(ref);
            std::uint32_t bits = hits_triangles(leaf);
            // The triangle's index is needed after a hit.
            if (bits != 0) __builtin_prefetch(&tree.order[leaf.first]);
            while (bits != 0) {
                const std::uint32_t lane = next_lane(bits);
                const double new_reach = on_candidate(leaf, lane, tree.order[leaf.first + lane]);
                if (new_reach < 0) return true;
                max_time = std::min(max_time, rounded_up(new_reach * unit));
            }
        } else {
            const MeshNode& node = tree.node(ref);
            __builtin_prefetch(node.child);  // it is on another cache line and is needed after the boxes
            const std::uint32_t bits = hits_boxes(node, max_time, times);
            if (bits != 0) {
                ref = static_cast<std::uint32_t>(first_of(tree, node, bits, times, stack));
                continue;
            }
        }
        const StackEntry limit = stack_entry(max_time, 0xFFFFFFFF);
        do {
            if (stack == entries) return true;
            --stack;
        } while (*stack > limit);
        ref = static_cast<std::uint32_t>(*stack);
        if (stack != entries) prefetch(tree, stack[-1]);
    }
}

/// Vertices of the mesh relative to the ray's origin.
struct ToRayByMap {
    const Affine<3>& place;

    DVec<3> operator()(const Vec3& corner) const { return place.point(DVec<3>(corner)); }
};
struct ToRayByOffset {
    const DVec<3>& origin;

    DVec<3> operator()(const Vec3& corner) const { return DVec<3>(corner) - origin; }
};

/// Decides in double whether and where the ray hits a triangle before `max_length`.
template <class ToRay>
class TriangleTest {
public:
    TriangleTest(const MeshRay& ray, const ToRay& to_ray, const RobustTriangleTest& undecided)
        : direction_(ray.world.direction), facing_sign_(ray.facing_sign), to_ray_(to_ray), undecided_(undecided) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, std::uint32_t lane, double max_length, RayEntry<3>& entry) const {
        const Triangle3 triangle = leaf.at(lane);
        const DVec<3> a = to_ray_(triangle.a), b = to_ray_(triangle.b), c = to_ray_(triangle.c);
        if (facing_sign_ != 0 && !(dot(cross(b - a, c - a), direction_) * facing_sign_ < 0)) return false;
        const RayAnswer answer = decide_triangle(direction_, max_length, a, b, c, entry);
        if (answer == RayAnswer::undecided) return undecided_(leaf.at(lane), max_length, entry);
        return answer == RayAnswer::enters;
    }

private:
    const DVec<3>& direction_;
    double facing_sign_;
    ToRay to_ray_;
    const RobustTriangleTest& undecided_;
};

template <class Test>
bool find_first(const MeshTree& tree, const MeshRay& ray, const Test& test, MeshHit& hit) {
    RayEntry<3> found;
    double reach = ray.world.length;
    return traverse(tree, ray, [&](const MeshLeaf& leaf, std::uint32_t lane, const std::uint32_t& index) {
        if (test(leaf, lane, reach, found) &&
            (hit.triangle == nullptr || found.along < hit.entry.along || index < *hit.triangle)) {
            hit.entry = found;
            hit.triangle = &index;
            reach = found.along;
        }
        return reach;
    });
}

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
