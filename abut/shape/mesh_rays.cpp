// What a line meets of a mesh: its boxes and then its triangles, in float and never too little. What they let through
// is decided in double. Compiled once for each kind of vector unit by Highway, which takes the best of them when the
// program runs.

#include <abut/convex/ray_triangle.hpp>
#include <abut/shape/mesh_rays.hpp>

#include <bit>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/shape/mesh_rays.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/shape/mesh_lanes-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// A line as the nodes are asked for it. A point that may be astray reaches the first side of a box from its near end
/// and the second from its far one.
class LineLanes {
public:
    HWY_INLINE LineLanes(const Beam<3>& line, double astray) {
        const hn::CappedTag<float, 4> tag;
        constexpr std::size_t step = hn::MaxLanes(tag);
        HWY_ALIGN float origins[4], ways[4], near_origins[4], far_origins[4], near_inverses[4], far_inverses[4];
        for (int i = 0; i < 3; ++i) {
            origins[i] = static_cast<float>(line.origin[i]);
            ways[i] = static_cast<float>(line.direction[i]);
        }
        origins[3] = ways[3] = 1;
        const auto out = hn::Set(tag, static_cast<float>(astray));
        for (std::size_t i = 0; i < 4; i += step) {
            const auto origin = hn::Load(tag, origins + i), way = hn::Load(tag, ways + i);
            // Where it all but rests, no finite time is too late for it; and 0 times it is not NaN.
            const auto direction = hn::CopySign(hn::Max(hn::Abs(way), hn::Set(tag, 1e-30f)), way);
            const auto inverse = hn::Div(hn::Set(tag, 1), direction);
            const auto outwards = hn::CopySign(hn::Add(hn::Mul(hn::Abs(origin), hn::Set(tag, 0x1p-23f)), out), way);
            hn::Store(hn::Add(origin, outwards), tag, near_origins + i);
            hn::Store(hn::Sub(origin, outwards), tag, far_origins + i);
            hn::Store(hn::Mul(inverse, hn::Set(tag, 1 - slack)), tag, near_inverses + i);
            hn::Store(hn::Mul(inverse, hn::Set(tag, 1 + slack)), tag, far_inverses + i);
        }
        for (std::uint32_t i = 0; i < 3; ++i) {
            near_origin_[i] = hn::Set(bvh_tag, near_origins[i]);
            far_origin_[i] = hn::Set(bvh_tag, far_origins[i]);
            near_inverse_[i] = hn::Set(bvh_tag, near_inverses[i]);
            far_inverse_[i] = hn::Set(bvh_tag, far_inverses[i]);
            const std::uint32_t downwards = std::bit_cast<std::uint32_t>(ways[i]) >> 31;  // also of -0
            near_row_[i] = (3 * downwards + i) * mesh_lanes;
            far_row_[i] = (3 - 3 * downwards + i) * mesh_lanes;
        }
    }

    /// Which boxes it may meet, a bit each, and when.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float most, float (&times)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const float* rows = node.min[0] + lane;
            const V from = hn::Max(hn::Max(first(rows, 0), hn::Zero(bvh_tag)), hn::Max(first(rows, 1), first(rows, 2)));
            const V to = hn::Min(hn::Min(last(rows, 0), hn::Set(bvh_tag, most)), hn::Min(last(rows, 1), last(rows, 2)));
            result |= bits_of(hn::Le(from, to)) << lane;
            hn::StoreU(from, bvh_tag, times + lane);
        }
        return result;
    }

private:
    /// More than five roundings to float.
    static constexpr float slack = 5e-7f;

    HWY_INLINE V first(const float* rows, int axis) const {
        return hn::Mul(hn::Sub(hn::Load(bvh_tag, rows + near_row_[axis]), near_origin_[axis]), near_inverse_[axis]);
    }
    HWY_INLINE V last(const float* rows, int axis) const {
        return hn::Mul(hn::Sub(hn::Load(bvh_tag, rows + far_row_[axis]), far_origin_[axis]), far_inverse_[axis]);
    }

    V near_origin_[3], far_origin_[3], near_inverse_[3], far_inverse_[3];
    std::size_t near_row_[3], far_row_[3];
};

