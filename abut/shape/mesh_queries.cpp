// Queries of a mesh's tree. What a box overlaps or is near is told by the triangles' own boxes; what a line meets, by
// the triangles themselves, in float and never too little: Moeller, Trumbore, "Fast, minimum storage ray-triangle
// intersection" (1997), with bounds on what its roundings may amount to.
// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs.

#include <abut/math/dvec.hpp>
#include <abut/shape/mesh_tree.hpp>

#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh_queries.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/broad_phase/bvh_down-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

using V = BvhVector;

struct V3 {
    V x, y, z;
};
HWY_INLINE V3 minus(const V3& a, const V3& b) {
    return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
            hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V dot(const V3& a, const V3& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// The corners of as many triangles of a leaf as a vector holds, from one on.
class LeafCorners {
public:
    LeafCorners(const MeshLeaf& leaf, std::uint32_t lane) : leaf_(leaf) {
        const hn::Rebind<std::uint16_t, BvhVectorTag> narrow;
        numbers_ = hn::PromoteTo(tag, hn::LoadU(narrow, leaf.triangle + lane));
    }

    /// The first, second or third of each triangle.
    template <int which>
    HWY_INLINE V3 corner() const {
        auto wanted = numbers_;
        if constexpr (which > 0) wanted = hn::ShiftRight<3 * which>(numbers_);
        wanted = hn::And(wanted, hn::Set(tag, 7));
        if constexpr (bvh_step == mesh_lanes) {
            const auto indices = hn::IndicesFromVec(bvh_tag, wanted);
            return {hn::TableLookupLanes(hn::Load(bvh_tag, leaf_.corner[0]), indices),
                    hn::TableLookupLanes(hn::Load(bvh_tag, leaf_.corner[1]), indices),
                    hn::TableLookupLanes(hn::Load(bvh_tag, leaf_.corner[2]), indices)};
        } else {
            return {hn::GatherIndex(bvh_tag, leaf_.corner[0], wanted),
                    hn::GatherIndex(bvh_tag, leaf_.corner[1], wanted),
                    hn::GatherIndex(bvh_tag, leaf_.corner[2], wanted)};
        }
    }

private:
    static constexpr hn::RebindToSigned<BvhVectorTag> tag{};
    const MeshLeaf& leaf_;
    hn::Vec<hn::RebindToSigned<BvhVectorTag>> numbers_;
};

/// The boxes of a leaf's triangles, with their indices in the mesh.
struct LeafBoxes {
    const MeshTree& tree;

    BvhLeaf<3> operator()(std::uint32_t ref) const {
        const MeshLeaf& leaf = tree.leaf(ref);
        BvhLeaf<3> result;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafCorners corners(leaf, lane);
            const V3 a = corners.corner<0>(), b = corners.corner<1>(), c = corners.corner<2>();
            hn::Store(hn::Min(hn::Min(a.x, b.x), c.x), bvh_tag, result.min[0] + lane);
            hn::Store(hn::Min(hn::Min(a.y, b.y), c.y), bvh_tag, result.min[1] + lane);
            hn::Store(hn::Min(hn::Min(a.z, b.z), c.z), bvh_tag, result.min[2] + lane);
            hn::Store(hn::Max(hn::Max(a.x, b.x), c.x), bvh_tag, result.max[0] + lane);
            hn::Store(hn::Max(hn::Max(a.y, b.y), c.y), bvh_tag, result.max[1] + lane);
            hn::Store(hn::Max(hn::Max(a.z, b.z), c.z), bvh_tag, result.max[2] + lane);
        }
        for (std::uint32_t lane = 0; lane < leaf.count; ++lane) result.index[lane] = tree.order[leaf.first + lane];
        for (std::uint32_t lane = leaf.count; lane < mesh_lanes; ++lane) {
            result.clear(lane);
            result.index[lane] = bvh_none;
        }
        return result;
    }
};

/// A line as the nodes are asked for it. A point that may be anywhere in a box reaches the first side of another from
/// its near end and the second from its far one.
class LineLanes {
public:
    explicit LineLanes(const MovingBox<3>& point) {
        for (int i = 0; i < 3; ++i) {
            // Where it all but rests, no finite time is too late for it; and 0 times it is not NaN.
            constexpr double most = 1e30;
            const double inverse = std::clamp(1 / point.direction[i], -most, most);
            const bool downwards = inverse < 0;  // also of -0
            const double low = point.center[i] - point.half[i], high = point.center[i] + point.half[i];
            const float outer_low = static_cast<float>(low - std::abs(low) * outwards),
                        outer_high = static_cast<float>(high + std::abs(high) * outwards);
            near_origin_[i] = hn::Set(bvh_tag, downwards ? outer_low : outer_high);
            far_origin_[i] = hn::Set(bvh_tag, downwards ? outer_high : outer_low);
            near_inverse_[i] = hn::Set(bvh_tag, static_cast<float>(inverse * (1 - slack)));
            far_inverse_[i] = hn::Set(bvh_tag, static_cast<float>(inverse * (1 + slack)));
            near_row_[i] = static_cast<std::size_t>(downwards ? 3 + i : i) * mesh_lanes;
            far_row_[i] = static_cast<std::size_t>(downwards ? i : 3 + i) * mesh_lanes;
        }
    }

    /// Which boxes it may meet, a bit each, and when.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float most, float (&times)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const float* rows = node.min[0] + lane;
            const V x = first(rows, 0);
            const V from = hn::Max(hn::Max(x, hn::Zero(bvh_tag)), hn::Max(first(rows, 1), first(rows, 2)));
            const V to = hn::Min(hn::Min(last(rows, 0), hn::Set(bvh_tag, most)), hn::Min(last(rows, 1), last(rows, 2)));
            // An unused box is of NaN.
            result |= bits_of(hn::And(hn::Le(from, to), hn::Eq(x, x))) << lane;
            hn::StoreU(from, bvh_tag, times + lane);
        }
        return result;
    }

