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

/// A line as the nodes are asked for it, whose boxes are made wider by what its origin may be astray.
class LineToBoxes {
public:
    HWY_INLINE LineToBoxes(const Beam<3>& line, double astray) {
        for (int i = 0; i < 3; ++i) {
            const float origin = static_cast<float>(line.origin[i]), way = static_cast<float>(line.direction[i]);
            const float wider = static_cast<float>(astray) + std::abs(origin) * 0x1p-23f;
            to_low_[i] = hn::Set(bvh_tag, origin + wider);
            to_high_[i] = hn::Set(bvh_tag, origin - wider);
            // Where it all but rests, no finite time is too late for it; and 0 times it is not NaN.
            back_[i] = hn::Set(bvh_tag, -1 / std::copysign(std::max(std::abs(way), 1e-30f), way));
        }
    }

    /// Which boxes it may meet, a bit each, and when.
    HWY_INLINE std::uint32_t operator()(const MeshNode& node, float most, float (&times)[mesh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V x[2] = {low(node, 0, lane), high(node, 0, lane)}, y[2] = {low(node, 1, lane), high(node, 1, lane)},
                    z[2] = {low(node, 2, lane), high(node, 2, lane)};
            const V from = hn::Max(hn::Max(hn::Min(x[0], x[1]), hn::Zero(bvh_tag)),
                                   hn::Max(hn::Min(y[0], y[1]), hn::Min(z[0], z[1])));
            const V to = hn::Min(hn::Min(hn::Max(x[0], x[1]), hn::Set(bvh_tag, most)),
                                 hn::Min(hn::Max(y[0], y[1]), hn::Max(z[0], z[1])));
            const auto children = hn::Load(child_tag, node.child + lane);
            const auto used = hn::RebindMask(bvh_tag, hn::Ne(children, hn::Set(child_tag, bvh_none)));
            result |= bits_of(hn::And(used, hn::Le(from, hn::Mul(to, hn::Set(bvh_tag, slack))))) << lane;
            hn::StoreU(from, bvh_tag, times + lane);
        }
        return result;
    }

private:
    static constexpr hn::RebindToUnsigned<BvhVectorTag> child_tag{};

    /// More than twice five roundings to float.
    static constexpr float slack = 1 + 1e-6f;

    HWY_INLINE V low(const MeshNode& node, int axis, std::uint32_t lane) const {
        return hn::Mul(hn::Sub(to_low_[axis], hn::Load(bvh_tag, node.min[axis] + lane)), back_[axis]);
    }
    HWY_INLINE V high(const MeshNode& node, int axis, std::uint32_t lane) const {
        return hn::Mul(hn::Sub(to_high_[axis], hn::Load(bvh_tag, node.max[axis] + lane)), back_[axis]);
    }

    V to_low_[3], to_high_[3], back_[3];  ///< back: the other way, a step each
};

/// A line as the triangles are asked for it: it goes through a triangle if it does where all are seen along it, as
/// points of a plane. Woop, Benthin, Wald, "Watertight ray/triangle intersection" (2013), here with bounds on
/// roundings.
class LineToTriangles {
public:
    /// No corner is farther from its beginning than `beyond`, as a sum of magnitudes, and it was rounded by `rounded`
    /// along each axis.
    HWY_INLINE LineToTriangles(const Beam<3>& line, double beyond, double rounded) {
        const double origin[3] = {line.origin.x, line.origin.y, line.origin.z};
        const double direction[3] = {line.direction.x, line.direction.y, line.direction.z};
        // The axis that it goes along most, by arithmetic as it can't be guessed, and the other two.
        const double x = std::abs(direction[0]), y = std::abs(direction[1]), z = std::abs(direction[2]);
        const auto beyond_x = static_cast<unsigned>(y > x), is_z = static_cast<unsigned>(z > std::max(x, y));
        row_[2] = beyond_x + (2 - beyond_x) * is_z;
        row_[0] = row_[2] + 1 - 3 * (row_[2] >> 1);
        row_[1] = 3 - row_[0] - row_[2];
        for (int i = 0; i < 3; ++i) origin_[i] = hn::Set(bvh_tag, static_cast<float>(origin[row_[i]]));
        const double inverse = 1 / direction[row_[2]];
        for (int i = 0; i < 2; ++i) slope_[i] = hn::Set(bvh_tag, static_cast<float>(direction[row_[i]] * inverse));
        off_ = static_cast<float>(8 * 0x1p-24 * beyond + 2 * rounded);
    }

    /// Which triangles of a leaf it may go through, a bit each; wherever on the line.
    ///
    /// With u = 2^-24 and |.| the sum of the coordinates' magnitudes, a corner is seen in its place but for 4 u |corner
    /// - origin|. The line comes by the leaf's box, so that no corner is seen farther from it than the box is wide; the
    /// products of two such places are off by less than six times the one times the other.
    HWY_INLINE std::uint32_t operator()(const MeshLeaf& leaf) const {
        std::uint32_t result = 0;
        HWY_ALIGN float places[2][mesh_lanes];
        for (std::uint32_t lane = 0; lane < mesh_lanes; lane += bvh_step) {
            const V along = from_origin(leaf, 2, lane);
            for (int i = 0; i < 2; ++i)
                hn::Store(hn::Sub(from_origin(leaf, i, lane), hn::Mul(along, slope_[i])), bvh_tag, places[i] + lane);
        }
        const V most = hn::Set(bvh_tag, 8 * off_ * (leaf.extent + off_)), least = hn::Neg(most);
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
    HWY_INLINE V from_origin(const MeshLeaf& leaf, int i, std::uint32_t lane) const {
        return hn::Sub(hn::Load(bvh_tag, leaf.corner[row_[i]] + lane), origin_[i]);
    }
    static HWY_INLINE V turned(const V2& a, const V2& b) { return hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x)); }

    unsigned row_[3];  ///< of the corners: the two axes across and the one along
    V origin_[3], slope_[2];
    float off_;  ///< how far from where it is a corner may be seen
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
    const LineToBoxes meets_boxes(beam.own, beam.astray);
    const LineToTriangles meets(beam.own, beyond, beam.astray + 0x1p-24 * (beyond + tree.off_center));
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
        if (stack != waits) fetch(tree, stack[-1]);
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