/// A line as the triangles are asked for it: it goes through a triangle if it does where all are seen along it, as
/// points of a plane. Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), here with bounds on
/// roundings.
class LineToTriangles {
public:
    HWY_INLINE LineToTriangles(const Beam<3>& line, double astray) {
        const Vec3 from = to_float(line.origin);
        origin_ = all_lanes(from);
        // Two axes across the line (Duff and others, "Building an orthonormal basis, revisited", 2017).
        const DVec<3>& d = line.direction;
        const double sign = std::copysign(1.0, d.z), a = -1 / (sign + d.z), b = d.x * d.y * a;
        across_[0] = all_lanes(to_float(DVec<3>(1 + sign * d.x * d.x * a, sign * b, -sign * d.x)));
        across_[1] = all_lanes(to_float(DVec<3>(b, sign + d.y * d.y * a, -d.y)));
        // What float takes off the origin, too.
        const double rounded = std::abs(static_cast<double>(from.x) - line.origin.x) +
                               std::abs(static_cast<double>(from.y) - line.origin.y) +
                               std::abs(static_cast<double>(from.z) - line.origin.z);
        astray_ = static_cast<float>((3 * astray + rounded) * (1 + 1e-6));
    }

    /// Which triangles of a leaf it may go through, a bit each; wherever on the line.
    ///
    /// With u = 2^-24 and |.| the sum of the coordinates' magnitudes, a corner is seen in its place but for 5 u |corner
    /// - origin|. The line comes by the leaf's box, so that no corner is seen farther from it than the box is wide; the
    /// products of two such places are off by less than six times the one times the other.
    HWY_INLINE std::uint32_t operator()(const MeshLeaf& leaf) const {
        std::uint32_t result = 0;
        HWY_ALIGN float places[2][mesh_lanes];
        float scale = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V3 corner = minus({hn::Load(bvh_tag, leaf.corner[0] + lane), hn::Load(bvh_tag, leaf.corner[1] + lane),
                                     hn::Load(bvh_tag, leaf.corner[2] + lane)},
                                    origin_);
            hn::Store(dot(corner, across_[0]), bvh_tag, places[0] + lane);
            hn::Store(dot(corner, across_[1]), bvh_tag, places[1] + lane);
            if (lane == 0)
                scale = hn::GetLane(hn::Add(hn::Add(hn::Abs(corner.x), hn::Abs(corner.y)), hn::Abs(corner.z)));
        }
        const float off = 8 * 0x1p-24f * (scale + leaf.extent) + astray_;
        const V least = hn::Set(bvh_tag, -8 * off * (leaf.extent + off)), most = hn::Neg(least);
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const LeafNumbers numbers(leaf, lane);
            const V2 a = numbers.pick<0>(places), b = numbers.pick<1>(places), c = numbers.pick<2>(places);
            const V ab = turned(a, b), bc = turned(b, c), ca = turned(c, a);
            // Written so that NaN is no reason to leave out one.
            const auto outside =
                hn::And(hn::Lt(hn::Min(hn::Min(ab, bc), ca), least), hn::Gt(hn::Max(hn::Max(ab, bc), ca), most));
            result |= bits_of(outside) << lane;
        }
        return leaf.used & ~result;
    }

private:
    static HWY_INLINE V3 all_lanes(const Vec3& v) {
        return {hn::Set(bvh_tag, v.x), hn::Set(bvh_tag, v.y), hn::Set(bvh_tag, v.z)};
    }
    static HWY_INLINE V turned(const V2& a, const V2& b) { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)); }

    V3 origin_, across_[2];
    float astray_;  ///< how far the point may be from the origin
};

/// What waits to be visited: when it is reached in the upper half, as of floats not below zero their bits tell the
/// order, and what it is in the lower.
using Waiting = std::uint64_t;

