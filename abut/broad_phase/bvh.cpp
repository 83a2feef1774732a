#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/math/assert.hpp>

#include <algorithm>
#include <array>

namespace abut {
namespace {

template <int D>
bool is_bounded(const Aabb<D>& box) {
    // A bound so far out that sums of floats could overflow is none.
    constexpr float far = 1e37f;
    for (int i = 0; i < D; ++i)
        if (box.min[i] < -far || box.max[i] > far) return false;
    return true;
}

/// Visits what is within reach; of two children, the nearer first.
template <int D, class Reach>
void visit_within(const std::vector<BvhNode<D>>& nodes, const std::vector<BvhItem<D>>& items, Reach reach,
                  ReachCall visit) {
    struct Waiting {
        std::uint32_t node;
        double measure;
    };
    std::array<Waiting, bvh_depth + 1> stack;
    std::size_t waiting = 0;
    double measure = 0;
    if (!nodes.empty() && reach.measure(nodes[0], measure)) stack[waiting++] = {0, measure};
    while (waiting > 0) {
        const Waiting top = stack[--waiting];
        if (!reach.within(top.measure)) continue;
        const BvhNode<D>& node = nodes[top.node];
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            if (is_empty(items[i].box) || !reach.measure(items[i].box, measure)) continue;
            reach.shrink(visit(items[i].index));
            if (reach.over()) return;
        }
        if (node.count > 0) continue;
        Waiting left{top.node + 1, 0}, right{node.first, 0};
        const bool go_left = reach.measure(nodes[left.node], left.measure);
        const bool go_right = reach.measure(nodes[right.node], right.measure);
        const bool left_first = left.measure <= right.measure;
        if (go_left && go_right) {
            stack[waiting++] = left_first ? right : left;
            stack[waiting++] = left_first ? left : right;
        } else if (go_left) {
            stack[waiting++] = left;
        } else if (go_right) {
            stack[waiting++] = right;
        }
    }
}

}  // namespace

template <int D>
void Bvh<D>::build(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() <= std::size_t{1} << 31);
    size_ = boxes.size();
    items_.clear();
    items_.reserve(size_);
    nodes_.reserve(2 * size_);
    std::size_t bounded = 0;
    for (const bool wanted : {true, false}) {
        for (std::uint32_t i = 0; i < size_; ++i) {
            const Aabb<D> box = usable(boxes[i]);
            if (!is_empty(box) && is_bounded(box) == wanted) items_.push_back({box, i, 0});
        }
        if (wanted) bounded = items_.size();
    }
    build_nodes(items_, bounded, nodes_);
    built_ = refit();
}

template <int D>
void Bvh<D>::update(std::span<const Aabb<D>> boxes, Executor*) {
    ABUT_ASSERT(boxes.size() == size_);
    if (boxes.size() != size_ || has_newcomers(boxes)) return build(boxes);
    for (BvhItem<D>& item : items_) item.box = usable(boxes[item.index]);
    const Cost cost = refit();
    if (cost.area > 1.3 * built_.area || cost.endless > built_.endless) build(boxes);
}

template <int D>
bool Bvh<D>::has_newcomers(std::span<const Aabb<D>> boxes) const {
    if (items_.size() == size_) return false;
    const auto holds = [](const Aabb<D>& box) { return !is_empty(usable(box)); };
    const auto here =
        std::count_if(items_.begin(), items_.end(), [&](const BvhItem<D>& item) { return holds(boxes[item.index]); });
    return std::count_if(boxes.begin(), boxes.end(), holds) > here;
}

template <int D>
typename Bvh<D>::Cost Bvh<D>::refit() {
    Cost result;
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        BvhNode<D>& node = nodes_[i];
        Aabb<D> box = Aabb<D>::empty();
        if (node.count > 0) {
            for (std::uint32_t k = 0; k < node.count; ++k) box = merged(box, items_[node.first + k].box);
        } else {
            const BvhNode<D>&left = nodes_[i + 1], &right = nodes_[node.first];
            box = merged(Aabb<D>{left.min, left.max}, Aabb<D>{right.min, right.max});
        }
        node.min = box.min;
        node.max = box.max;
        const BoxSize size = box_size(box);
        result.area += size.area;
        result.endless += size.endless ? 1 : 0;
    }
    return result;
}

template <int D>
void Bvh<D>::sorted_pairs(std::vector<ItemPair>& out) const {
    out.clear();
    each_pair([&](std::uint32_t i, std::uint32_t j) { out.emplace_back(i, j); });
    std::sort(out.begin(), out.end());
}

template <int D>
void Bvh<D>::visit_overlapping(const Aabb<D>& box, ItemCall visit) const {
    const Aabb<D> query = usable(box);
    if (nodes_.empty() || is_empty(query)) return;
    std::array<std::uint32_t, bvh_depth + 1> stack;
    std::size_t waiting = 0;
    stack[waiting++] = 0;
    while (waiting > 0) {
        const std::uint32_t top = stack[--waiting];
        const BvhNode<D>& node = nodes_[top];
        if (!overlaps(Aabb<D>{node.min, node.max}, query)) continue;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
            if (overlaps(items_[i].box, query) && !visit(items_[i].index)) return;
        if (node.count > 0) continue;
        stack[waiting++] = node.first;
        stack[waiting++] = top + 1;
    }
}

template <int D>
void Bvh<D>::visit_along(const Ray<D>& ray, ReachCall visit) const {
    visit_within(nodes_, items_, RayReach<D>(ray), visit);
}

template <int D>
void Bvh<D>::visit_along(const MovingBox<D>& box, ReachCall visit) const {
    visit_within(nodes_, items_, RayReach<D>::of_box(box), visit);
}

template <int D>
void Bvh<D>::visit_near(const Aabb<D>& box, float reach, ReachCall visit) const {
    visit_within(nodes_, items_, BoxReach<D>(box, reach), visit);
}

template class Bvh<2>;
template class Bvh<3>;
static_assert(BroadPhase<Bvh<2>, 2> && BroadPhase<Bvh<3>, 3>);

}  // namespace abut
