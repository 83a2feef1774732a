#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bsp.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/detail/pair_buffer.hpp>
#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>

#include <algorithm>

namespace abut {

using namespace detail;

namespace {

constexpr std::uint32_t leaf_boxes = 8;
constexpr int max_depth = 64;

enum Side { straddles, below, above };

template <int D>
Side side_of(const Aabb<D>& box, int axis, float plane) {
    if (box.max[axis] < plane) return below;
    return box.min[axis] >= plane ? above : straddles;
}

}  // namespace

template <int D>
void Bsp<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() < std::size_t{1} << 31);
    size_ = boxes.size();
    bounds_ = Aabb<D>::empty();
    entries_.clear();
    entries_.reserve(size_);
    for (std::uint32_t item = 0; item < size_; ++item) {
        const Aabb<D> box = usable(boxes[item]);
        if (is_empty(box)) continue;
        entries_.push_back({box, item});
        bounds_ = merged(bounds_, box);
    }
    scratch_.resize(size_);
    centers_.resize(size_);
    nodes_.clear();
    nodes_.reserve(2 * size_ + 1);  // inner nodes have two non-empty children or three
    build_node(0, static_cast<std::uint32_t>(entries_.size()), 0);
}

template <int D>
void Bsp<D>::update(std::span<const Aabb<D>> boxes, Executor* executor) {
    detail::enter_library();
    ABUT_ASSERT(boxes.size() == size());
    const auto unmoved = [&](const Entry& entry) { return usable(boxes[entry.item]) == entry.box; };
    const auto stored = static_cast<std::size_t>(
        std::count_if(boxes.begin(), boxes.end(), [](const Aabb<D>& box) { return !is_empty(usable(box)); }));
    const bool same =
        boxes.size() == size_ && stored == entries_.size() && std::all_of(entries_.begin(), entries_.end(), unmoved);
    if (!same) build(boxes, executor);
}

/// Adds the node of some boxes and all nodes below it. Returns its index.
template <int D>
std::uint32_t Bsp<D>::build_node(std::uint32_t begin, std::uint32_t end, int depth) {
    const auto index = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({begin, end});
    const Split split = end - begin <= leaf_boxes || depth == max_depth ? Split{} : choose_split(begin, end);
    if (split.axis < 0) return index;

    // Sorts the boxes by their side of the plane. Boxes of one side stay in their order.
    std::uint32_t place = begin, ends[3];
    for (const Side side : {straddles, below, above}) {
        for (std::uint32_t i = begin; i < end; ++i)
            if (side_of(entries_[i].box, split.axis, split.plane) == side) scratch_[place++] = entries_[i];
        ends[side] = place;
    }
    std::copy(scratch_.data() + begin, scratch_.data() + end, entries_.data() + begin);

    Node node{begin, end};
    node.axis = split.axis;
    node.low = node.high = node.plane = split.plane;
    for (std::uint32_t i = begin; i < ends[straddles]; ++i) {
        node.low = std::min(node.low, entries_[i].box.min[split.axis]);
        node.high = std::max(node.high, entries_[i].box.max[split.axis]);
    }
    if (ends[straddles] > begin) node.straddles = build_node(begin, ends[straddles], depth + 1);
    node.below = build_node(ends[straddles], ends[below], depth + 1);
    node.above = build_node(ends[below], end, depth + 1);
    nodes_[index] = node;
    return index;
}

/// The plane with the fewest boxes across it and on its larger side together. The axis is -1 if no plane has boxes on
/// both sides.
template <int D>
auto Bsp<D>::choose_split(std::uint32_t begin, std::uint32_t end) -> Split {
    Split best;
    std::uint32_t least_cost = end - begin;
    for (int axis = 0; axis < D; ++axis) {
        for (std::uint32_t i = begin; i < end; ++i) centers_[i] = center(entries_[i].box)[axis];
        const auto median = centers_.data() + (begin + end) / 2;
        std::nth_element(centers_.data() + begin, median, centers_.data() + end);
        std::uint32_t counts[3] = {};
        for (std::uint32_t i = begin; i < end; ++i) ++counts[side_of(entries_[i].box, axis, *median)];
        const std::uint32_t cost = counts[straddles] + std::max(counts[below], counts[above]);
        if (counts[below] == 0 || counts[above] == 0 || cost >= least_cost) continue;
        least_cost = cost;
        best = {axis, *median};
    }
    return best;
}

