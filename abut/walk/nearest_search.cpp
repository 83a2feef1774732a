// Traverses the tree of a mesh nearest first. Boxes are tested in float with a lower bound of their distance, all
// triangles of a leaf at once in double. Highway compiles this file once for each instruction set and chooses the best
// one at run time.

#include <abut/math/simd/compiler-inl.h>
#include <abut/walk/nearest_search.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/walk/nearest_search.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh/triangle_simd-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::detail::HWY_NAMESPACE {

using Doubles = hn::CappedTag<double, bvh_step>;
constexpr Doubles doubles;
constexpr std::uint32_t double_step = hn::MaxLanes(doubles);
using W = hn::Vec<Doubles>;

struct W3 {
    W x, y, z;
};
HWY_INLINE W3 plus(const W3& a, const W3& b) {
    return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE W3 minus(const W3& a, const W3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE W3 times(const W3& v, W factor) {
    return {hn::Mul(v.x, factor), hn::Mul(v.y, factor), hn::Mul(v.z, factor)};
}
HWY_INLINE W3 cross(const W3& a, const W3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE W dot(const W3& a, const W3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE W widened(const float* numbers) {
    return hn::PromoteTo(doubles, hn::Load(hn::Rebind<float, Doubles>(), numbers));
}
template <class Tag>
HWY_INLINE std::uint32_t mask_bits(Tag tag, hn::Mask<Tag> mask) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(tag, mask, bytes);
    return bytes[0];
}

/// One corner of each of several triangles.
class Corners {
public:
    HWY_INLINE explicit Corners(const V3& v) {
        hn::Store(v.x, bvh_tag, at_[0]);
        hn::Store(v.y, bvh_tag, at_[1]);
        hn::Store(v.z, bvh_tag, at_[2]);
    }
    HWY_INLINE W3 from(std::uint32_t lane) const {
        return {widened(at_[0] + lane), widened(at_[1] + lane), widened(at_[2] + lane)};
    }

private:
    HWY_ALIGN float at_[3][bvh_step];
};

HWY_INLINE W squared_distance_to_edge(const W3& start, const W3& end, const W3& edge) {
    const W one = hn::Set(doubles, 1.0);
    const W3 both = plus(start, end);
    const W along = hn::Min(hn::Max(hn::Div(dot(both, edge), dot(edge, edge)), hn::Neg(one)), one);
    const W3 twice = minus(both, times(edge, along));
    return dot(twice, twice);
}

/// The same operations as in `nearest_on`.
HWY_INLINE W squared_distances(const W3& a, const W3& b, const W3& c, const W3& point) {
    const W zero = hn::Zero(doubles);
    const W3 from_a = minus(a, point), from_b = minus(b, point), from_c = minus(c, point);
    const W3 ab = minus(b, a), ac = minus(c, a), bc = minus(c, b);
    const W to_ab = squared_distance_to_edge(from_a, from_b, ab), to_bc = squared_distance_to_edge(from_b, from_c, bc);
    const W to_edges = hn::Min(hn::Min(to_ab, to_bc), squared_distance_to_edge(from_a, from_c, ac));
    const W3 normal = cross(ab, ac), twisted = cross(from_a, normal);
    const W total = dot(normal, normal), second = dot(ac, twisted), third = hn::Neg(dot(ab, twisted));
    const auto inside = hn::And(hn::And(hn::Gt(second, zero), hn::Gt(third, zero)),
                                hn::Gt(hn::Sub(hn::Sub(total, second), third), zero));
    const W inverse = hn::Div(hn::Set(doubles, 1.0), total);
    const W3 there = plus(plus(from_a, times(ab, hn::Mul(second, inverse))), times(ac, hn::Mul(third, inverse)));
    const W to_inside = hn::Mul(hn::Set(doubles, 4.0), dot(there, there));
    return hn::IfThenElse(inside, hn::Min(to_inside, to_edges), to_edges);
}

/// Squared box distances in float. With `limit` they are lower bounds, because boxes are wider than their contents by
/// far more than the rounding of a triangle's distance.
class FloatBoxes {
public:
    using Number = float;

    explicit FloatBoxes(const Vec3& point) : point_(point) {}

    /// True if float resolves the boxes from this point and can hold the squares.
    static bool suits(const MeshTree& tree, const Vec3& point) {
        const DVec<3> to_middle = DVec<3>(point) - tree.middle;
        return tree.spread > 1e-9 && tree.spread < max_mesh_extent && largest(to_middle) < 4 * tree.spread;
    }

    static float limit(double square) {
        return square < 1e37 ? rounded_up(square) : std::numeric_limits<float>::infinity();
    }
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float limit, float (&squares)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const auto row = [&](const float* numbers) { return hn::Load(bvh_tag, numbers + lane); };
            V sum = hn::Zero(bvh_tag);
            for (int i = 0; i < 3; ++i) {
                const V at = hn::Set(bvh_tag, point_[i]);
                const V below = hn::Sub(row(node.min[i]), at), above = hn::Sub(at, row(node.max[i]));
                const V gap = hn::Max(hn::Max(below, above), hn::Zero(bvh_tag));
                sum = hn::Add(sum, hn::Mul(gap, gap));
            }
            const auto used = hn::Le(row(node.min[0]), row(node.max[0]));
            result |= bits_of(hn::And(used, hn::Le(sum, hn::Set(bvh_tag, limit)))) << lane;
            hn::Store(sum, bvh_tag, squares + lane);
        }
        return result;
    }

private:
    Vec3 point_;
};

/// Squared box distances in double, for any size and distance.
class DoubleBoxes {
public:
    using Number = double;

    explicit DoubleBoxes(const Vec3& point) : point_(point) {}

    /// The factor is twice the rounding of a box and a triangle.
    static double limit(double square) { return square * (1 + 0x1p-48); }
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, double limit, double (&squares)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += double_step) {
            W sum = hn::Zero(doubles);
            for (int i = 0; i < 3; ++i) {
                const W at = hn::Set(doubles, point_[i]);
                const W below = hn::Sub(widened(node.min[i] + lane), at);
                const W above = hn::Sub(at, widened(node.max[i] + lane));
                const W gap = hn::Max(hn::Max(below, above), hn::Zero(doubles));
                sum = hn::Add(sum, hn::Mul(gap, gap));
            }
            const auto used = hn::Le(widened(node.min[0] + lane), widened(node.max[0] + lane));
            result |= mask_bits(doubles, hn::And(used, hn::Le(sum, hn::Set(doubles, limit)))) << lane;
            hn::Store(sum, doubles, squares + lane);
        }
        return result;
    }