HWY_INLINE Waiting waiting(float time, std::uint32_t ref) {
    constexpr std::uint32_t all_but_sign = 0x7FFFFFFF;  // that of a zero may be set
    return static_cast<Waiting>(std::bit_cast<std::uint32_t>(time) & all_but_sign) << 32 | ref;
}
/// By arithmetic: which is first can't be guessed, and compilers make a branch of a choice.
HWY_INLINE void put_first(Waiting& first, Waiting& second) {
    const Waiting differ = (first ^ second) & (0 - static_cast<Waiting>(second < first));
    first ^= differ;
    second ^= differ;
}

/// Begins to bring in what is likely to be visited soon.
HWY_INLINE void fetch(const MeshTree& tree, Waiting soon) {
    const auto ref = static_cast<std::uint32_t>(soon);
    const auto* bytes =
        is_leaf(ref) ? reinterpret_cast<const char*>(&tree.leaf(ref)) : reinterpret_cast<const char*>(&tree.node(ref));
    __builtin_prefetch(bytes);
    __builtin_prefetch(bytes + 64);
}

/// Some children of a node: returns the first, the rest go on the stack, the last of them first.
HWY_INLINE Waiting first_of(const MeshTree& tree, const MeshNode& node, std::uint32_t bits,
                            const float (&times)[mesh_lanes], Waiting*& stack) {
    const auto next = [&] {
        const std::uint32_t lane = next_lane(bits);
        return waiting(times[lane], node.child[lane]);
    };
    Waiting first = next();
    if (bits == 0) return first;
    Waiting second = next();
    put_first(first, second);
    if (bits == 0) {
        fetch(tree, second);
        *stack++ = second;
        return first;
    }
    Waiting third = next();
    put_first(first, third);
    put_first(second, third);
    Waiting* const bottom = stack;
    *stack++ = third;
    while (bits != 0) {
        Waiting other = next();
        put_first(first, other);
        put_first(second, other);
        Waiting* place = stack++;
        for (; place > bottom && place[-1] < other; --place) *place = place[-1];
        *place = other;
    }
    fetch(tree, second);
    *stack++ = second;
    return first;
}

/// `meet(leaf, lane, index)` returns the new reach, in lengths of the world. False where floats can't hold the numbers.
template <class Meet>
bool down(const MeshTree& tree, const MeshBeam& beam, Meet meet) {
    // No farther than the mesh: bounds on roundings grow with the reach.
    const DVec<3> to_middle = beam.own.origin - tree.middle;
    const double beyond = std::abs(to_middle.x) + std::abs(to_middle.y) + std::abs(to_middle.z) + tree.spread;
    if (!(beyond < mesh_most)) return false;
    const double reach = std::min(beam.own.length, 2 * beyond);
    if (!(reach >= 0)) return true;
    const double unit = beam.unit * reach_slack;
    const LineLanes meets_boxes(beam.own, beam.astray);
    const LineToTriangles meets(beam.own, beam.astray);
    Waiting waits[most_waiting];
    Waiting* stack = waits;
    float most = not_less(reach * reach_slack), times[mesh_lanes];
    std::uint32_t ref = tree.root(0).ref;
    for (;;) {
        if (is_leaf(ref)) {
            const MeshLeaf& leaf = tree.leaf(ref);
            std::uint32_t bits = meets(leaf);
            // Of what is hit the number is told in the end.
            if (bits != 0) __builtin_prefetch(&tree.order[leaf.first]);
            while (bits != 0) {
                const std::uint32_t lane = next_lane(bits);
                const double wanted = meet(leaf, lane, tree.order[leaf.first + lane]);
                if (wanted < 0) return true;
                most = std::min(most, not_less(wanted * unit));
            }
        } else {
            const MeshNode& node = tree.node(ref);
            __builtin_prefetch(node.child);  // it lies apart from the boxes, and would be asked for only after them
            const std::uint32_t bits = meets_boxes(node, most, times);
            if (bits != 0) {
                ref = static_cast<std::uint32_t>(first_of(tree, node, bits, times, stack));
                continue;
            }
        }
        const Waiting beyond_reach = waiting(most, 0xFFFFFFFF);
        do {
            if (stack == waits) return true;
            --stack;
        } while (*stack > beyond_reach);
        ref = static_cast<std::uint32_t>(*stack);
    }
}

