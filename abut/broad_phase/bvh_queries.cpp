// Queries, down through the nodes whose boxes they meet. What a ray or a distance meets is guessed in float, never too
// little; what an item is, its own box decides, in double.
// Compiled once for each kind of vector unit by Highway, which takes the best of them when the program runs.

#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh_queries.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "abut/broad_phase/bvh_queries.cpp"
// clang-format off
#include <hwy/foreach_target.h>
#include <hwy/highway.h>
#include <abut/broad_phase/bvh_lanes-inl.h>
// clang-format on

HWY_BEFORE_NAMESPACE();
namespace abut::HWY_NAMESPACE {

/// Enough for the seven neighbours of each node on the way down.
constexpr std::size_t most_waiting = bvh_depth * (bvh_lanes - 1) + 2;

inline std::uint32_t next_lane(std::uint32_t& bits) {
    const auto result = static_cast<std::uint32_t>(std::countr_zero(bits));
    bits &= bits - 1;
    return result;
}

/// More than a float loses to a few roundings.
constexpr float float_slack = 1 + 1e-6f;
constexpr float float_least = 1e-37f;

inline float not_less(double number) {
    return static_cast<float>(number) * float_slack + float_least;
}

template <int D>
bool is_usual(const DVec<D>& v) {
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && std::abs(v[i]) < 1e30;
    return result;
}

template <int D>
void overlapping(const BvhTree<D>& tree, const Aabb<D>& box, ItemCall visit) {
    std::uint32_t stack[most_waiting];
    std::size_t waiting = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[waiting++] = tree.root(kind).ref;
    while (waiting > 0) {
        const std::uint32_t ref = stack[--waiting];
        if (is_leaf(ref)) {
            const BvhLeaf<D>& leaf = tree.leaf(ref);
            for (std::uint32_t bits = overlapping_lanes<D>(leaf, box); bits != 0;)
                if (!visit(leaf.index[next_lane(bits)])) return;
            continue;
        }
        const BvhNode<D>& node = tree.node(ref);
        // The first child on top.
        for (std::uint32_t bits = overlapping_lanes<D>(node, box); bits != 0;) {
            const auto lane = static_cast<std::uint32_t>(std::bit_width(bits)) - 1;
            bits ^= 1u << lane;
            stack[waiting++] = node.child[lane];
        }
    }
}

/// Eight boxes against a ray: which are perhaps within reach, and from where on.
template <int D>
class RayLanes {
public:
    explicit RayLanes(const RayReach<D>& reach) {
        for (int i = 0; i < D; ++i) {
            low_[i] = static_cast<float>(reach.low()[i]);
            high_[i] = static_cast<float>(reach.high()[i]);
            if (static_cast<double>(low_[i]) > reach.low()[i]) low_[i] = below(low_[i]);
            if (static_cast<double>(high_[i]) < reach.high()[i]) high_[i] = above(high_[i]);
            flat_[i] = reach.direction()[i] == 0;
            inverse_[i] = flat_[i] ? 1 : static_cast<float>(reach.inverse()[i]);
        }
    }

    /// Whether floats can hold all this.
    static bool suits(const RayReach<D>& reach) {
        bool result = is_usual<D>(reach.low()) && is_usual<D>(reach.high());
        for (int i = 0; i < D; ++i) {
            const double direction = std::abs(reach.direction()[i]);
            result = result && (direction == 0 || (direction > 1e-30 && direction < 1e30));
        }
        return result;
    }