/// Calls visit(entry) for all boxes of a subtree that overlap this one. Returns false as soon as the visitor does.
template <int D>
template <class Visit>
bool Bsp<D>::visit_region(std::uint32_t index, const Aabb<D>& box, const Visit& visit) const {
    const Node& node = nodes_[index];
    if (node.below == 0) {
        for (std::uint32_t i = node.begin; i < node.end; ++i)
            if (overlaps(entries_[i].box, box) && !visit(entries_[i])) return false;
        return true;
    }
    const float low = box.min[node.axis], high = box.max[node.axis];
    return (node.straddles == 0 || low > node.high || high < node.low || visit_region(node.straddles, box, visit)) &&
           (low >= node.plane || visit_region(node.below, box, visit)) &&
           (high < node.plane || visit_region(node.above, box, visit));
}

/// Adds the pairs within a leaf. Of an inner node, adds the pairs of a straddling box with a box on either side.
template <int D>
bool Bsp<D>::visit_pairs_of(std::uint32_t index, detail::PairBuffer& pairs) const {
    const Node& node = nodes_[index];
    const bool is_leaf = node.below == 0;
    const std::uint32_t end = is_leaf ? node.end : node.straddles == 0 ? node.begin : nodes_[node.straddles].end;
    for (std::uint32_t i = node.begin; i < end; ++i) {
        const Entry& entry = entries_[i];
        const auto add = [&](const Entry& other) { return pairs.add_sorted(entry.item, other.item); };
        for (std::uint32_t k = i + 1; is_leaf && k < end; ++k)
            if (overlaps(entry.box, entries_[k].box) && !add(entries_[k])) return false;
        if (is_leaf) continue;
        if (!visit_region(node.below, entry.box, add) || !visit_region(node.above, entry.box, add)) return false;
    }
    return true;
}

/// Visits what is within reach in a subtree: the nearer side of the plane, then the boxes across it, then the other
/// side.
template <int D>
template <class Reach>
void Bsp<D>::visit_within(std::uint32_t index, const Aabb<D>& cell, Reach& reach, ReachCall visit) const {
    const Node& node = nodes_[index];
    double distance = 0;
    if (node.below == 0) {
        for (std::uint32_t i = node.begin; i < node.end && !reach.is_exhausted(); ++i)
            if (reach.measure(entries_[i].box, distance)) reach.shrink(visit(entries_[i].item));
        return;
    }
    const auto descend = [&](std::uint32_t child, const Aabb<D>& part) {
        if (child != 0 && !reach.is_exhausted() && reach.measure(part, distance))
            visit_within(child, part, reach, visit);
    };
    Aabb<D> lower = cell, upper = cell, middle = cell;
    lower.max[node.axis] = upper.min[node.axis] = node.plane;
    middle.min[node.axis] = node.low;
    middle.max[node.axis] = node.high;
    double to_lower = 0, to_upper = 0;
    const bool reaches_lower = reach.measure(lower, to_lower), reaches_upper = reach.measure(upper, to_upper);
    const bool lower_first = reaches_lower && !(reaches_upper && to_upper < to_lower);
    if (lower_first) descend(node.below, lower);
    if (!lower_first) descend(node.above, upper);
    descend(node.straddles, middle);
    if (lower_first) descend(node.above, upper);
    if (!lower_first) descend(node.below, lower);
}

template <int D>
void Bsp<D>::visit_pairs(PairsCall visit, Executor* executor) const {
    const auto add_pairs = [&](std::size_t begin, std::size_t end, detail::PairBuffer& pairs) {
        for (std::size_t node = begin; node < end; ++node)
            if (!visit_pairs_of(static_cast<std::uint32_t>(node), pairs)) return false;
        return true;
    };
    detail::report_ranges(executor, nodes_.size(), 64, visit, add_pairs);
}

template <int D>
void Bsp<D>::visit_pairs(const Bsp& other, PairsCall visit) const {
    detail::report_between(*this, other, visit);
}

template <int D>
void Bsp<D>::visit_boxes(BoxCall<D> visit) const {
    for (const Entry& entry : entries_)
        if (!visit(entry.item, entry.box)) return;
}

template <int D>
void Bsp<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (is_empty(bounds_) || is_empty(query)) return;
    visit_region(0, query, [&](const Entry& entry) { return visit(entry.item); });
}

template <int D>
void Bsp<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    auto reach = RayReach<D>::of_box(box);
    if (!is_empty(bounds_) && !reach.is_exhausted()) visit_within(0, bounds_, reach, visit);
}

template <int D>
void Bsp<D>::visit_near(const Aabb<D>& box, float max_distance, ReachCall visit) const {
    BoxReach<D> reach(box, max_distance);
    if (!is_empty(bounds_) && !reach.is_exhausted()) visit_within(0, bounds_, reach, visit);
}

template class Bsp<2>;
template class Bsp<3>;
static_assert(BroadPhase<Bsp<2>, 2> && BroadPhase<Bsp<3>, 3>);

}  // namespace abut