private:
    /// More than one rounding to float, and than three.
    static constexpr double outwards = 0x1p-23, slack = 4e-7;

    HWY_INLINE V first(const float* rows, int axis) const {
        return hn::Mul(hn::Sub(hn::Load(bvh_tag, rows + near_row_[axis]), near_origin_[axis]), near_inverse_[axis]);
    }
    HWY_INLINE V last(const float* rows, int axis) const {
        return hn::Mul(hn::Sub(hn::Load(bvh_tag, rows + far_row_[axis]), far_origin_[axis]), far_inverse_[axis]);
    }

    V near_origin_[3], far_origin_[3], near_inverse_[3], far_inverse_[3];
    std::size_t near_row_[3], far_row_[3];
};

/// A line as the triangles are asked for it.
class LineToTriangles {
public:
    explicit LineToTriangles(const MovingBox<3>& point) {
        const Vec3 from = to_float(point.center), along = to_float(point.direction);
        origin_ = {hn::Set(bvh_tag, from.x), hn::Set(bvh_tag, from.y), hn::Set(bvh_tag, from.z)};
        direction_ = {hn::Set(bvh_tag, along.x), hn::Set(bvh_tag, along.y), hn::Set(bvh_tag, along.z)};
        double astray = 0;
        for (int i = 0; i < 3; ++i) astray += point.half[i] + std::abs(static_cast<double>(from[i]) - point.center[i]);
        astray_ = static_cast<float>(astray * (1 + 1e-6) / doubt);
    }

    /// Which triangles of a leaf it may meet within reach, a bit each.
    ///
    /// With u = 2^-24, |.| the sum of the coordinates' magnitudes, and a direction of length 1, |d| < 1.74: the
    /// products of three below are off by 9 u times the three magnitudes at most. The reach is compared with a quotient
    /// and a side with a sum of two, and the sign of the divisor is not known if it is small; so four times that, 64 u.
    std::uint32_t operator()(const MeshLeaf& leaf, float most) const {
        const std::uint32_t all = (2u << (leaf.count - 1)) - 1;
        // Products that underflow, or overflow, have no such bound.
        if (!(leaf.extent > 1e-9f && leaf.extent < 1e12f)) return all;
        const V base = hn::Set(bvh_tag, leaf.extent + astray_);
        const V side_factor = hn::Set(bvh_tag, doubt * leaf.extent);
        const V time_factor = hn::Set(bvh_tag, doubt * leaf.extent * leaf.extent);
        const V reach = hn::Set(bvh_tag, most);
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafCorners corners(leaf, lane);
            const V3 a = corners.corner<0>();
            const V3 ab = minus(corners.corner<1>(), a), ac = minus(corners.corner<2>(), a);
            const V3 from_a = minus(origin_, a);
            const V3 across = cross(direction_, ac), turned = cross(from_a, ab);
            const V whole = dot(ab, across);
            const auto sign = hn::And(whole, hn::Set(bvh_tag, -0.0f));
            const V to_ac = hn::Xor(dot(from_a, across), sign), to_ab = hn::Xor(dot(direction_, turned), sign);
            const V time = hn::Xor(dot(ac, turned), sign), size = hn::Abs(whole);
            const V scale = hn::Add(hn::Add(hn::Add(hn::Abs(from_a.x), hn::Abs(from_a.y)), hn::Abs(from_a.z)), base);
            const V beside = hn::Mul(scale, side_factor), before = hn::Mul(hn::Add(scale, reach), time_factor);
            // Written so that NaN is no reason to leave out one.
            const auto outside =
                hn::Or(hn::Lt(hn::Min(hn::Add(to_ac, beside), hn::Add(to_ab, beside)), hn::Zero(bvh_tag)),
                       hn::Lt(hn::Add(size, beside), hn::Add(to_ac, to_ab)));
            const auto elsewhere = hn::Or(hn::Lt(hn::Add(time, before), hn::Zero(bvh_tag)),
                                          hn::Lt(hn::Add(hn::Mul(reach, size), before), time));
            result |= bits_of(hn::Or(outside, elsewhere)) << lane;
        }
        return all & ~result;
    }

private:
    static constexpr float doubt = 0x1p-18f;

    V3 origin_, direction_;
    float astray_;  ///< how far the point may be from the origin, in parts of the doubt
};