    std::uint32_t operator()(const BvhRows<D>& rows, const RayReach<D>&, float most,
                             float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
            BvhVector from = hn::Zero(bvh_tag), to = hn::Set(bvh_tag, most);
            BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
            for (int i = 0; i < D; ++i) {
                const BvhVector min = hn::Load(bvh_tag, rows.min[i] + lane);
                const BvhVector max = hn::Load(bvh_tag, rows.max[i] + lane);
                const BvhVector low = hn::Set(bvh_tag, low_[i]), high = hn::Set(bvh_tag, high_[i]);
                if (flat_[i]) {
                    mask = hn::And(mask, hn::And(hn::Le(min, high), hn::Le(low, max)));
                    continue;
                }
                const BvhVector inverse = hn::Set(bvh_tag, inverse_[i]);
                const BvhVector at_min = hn::Mul(hn::Sub(min, high), inverse);
                const BvhVector at_max = hn::Mul(hn::Sub(max, low), inverse);
                from = hn::Max(from, hn::Min(at_min, at_max));
                to = hn::Min(to, hn::Max(at_min, at_max));
            }
            to = hn::Add(hn::Mul(to, hn::Set(bvh_tag, float_slack)), hn::Set(bvh_tag, float_least));
            result |= bits_of(hn::And(mask, hn::Le(from, to))) << lane;
            hn::StoreU(from, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    static float below(float x) { return std::nextafter(x, -std::numeric_limits<float>::infinity()); }
    static float above(float x) { return std::nextafter(x, std::numeric_limits<float>::infinity()); }

    float low_[D], high_[D], inverse_[D];
    bool flat_[D];
};

/// Eight boxes against another: which are perhaps within reach, and how far away, squared.
template <int D>
class BoxLanes {
public:
    explicit BoxLanes(const BoxReach<D>& reach) : box_(reach.box()) {}

    static bool suits(const BoxReach<D>& reach) {
        return is_usual<D>(DVec<D>(reach.box().min)) && is_usual<D>(DVec<D>(reach.box().max));
    }

    std::uint32_t operator()(const BvhRows<D>& rows, const BoxReach<D>&, float most,
                             float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; lane += bvh_step) {
            BvhVector sum = hn::Zero(bvh_tag);
            const BvhMask mask = hn::Le(hn::Load(bvh_tag, rows.min[0] + lane), hn::Load(bvh_tag, rows.max[0] + lane));
            for (int i = 0; i < D; ++i) {
                const BvhVector ahead = hn::Sub(hn::Load(bvh_tag, rows.min[i] + lane), hn::Set(bvh_tag, box_.max[i]));
                const BvhVector behind = hn::Sub(hn::Set(bvh_tag, box_.min[i]), hn::Load(bvh_tag, rows.max[i] + lane));
                const BvhVector gap = hn::Max(hn::Max(ahead, behind), hn::Zero(bvh_tag));
                sum = hn::Add(sum, hn::Mul(gap, gap));
            }
            result |= bits_of(hn::And(mask, hn::Le(sum, hn::Set(bvh_tag, most)))) << lane;
            hn::StoreU(sum, bvh_tag, measures + lane);
        }
        return result;
    }

private:
    Aabb<D> box_;
};

/// Where floats can't hold what is asked: one after the other, in double.
template <int D, class Reach>
class SlowLanes {
public:
    std::uint32_t operator()(const BvhRows<D>& rows, const Reach& reach, float, float (&measures)[bvh_lanes]) const {
        std::uint32_t result = 0;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            double measure = 0;
            const Aabb<D> box = rows.box(lane);
            measures[lane] = 0;
            if (is_empty(box) || !reach.measure(box, measure)) continue;
            result |= 1u << lane;
            measures[lane] = static_cast<float>(std::min(measure, 3e38));
        }
        return result;
    }
};

/// What is perhaps within reach, and how far away it is at least.
struct BvhFound {
    float measure;
    std::uint32_t ref;
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

template <int D, class Reach, class Test>
void within(const BvhTree<D>& tree, Reach reach, const Test& test, ReachCall visit) {
    BvhFound stack[most_waiting];
    std::size_t waiting = 0;
    for (const std::size_t kind : {1u, 0u})
        if (tree.root(kind).ref != bvh_none) stack[waiting++] = {0, tree.root(kind).ref};
    if (reach.over()) return;
    float most = not_less(reach.most()), measures[bvh_lanes];
    while (waiting > 0) {
        const BvhFound top = stack[--waiting];
        if (top.measure > most) continue;
        if (!is_leaf(top.ref)) {
            const BvhNode<D>& node = tree.node(top.ref);
            const std::uint32_t bits = test(node, reach, most, measures);
            waiting += nearest_last(bits, measures, node.child, stack + waiting);
            continue;
        }
        const BvhLeaf<D>& leaf = tree.leaf(top.ref);
        static constexpr std::uint32_t all_lanes[bvh_lanes] = {0, 1, 2, 3, 4, 5, 6, 7};
        BvhFound found[bvh_lanes];
        const std::uint32_t bits = test(leaf, reach, most, measures);
        for (std::size_t left = nearest_last(bits, measures, all_lanes, found); left > 0; --left) {
            const BvhFound next = found[left - 1];
            double measure = 0;
            if (next.measure > most) break;
            if (!reach.measure(leaf.box(next.ref), measure)) continue;
            reach.shrink(visit(leaf.index[next.ref]));
            if (reach.over()) return;
            most = not_less(reach.most());
        }
    }
}

template <template <int> class Lanes, int D, class Reach>
void within_either(const BvhTree<D>& tree, const Reach& reach, ReachCall visit) {
    if (Lanes<D>::suits(reach))
        within<D>(tree, reach, Lanes<D>(reach), visit);
    else
        within<D>(tree, reach, SlowLanes<D, Reach>(), visit);
}

void overlapping_2(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit) {
    overlapping<2>(tree, box, visit);
}
void overlapping_3(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit) {
    overlapping<3>(tree, box, visit);
}
void along_2(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit) {
    within_either<RayLanes>(tree, reach, visit);
}
void along_3(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit) {
    within_either<RayLanes>(tree, reach, visit);
}
void near_2(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit) {
    within_either<BoxLanes>(tree, reach, visit);
}
void near_3(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit) {
    within_either<BoxLanes>(tree, reach, visit);
}

}  // namespace abut::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace abut {

HWY_EXPORT(overlapping_2);
HWY_EXPORT(overlapping_3);
HWY_EXPORT(along_2);
HWY_EXPORT(along_3);
HWY_EXPORT(near_2);
HWY_EXPORT(near_3);

void find_overlapping(const BvhTree<2>& tree, const Aabb<2>& box, ItemCall visit) {
    HWY_DYNAMIC_DISPATCH(overlapping_2)(tree, box, visit);
}
void find_overlapping(const BvhTree<3>& tree, const Aabb<3>& box, ItemCall visit) {
    HWY_DYNAMIC_DISPATCH(overlapping_3)(tree, box, visit);
}
void find_within(const BvhTree<2>& tree, const RayReach<2>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_2)(tree, reach, visit);
}
void find_within(const BvhTree<3>& tree, const RayReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(along_3)(tree, reach, visit);
}
void find_within(const BvhTree<2>& tree, const BoxReach<2>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_2)(tree, reach, visit);
}
void find_within(const BvhTree<3>& tree, const BoxReach<3>& reach, ReachCall visit) {
    HWY_DYNAMIC_DISPATCH(near_3)(tree, reach, visit);
}

}  // namespace abut
#endif
