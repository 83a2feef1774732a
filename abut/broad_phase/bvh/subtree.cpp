#include <abut/broad_phase/bvh/subtree.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>

#include <algorithm>
#include <array>

namespace abut::detail {
namespace {

template <int D>
Aabb<D> box_of(const BvhItem& item) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        result.min[i] = item.min[i];
        result.max[i] = item.max[i];
    }
    return result;
}

template <int D>
class SubtreeBuilder {
public:
    SubtreeBuilder(BvhSubtree<D>& subtree, bool bounded) : subtree_(subtree), bounded_(bounded) {}

    std::uint32_t build(const BvhRange<D>& range) { return range.count() <= bvh_lanes ? leaf(range) : node(range); }

private:
    std::uint32_t leaf(const BvhRange<D>& range) {
        const std::uint32_t count = range.count();
        // Items are sorted by index, for std::nth_element leaves an unspecified order.
        std::array<const BvhItem*, bvh_lanes> sorted;
        for (std::uint32_t i = 0; i < count; ++i) {
            const BvhItem* item = &subtree_.items[range.begin + i];
            std::uint32_t position = i;
            for (; position > 0 && sorted[position - 1]->index > item->index; --position)
                sorted[position] = sorted[position - 1];
            sorted[position] = item;
        }
        BvhLeaf<D>& leaf = subtree_.leaves.emplace_back(BvhLeaf<D>::empty());
        for (std::uint32_t i = 0; i < count; ++i) {
            leaf.set(i, box_of<D>(*sorted[i]));
            leaf.index[i] = sorted[i]->index;
        }
        return static_cast<std::uint32_t>(subtree_.leaves.size() - 1) | bvh_leaf_bit;
    }

    std::uint32_t node(BvhRange<D> range) {
        const bool is_lowest = range.count() <= bvh_node_items;
        if (is_lowest) range.leaves = std::min(range.leaves, bvh_lanes);
        // No child needs more levels than necessary, so that nodes that are not full are few, and near the root.
        std::uint32_t max_items = is_lowest ? bvh_lanes : bvh_node_items;
        while (!is_lowest && max_items * bvh_lanes < range.count()) max_items *= bvh_lanes;
        std::array<BvhRange<D>, bvh_lanes> child;
        child[0] = range;
        std::uint32_t count = 1;
        for (std::uint32_t next = 0; next != bvh_none && count < bvh_lanes; ++count) {
            std::copy_backward(child.data() + next + 1, child.data() + count, child.data() + count + 1);
            split(subtree_.items.data(), bounded_, child[next], child[next], child[next + 1]);
            next = largest(child, count + 1, max_items);
        }
        const auto result = static_cast<std::uint32_t>(subtree_.nodes.size());
        subtree_.nodes.push_back(BvhNode<D>::empty());
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            const std::uint32_t ref = build(child[lane]);
            if (!is_leaf(ref)) subtree_.nodes[ref].parent = result;
            subtree_.nodes[result].child[lane] = ref;
            subtree_.nodes[result].set(lane, child[lane].box);
        }
        BvhNode<D>& node = subtree_.nodes[result];
        node.items = range.count();
        node.area = node.built_area = children_area(node);
        return result;
    }

    /// The range with the largest box among those with more than `items` items; bvh_none if there is none.
    std::uint32_t largest(const std::array<BvhRange<D>, bvh_lanes>& ranges, std::uint32_t count,
                          std::uint32_t items) const {
        std::uint32_t result = bvh_none;
        double max_area = -1;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (ranges[i].count() <= items) continue;
            const double area = box_size(ranges[i].box).area;
            if (area > max_area) {
                max_area = area;
                result = i;
            }
        }
        return result;
    }

    BvhSubtree<D>& subtree_;
    bool bounded_;
};

}  // namespace

template <int D>
void build_subtree(BvhSubtree<D>& subtree, bool bounded, int depth) {
    subtree.nodes.clear();
    subtree.leaves.clear();
    const auto count = static_cast<std::uint32_t>(subtree.items.size());
    subtree.root = SubtreeBuilder<D>(subtree, bounded).build(whole_range<D>(subtree.items.data(), 0, count, depth));
}

template <int D>
double children_area(const BvhNode<D>& node) {
    double result = 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
        if (node.min[0][lane] <= node.max[0][lane]) result += box_size(node.box(lane)).area;
    return result;
}

template void build_subtree(BvhSubtree<2>&, bool, int);
template void build_subtree(BvhSubtree<3>&, bool, int);
template double children_area(const BvhNode<2>&);
template double children_area(const BvhNode<3>&);

}  // namespace abut::detail