private:
    DVec<3> point_;
};

template <class Boxes>
class Search {
public:
    Search(const MeshTree& tree, const Vec3& point, NearestTriangle& nearest)
        : tree_(tree), point_(point), boxes_(point), nearest_(nearest) {
        set_limit();
    }

    void test_leaf(std::uint32_t number) {
        const MeshLeaf& leaf = tree_.leaves[number];
        const W3 point{hn::Set(doubles, point_.x), hn::Set(doubles, point_.y), hn::Set(doubles, point_.z)};
        const W best = hn::Set(doubles, nearest_.square);
        HWY_ALIGN double squares[mesh_lanes];
        std::uint32_t bits = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const Corners a(numbers.pick<0>(leaf.corner)), b(numbers.pick<1>(leaf.corner)),
                c(numbers.pick<2>(leaf.corner));
            for (std::uint32_t part = 0; part < bvh_step && leaf.used >> (lane + part) != 0; part += double_step) {
                const W found = squared_distances(a.from(part), b.from(part), c.from(part), point);
                hn::Store(found, doubles, squares + lane + part);
                bits |= mask_bits(doubles, hn::Le(found, best)) << (lane + part);
            }
        }
        bits &= leaf.used;
        if (bits == 0) return;
        while (bits != 0) {
            const std::uint32_t lane = next_lane(bits), triangle = tree_.order[leaf.first + lane];
            const double square = squares[lane];
            if (square < nearest_.square || (square == nearest_.square && triangle < nearest_.triangle))
                nearest_ = {square, triangle, number, lane};
        }
        set_limit();
    }

    /// Starts at the root; `tested` is a leaf that was tested before.
    void traverse(std::uint32_t tested) {
        StackEntry stack[max_stack_size];
        std::size_t stack_size = 0;
        stack[stack_size++] = {0, tree_.root(0).ref};
        while (stack_size > 0) {
            StackEntry next = stack[--stack_size];
            while (next.square <= limit_ && !is_leaf(next.ref)) next = nearest_child(next.ref, stack, stack_size);
            const std::uint32_t leaf = next.ref & ~detail::bvh_leaf_bit;
            if (next.square <= limit_ && leaf != tested) test_leaf(leaf);
        }
    }

private:
    using Number = typename Boxes::Number;
    struct StackEntry {
        Number square;
        std::uint32_t ref;
    };

    void set_limit() { limit_ = Boxes::limit(0.25 * nearest_.square); }

    /// Pushes the other children. If no child is within the limit, the result is an entry that never passes it.
    HWY_INLINE StackEntry nearest_child(std::uint32_t ref, StackEntry* stack, std::size_t& stack_size) const {
        const MeshNode& node = tree_.node(ref);
        prefetch(node.child);  // stored apart from the boxes, and needed right after them
        HWY_ALIGN Number squares[mesh_lanes];
        std::uint32_t bits = boxes_(node, limit_, squares);
        if (bits == 0) return {std::numeric_limits<Number>::quiet_NaN(), detail::bvh_none};
        const auto next_child = [&]() -> StackEntry {
            const std::uint32_t lane = next_lane(bits);
            return {squares[lane], node.child[lane]};
        };
        StackEntry nearest = next_child();
        while (bits != 0) {
            const StackEntry other = next_child();
            const bool is_nearer = other.square < nearest.square;
            stack[stack_size++] = is_nearer ? nearest : other;
            nearest = is_nearer ? other : nearest;
        }
        return nearest;
    }

    const MeshTree& tree_;
    DVec<3> point_;
    Boxes boxes_;
    NearestTriangle& nearest_;
    Number limit_ = 0;
};

template <class Boxes>
void search_with(const MeshTree& tree, const Vec3& point, std::uint32_t first_leaf, NearestTriangle& nearest) {
    Search<Boxes> search(tree, point, nearest);
    if (first_leaf != NearestTriangle::none) search.test_leaf(first_leaf);
    search.traverse(first_leaf);
}

void search(const MeshTree& tree, const Vec3& point, std::uint32_t first_leaf, NearestTriangle& nearest) {
    if (FloatBoxes::suits(tree, point))
        search_with<FloatBoxes>(tree, point, first_leaf, nearest);
    else
        search_with<DoubleBoxes>(tree, point, first_leaf, nearest);
}

}  // namespace abut::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut::detail {

HWY_EXPORT(search);

void find_nearest(const MeshTree& tree, const Vec3& point, std::uint32_t first_leaf, NearestTriangle& nearest) {
    HWY_DYNAMIC_DISPATCH(search)(tree, point, first_leaf, nearest);
}

}  // namespace abut::detail
#endif
