// Ray traversal of a mesh's tree: conservative float tests of boxes and triangles in SIMD, then decisions in double.
// Included once for each Highway target.

#if defined(ABUT_MESH_RAYS) == defined(HWY_TARGET_TOGGLE)
#ifdef ABUT_MESH_RAYS
#undef ABUT_MESH_RAYS
#else
#define ABUT_MESH_RAYS
#endif

#include <abut/convex/ray/triangle.hpp>
#include <abut/math/simd/float4-inl.h>
#include <abut/shape/mesh/rays.hpp>
#include <abut/shape/mesh/triangle_simd-inl.h>

#include <bit>
#include <cstring>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

/// A vector in float, with a fourth lane.
HWY_INLINE float4::Floats to_floats(const DVec<3>& v, float fourth) {
    return float4::Floats{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z), fourth};
}

/// Slab test of a ray against eight boxes. The boxes are padded, and each slab is widened by the error of the ray's
/// origin.
class RayBoxTest {
public:
    HWY_INLINE RayBoxTest(float4::Floats origin, float4::Floats direction, float origin_error) {
        constexpr std::int32_t sign_bit = std::numeric_limits<std::int32_t>::min();
        const float4::Mask sign = std::bit_cast<float4::Mask>(direction) & sign_bit;
        const auto with_sign = [&](float4::Floats v) HWY_ATTR {
            return std::bit_cast<float4::Floats>(std::bit_cast<float4::Mask>(v) | sign);
        };
        const float4::Floats error = with_sign(float4::magnitude(origin) * 0x1p-23f + origin_error);
        const float4::Floats near_origin = origin + error, far_origin = origin - error;
        // A direction component near 0 is replaced, so that every finite time is far enough and 0 times it isn't NaN.
        const float4::Floats near_factor =
            -1.0f / with_sign(float4::max(float4::magnitude(direction), float4::broadcast(1e-30f)));
        const float4::Floats far_factor = near_factor * tolerance;
        const std::size_t signs = float4::bits(sign);
        for (std::size_t i = 0; i < 3; ++i) {
            near_origin_[i] = hn::Set(bvh_tag, near_origin[i]);
            far_origin_[i] = hn::Set(bvh_tag, far_origin[i]);
            near_factor_[i] = hn::Set(bvh_tag, near_factor[i]);
            far_factor_[i] = hn::Set(bvh_tag, far_factor[i]);
            const std::size_t is_backwards = signs >> i & 1;
            near_row_[i] = mesh_lanes * (i + 3 * is_backwards);
            far_row_[i] = mesh_lanes * (2 * i + 3) - near_row_[i];
        }
    }

    /// The boxes that the ray may hit, one bit each, and the times of entry.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float max_time, float (&times)[mesh_lanes]) const {
        const float* const rows = node.min[0];
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const auto enters = [&](int i) {
                return hn::Mul(hn::Sub(near_origin_[i], hn::Load(bvh_tag, rows + near_row_[i] + lane)),
                               near_factor_[i]);
            };
            const auto leaves = [&](int i) {
                return hn::Mul(hn::Sub(far_origin_[i], hn::Load(bvh_tag, rows + far_row_[i] + lane)), far_factor_[i]);
            };
            const V from = hn::Max(hn::Max(enters(0), hn::Zero(bvh_tag)), hn::Max(enters(1), enters(2)));
            const V to = hn::Min(hn::Min(leaves(0), hn::Set(bvh_tag, max_time)), hn::Min(leaves(1), leaves(2)));
            result |= bits_of(hn::Le(from, to)) << lane;
            hn::StoreU(hn::Add(from, hn::Zero(bvh_tag)), bvh_tag, times + lane);  // turns -0 into 0
        }
        return result;
    }

private:
    /// More than twice five float roundings.
    static constexpr float tolerance = 1 + 1e-6f;

    V near_origin_[3], far_origin_[3];  ///< seen from the plane of a box, times a factor, they give the time
    V near_factor_[3], far_factor_[3];  ///< minus the inverse of the direction; the far one is longer by the tolerance
    std::size_t near_row_[3], far_row_[3];
};