/// The mesh's corners as the beam's origin sees them.
struct SeenPlaced {
    const Affine<3>& place;

    DVec<3> operator()(const Vec3& corner) const { return place.point(DVec<3>(corner)); }
};
struct SeenAsTheyAre {
    const DVec<3>& origin;

    DVec<3> operator()(const Vec3& corner) const { return DVec<3>(corner) - origin; }
};

/// Whether and where the beam meets a triangle before `most`.
template <class Seen>
class Decision {
public:
    Decision(const MeshBeam& beam, const Seen& seen, const UndecidedTriangle& undecided)
        : direction_(beam.beam.direction), wanted_side_(beam.wanted_side), seen_(seen), undecided_(undecided) {}

    HWY_INLINE bool operator()(const MeshLeaf& leaf, std::uint32_t lane, double most, RayEntry<3>& entry) const {
        const Triangle3 triangle = leaf.at(lane);
        const DVec<3> a = seen_(triangle.a), b = seen_(triangle.b), c = seen_(triangle.c);
        if (wanted_side_ != 0 && !(dot(cross(b - a, c - a), direction_) * wanted_side_ < 0)) return false;
        const RayAnswer answer = decide_triangle(direction_, most, a, b, c, entry);
        if (answer == RayAnswer::undecided) return undecided_(leaf.at(lane), most, entry);
        return answer == RayAnswer::enters;
    }

private:
    const DVec<3>& direction_;
    double wanted_side_;
    Seen seen_;
    const UndecidedTriangle& undecided_;
};

template <class Decide>
bool find_first(const MeshTree& tree, const MeshBeam& beam, const Decide& decide, MeshHit& hit) {
    RayEntry<3> found;
    double reach = beam.beam.length;
    return down(tree, beam, [&](const MeshLeaf& leaf, std::uint32_t lane, const std::uint32_t& index) {
        if (decide(leaf, lane, reach, found) &&
            (hit.triangle == nullptr || found.along < hit.entry.along || index < *hit.triangle)) {
            hit.entry = found;
            hit.triangle = &index;
            reach = found.along;
        }
        return reach;
    });
}

template <class Decide>
bool find_each(const MeshTree& tree, const MeshBeam& beam, const Decide& decide, const MeshHitCall& visit) {
    RayEntry<3> found;
    double reach = beam.beam.length;
    return down(tree, beam, [&](const MeshLeaf& leaf, std::uint32_t lane, const std::uint32_t& index) {
        if (decide(leaf, lane, reach, found)) reach = visit(found, index);
        return reach;
    });
}

bool first_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided, MeshHit& hit) {
    if (beam.seen == nullptr)
        return find_first(tree, beam, Decision<SeenAsTheyAre>(beam, {beam.beam.origin}, undecided), hit);
    return find_first(tree, beam, Decision<SeenPlaced>(beam, {*beam.seen}, undecided), hit);
}

bool each_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided,
              const MeshHitCall& visit) {
    if (beam.seen == nullptr)
        return find_each(tree, beam, Decision<SeenAsTheyAre>(beam, {beam.beam.origin}, undecided), visit);
    return find_each(tree, beam, Decision<SeenPlaced>(beam, {*beam.seen}, undecided), visit);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(first_hit);
HWY_EXPORT(each_hit);

bool find_first_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided, MeshHit& hit) {
    return HWY_DYNAMIC_DISPATCH(first_hit)(tree, beam, undecided, hit);
}

bool find_each_hit(const MeshTree& tree, const MeshBeam& beam, const UndecidedTriangle& undecided,
                   const MeshHitCall& visit) {
    return HWY_DYNAMIC_DISPATCH(each_hit)(tree, beam, undecided, visit);
}

}  // namespace abut
#endif
