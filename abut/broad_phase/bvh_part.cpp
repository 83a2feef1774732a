#include <abut/broad_phase/bvh_part.hpp>
#include <abut/broad_phase/bvh_size.hpp>

#include <algorithm>
#include <array>

namespace abut {
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
class Grower {
public:
    Grower(BvhPart<D>& part, bool bounded) : part_(part), bounded_(bounded) {}

    std::uint32_t grow(const BvhRange<D>& range) { return range.count() <= bvh_lanes ? leaf(range) : node(range); }

private:
    std::uint32_t leaf(const BvhRange<D>& range) {
        const std::uint32_t count = range.count();
        // In the order of the indices, whatever the partitions of the C++ library do.
        std::array<const BvhItem*, bvh_lanes> sorted;
        for (std::uint32_t i = 0; i < count; ++i) {
            const BvhItem* item = &part_.items[range.begin + i];
            std::uint32_t place = i;
            for (; place > 0 && sorted[place - 1]->index > item->index; --place) sorted[place] = sorted[place - 1];
            sorted[place] = item;
        }
        BvhLeaf<D>& leaf = part_.leaves.emplace_back(BvhLeaf<D>::nothing());
        for (std::uint32_t i = 0; i < count; ++i) {
            leaf.set(i, box_of<D>(*sorted[i]));
            leaf.index[i] = sorted[i]->index;
        }
        return static_cast<std::uint32_t>(part_.leaves.size() - 1) | bvh_leaf_bit;
    }

    std::uint32_t node(BvhRange<D> range) {
        const bool last = range.count() <= bvh_node_items;
        if (last) range.leaves = std::min(range.leaves, bvh_lanes);
        // No child needs more levels than it must: so the nodes that are not full are few, and near the root.
        std::uint32_t most_items = last ? bvh_lanes : bvh_node_items;
        while (!last && most_items * bvh_lanes < range.count()) most_items *= bvh_lanes;
        std::array<BvhRange<D>, bvh_lanes> child;
        child[0] = range;
        std::uint32_t count = 1;
        for (std::uint32_t next = 0; next != bvh_none && count < bvh_lanes; ++count) {
            std::copy_backward(child.begin() + next + 1, child.begin() + count, child.begin() + count + 1);
            split(part_.items.data(), bounded_, child[next], child[next], child[next + 1]);
            next = largest(child, count + 1, most_items);
        }
        const auto result = static_cast<std::uint32_t>(part_.nodes.size());
        part_.nodes.push_back(BvhNode<D>::nothing());
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            const std::uint32_t ref = grow(child[lane]);
            if (!is_leaf(ref)) part_.nodes[ref].parent = result;
            part_.nodes[result].child[lane] = ref;
            part_.nodes[result].set(lane, child[lane].box);
        }
        BvhNode<D>& node = part_.nodes[result];
        node.items = range.count();
        node.area = node.built = area_of(node);
        return result;
    }

    /// Of those of more than so many items, the one with the largest box.
    std::uint32_t largest(const std::array<BvhRange<D>, bvh_lanes>& ranges, std::uint32_t count,
                          std::uint32_t items) const {
        std::uint32_t result = bvh_none;
        double most = -1;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (ranges[i].count() <= items) continue;
            const double area = box_size(ranges[i].box).area;
            if (area > most) {
                most = area;
                result = i;
            }
        }
        return result;
    }

    BvhPart<D>& part_;
    bool bounded_;
};

}  // namespace

template <int D>
void grow(BvhPart<D>& part, bool bounded, int depth) {
    part.nodes.clear();
    part.leaves.clear();
    const auto count = static_cast<std::uint32_t>(part.items.size());
    part.root = Grower<D>(part, bounded).grow(whole_range<D>(part.items.data(), 0, count, depth));
}

template <int D>
double area_of(const BvhNode<D>& node) {
    double result = 0;
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane)
        if (node.min[0][lane] <= node.max[0][lane]) result += box_size(node.box(lane)).area;
    return result;
}

template void grow(BvhPart<2>&, bool, int);
template void grow(BvhPart<3>&, bool, int);
template double area_of(const BvhNode<2>&);
template double area_of(const BvhNode<3>&);

}  // namespace abut