/// Lists some of eight, the nearest last. Returns how many there are.
inline std::size_t nearest_last(std::uint32_t bits, const float (&measures)[bvh_lanes],
                                const std::uint32_t (&refs)[bvh_lanes], BvhFound* list) {
    std::size_t count = 0;
    while (bits != 0) {
        const std::uint32_t lane = next_lane(bits);
        std::size_t place = count++;
        for (; place > 0 && list[place - 1].measure < measures[lane]; --place) list[place] = list[place - 1];
        list[place] = {measures[lane], refs[lane]};
    }
    return count;
}

/// `point` goes a way of length 1; what is visited reckons in ways `unit` times as long.
void on_line(const MeshTree& tree, const MovingBox<3>& point, double unit, MeshReachCall visit) {
    if (!(point.length >= 0)) return;
    double reach = point.length * reach_slack;
    const LineLanes meets_boxes(point);
    const LineToTriangles meets(point);
    BvhFound stack[most_waiting];
    std::size_t waiting = 0;
    std::uint32_t ref = tree.root(0).ref;
    float most = not_less(reach), times[mesh_lanes];
    for (;;) {
        if (is_leaf(ref)) {
            const MeshLeaf& leaf = tree.leaf(ref);
            for (std::uint32_t bits = meets(leaf, most); bits != 0;) {
                const std::uint32_t lane = next_lane(bits);
                const float wanted = visit(leaf.at(lane), tree.order[leaf.first + lane]);
                reach = std::min(reach, static_cast<double>(wanted) * unit * reach_slack);
                if (reach < 0) return;
                most = not_less(reach);
            }
        } else {
            const MeshNode& node = tree.node(ref);
            std::uint32_t bits = meets_boxes(node, most, times);
            if (bits != 0) {
                const std::uint32_t lane = next_lane(bits);
                ref = node.child[lane];
                if (bits == 0) continue;
                const std::uint32_t other = next_lane(bits);
                if (bits == 0) {
                    const bool other_first = times[other] < times[lane];
                    stack[waiting++] =
                        other_first ? BvhFound{times[lane], ref} : BvhFound{times[other], node.child[other]};
                    if (other_first) ref = node.child[other];
                    continue;
                }
                bits |= 1u << lane | 1u << other;
                waiting += nearest_last(bits, times, node.child, stack + waiting);
                ref = stack[--waiting].ref;
                continue;
            }
        }
        do {
            if (waiting == 0) return;
            --waiting;
        } while (stack[waiting].measure > most);
        ref = stack[waiting].ref;
    }
}

void overlapping_boxes(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    overlapping<3>(tree, LeafBoxes{tree}, box, visit);
}
void along_boxes(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    along<3>(tree, LeafBoxes{tree}, reach, visit);
}
void near_boxes(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    near<3>(tree, LeafBoxes{tree}, reach, visit);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(overlapping_boxes);
HWY_EXPORT(along_boxes);
HWY_EXPORT(near_boxes);
HWY_EXPORT(on_line);

namespace {

/// Whether floats can hold what a line is asked for.
bool is_usual(const MeshTree& tree, const MovingBox<3>& point, double length) {
    constexpr double far = 1e12;
    const Aabb3& box = tree.root(0).box;
    bool result = length > 1e-30 && length < 1e30;
    for (int i = 0; i < 3; ++i)
        result = result && static_cast<double>(box.min[i]) > -far && static_cast<double>(box.max[i]) < far &&
                 std::abs(point.center[i]) + point.half[i] < far;
    return result;
}

}  // namespace

void find_overlapping(const MeshTree& tree, const Aabb3& box, ItemCall visit) {
    const Aabb3 query = usable(box);
    if (!is_empty(query)) HWY_DYNAMIC_DISPATCH(overlapping_boxes)(tree, query, visit);
}
void find_within(const MeshTree& tree, const RayReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_boxes)(tree, reach, visit);
}
void find_within(const MeshTree& tree, const BoxReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_boxes)(tree, reach, visit);
}

bool find_on_line(const MeshTree& tree, const MovingBox<3>& point, MeshReachCall visit) {
    const double squared = length_squared(point.direction);
    const bool is_unit = std::abs(squared - 1) < 1e-6;
    const double unit = is_unit ? 1.0 : std::sqrt(squared);
    if (!is_usual(tree, point, unit)) return false;
    const Aabb3& box = tree.root(0).box;
    // No farther than the mesh: bounds on roundings grow with the reach.
    double beyond = 0;
    for (int i = 0; i < 3; ++i)
        beyond += std::max(std::abs(static_cast<double>(box.min[i]) - point.center[i]),
                           std::abs(static_cast<double>(box.max[i]) - point.center[i]));
    MovingBox<3> as_unit = point;
    if (!is_unit) as_unit.direction = point.direction / unit;
    as_unit.length = std::min(point.length * unit, 2 * beyond);
    HWY_DYNAMIC_DISPATCH(on_line)(tree, as_unit, unit, visit);
    return true;
}

}  // namespace abut
#endif