/// Conservative test of a ray against the triangles of a leaf: projected along the ray, a triangle is hit if it
/// contains the origin. Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), here with error bounds.
class RayTriangleTest {
public:
    /// `beyond` bounds the distance (sum of magnitudes) of a corner from the ray's origin, which was rounded by
    /// `rounded` along each axis.
    HWY_INLINE RayTriangleTest(float4::Floats origin, float4::Floats direction, float beyond, float rounded) {
        HWY_ALIGN float from[4], along[4];
        std::memcpy(from, &origin, sizeof(from));
        std::memcpy(along, &direction, sizeof(along));
        // The dominant axis of the direction, by arithmetic since a branch is unpredictable, and the other two.
        const float4::Floats size = float4::magnitude(direction);
        const float x = size[0], y = size[1], z = size[2];
        const auto beyond_x = static_cast<unsigned>(y > x), is_z = static_cast<unsigned>(z > std::max(x, y));
        row_[2] = beyond_x + (2 - beyond_x) * is_z;
        row_[0] = row_[2] + 1 - 3 * (row_[2] >> 1);
        row_[1] = 3 - row_[0] - row_[2];
        const float inverse = 1 / along[row_[2]];
        for (int i = 0; i < 3; ++i) origin_[i] = hn::Set(bvh_tag, from[row_[i]]);
        for (int i = 0; i < 2; ++i) slope_[i] = hn::Set(bvh_tag, along[row_[i]] * inverse);
        corner_error_ = 0x1.4p-21f * beyond + 2 * rounded;
    }

    /// The triangles of a leaf that the line may pass through, one bit each.
    ///
    /// With u = 2^-24 and |.| the sum of the coordinates' magnitudes, the projection of a corner is off by at most 8 u
    /// |corner - origin|. The line passes the leaf's box, so projected corners are no farther from it than the box is
    /// wide; the product of two such coordinates is off by less than six times the product of extent and error.
    HWY_INLINE std::uint32_t operator()(const MeshLeaf& leaf) const {
        const V upper = hn::Set(bvh_tag, 8 * corner_error_ * (leaf.extent + corner_error_)), lower = hn::Neg(upper);
        std::uint32_t result = 0;
        LeafRows<2> places;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V along = from_origin(leaf, 2, lane);
            for (int i = 0; i < 2; ++i)
                places.set(i, lane, hn::Sub(from_origin(leaf, i, lane), hn::Mul(along, slope_[i])));
        }
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
    return static_cast<StackEntry>(std::bit_cast<std::uint32_t>(time)) << 32 | ref;
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
    const auto* const node = reinterpret_cast<const char*>(tree.nodes.data() + ref);
    const auto* const leaf = reinterpret_cast<const char*>(tree.leaves.data() + (ref & ~detail::bvh_leaf_bit));
    const char* const bytes = is_leaf(ref) ? leaf : node;
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
HWY_INLINE bool traverse(const MeshTree& tree, const MeshRay& ray, OnCandidate on_candidate) {
    // The reach is limited to the mesh, since rounding bounds grow with it.
    const DVec<3> to_middle = ray.local.origin - tree.middle;
    const double beyond = std::abs(to_middle.x) + std::abs(to_middle.y) + std::abs(to_middle.z) + tree.spread;
    if (!(beyond < max_mesh_extent)) return false;
    const double reach = std::min(ray.local.length, 2 * beyond);
    if (!(reach >= 0)) return true;
    const double unit = ray.unit * reach_tolerance;
    const float4::Floats origin = to_floats(ray.local.origin, 0), direction = to_floats(ray.local.direction, 1);
    const RayBoxTest hits_boxes(origin, direction, static_cast<float>(ray.origin_error));
    const double rounded = ray.origin_error + 0x1p-24 * (beyond + tree.off_center);
    const RayTriangleTest hits_triangles(origin, direction, static_cast<float>(beyond), static_cast<float>(rounded));
    // The first entry ends the search.
    StackEntry entries[max_stack_size + 1];
    entries[0] = 0;
    StackEntry* stack = entries + 1;
    float max_time = rounded_up(reach * reach_tolerance), times[mesh_lanes];
    StackEntry limit = stack_entry(max_time, 0xFFFFFFFF);
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
                limit = stack_entry(max_time, 0xFFFFFFFF);
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
        while (*--stack > limit) {
        }
        if (stack == entries) return true;
        ref = static_cast<std::uint32_t>(*stack);
        prefetch(tree, stack[-1]);
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
        : direction_(ray.world.direction), facing_sign_(ray.facing_sign), to_ray_(to_ray), undecided_(undecided) {}

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

template <class Test>
HWY_INLINE bool find_first(const MeshTree& tree, const MeshRay& ray, const Test& test, MeshHit& hit) {
    double reach = ray.world.length;
    return traverse(
        tree,
        ray, [&](const MeshLeaf& leaf, std::uint32_t lane, const std::uint32_t& index) __attribute__((always_inline)) {
            RayEntry<3> found;
            if (test(leaf, lane, reach, found) &&
                (hit.triangle == nullptr || found.along < hit.entry.along || index < *hit.triangle)) {
                hit.entry = found;
                hit.triangle = &index;
                reach = found.along;
            }
            return reach;
        });
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
