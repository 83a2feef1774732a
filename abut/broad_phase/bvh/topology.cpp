#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/bvh/topology.hpp>

#include <algorithm>
#include <utility>

namespace abut::detail {
namespace {

/// Adds what is below a reference in the order of a traversal, and returns the reference by which the topology knows
/// it.
template <int D>
std::uint32_t add_below(const BvhTree<D>& tree, std::uint32_t ref, BvhTopology& topology) {
    if (ref == bvh_none) return bvh_none;
    if (is_leaf(ref)) {
        const BvhLeaf<D>& leaf = tree.leaf(ref);
        const std::uint32_t count = leaf.count();
        topology.items.insert(topology.items.end(), leaf.index, leaf.index + count);
        topology.counts.push_back(static_cast<std::uint8_t>(count));
        return static_cast<std::uint32_t>(topology.counts.size() - 1) | bvh_leaf_bit;
    }
    const std::size_t first = topology.children.size();
    topology.children.resize(first + bvh_lanes, bvh_none);
    for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
        const std::uint32_t child = add_below(tree, tree.node(ref).child[lane], topology);
        topology.children[first + lane] = child;
    }
    return static_cast<std::uint32_t>(first / bvh_lanes);
}

/// Follows the references of a topology in the order of a traversal, and expects their numbers in this order. So each
/// leaf and each node has one parent, and there are no cycles.
class TopologyCheck {
public:
    explicit TopologyCheck(const BvhTopology& topology) : topology_(topology) {}

    bool is_sound() {
        if (topology_.children.size() % bvh_lanes != 0) return false;
        for (const std::uint32_t root : topology_.roots)
            if (root != bvh_none && !visit(root, 0)) return false;
        return nodes_ * bvh_lanes == topology_.children.size() && leaves_ == topology_.counts.size();
    }
    /// The number of levels of nodes.
    int depth() const { return depth_; }

private:
    bool visit(std::uint32_t ref, int depth) {
        const std::uint32_t number = ref & ~bvh_leaf_bit;
        if (is_leaf(ref)) return number == leaves_++ && number < topology_.counts.size();
        // The leaf below the last node is one level deeper.
        if (depth + 1 >= bvh_depth || number != nodes_++ || number >= topology_.children.size() / bvh_lanes)
            return false;
        depth_ = std::max(depth_, depth + 1);
        bool ended = false;
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            const std::uint32_t child = topology_.children[std::size_t{bvh_lanes} * number + lane];
            if (child == bvh_none) {
                ended = true;
                continue;
            }
            if (ended || !visit(child, depth + 1)) return false;
        }
        return true;
    }

    const BvhTopology& topology_;
    std::size_t nodes_ = 0, leaves_ = 0;
    int depth_ = 0;
};

}  // namespace

void write(BlobWriter& writer, const BvhTopology& topology) {
    for (const std::uint32_t root : topology.roots) writer.number(root);
    writer.number(static_cast<std::uint64_t>(topology.items.size()));
    writer.number(static_cast<std::uint64_t>(topology.counts.size()));
    writer.number(static_cast<std::uint64_t>(topology.children.size()));
    writer.array(std::span(topology.items));
    writer.array(std::span(topology.counts));
    writer.array(std::span(topology.children));
}

bool read(BlobReader& reader, BvhTopology& topology) {
    std::uint64_t items = 0, leaves = 0, children = 0;
    return reader.number(topology.roots[0]) && reader.number(topology.roots[1]) && reader.number(items) &&
           reader.number(leaves) && reader.number(children) && reader.array(topology.items, items) &&
           reader.array(topology.counts, leaves) && reader.array(topology.children, children);
}

template <int D>
BvhTopology BvhTree<D>::topology() const {
    BvhTopology result;
    for (const std::size_t kind : {0u, 1u}) result.roots[kind] = add_below(*this, roots_[kind].ref, result);
    return result;
}

template <int D>
bool BvhTree<D>::build(std::span<const Aabb<D>> boxes, const BvhTopology& topology) {
    TopologyCheck check(topology);
    if (topology.items.size() > boxes.size() || !check.is_sound()) return false;
    BvhTree result;
    result.positions_.assign(boxes.size(), position_none);
    result.roots_[0].ref = topology.roots[0];
    result.roots_[1].ref = topology.roots[1];
    result.leaf_parents_.assign(topology.counts.size(), bvh_none);
    result.nodes_.assign(topology.children.size() / bvh_lanes, BvhNode<D>::empty());
    result.nodes_used_ = result.nodes_live_ = static_cast<std::uint32_t>(result.nodes_.size());
    for (std::uint32_t i = 0; i < result.nodes_.size(); ++i)
        for (std::uint32_t lane = 0; lane < bvh_lanes; ++lane) {
            const std::uint32_t child = topology.children[std::size_t{bvh_lanes} * i + lane];
            result.nodes_[i].child[lane] = child;
            if (child != bvh_none) result.parent_of(child) = i;
        }
    result.leaves_.assign(topology.counts.size(), BvhLeaf<D>::empty());
    result.leaves_used_ = result.leaves_live_ = static_cast<std::uint32_t>(result.leaves_.size());
    std::size_t next = 0;
    for (std::uint32_t i = 0; i < result.leaves_.size(); ++i) {
        const std::size_t count = topology.counts[i];
        if (count == 0 || count > bvh_lanes || count > topology.items.size() - next) return false;
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            const std::uint32_t item = topology.items[next++];
            if (item >= boxes.size() || result.positions_[item] != position_none) return false;
            result.leaves_[i].index[lane] = item;
            result.positions_[item] = i * bvh_lanes + lane;
        }
    }
    if (next != topology.items.size()) return false;
    result.refit(boxes, nullptr);
    // It has removed the items that don't belong there.
    std::size_t items = 0;
    for (const Aabb<D>& box : boxes) items += is_empty(usable(box)) ? 0 : 1;
    if (result.items_ != topology.items.size() || items != result.items_) return false;
    for (BvhNode<D>& node : result.nodes_) node.built_area = node.area;
    *this = std::move(result);
    // Insertions need the levels above those of a build.
    if (check.depth() > bvh_binned_depth + 32) build(boxes, nullptr);
    return true;
}

template BvhTopology BvhTree<2>::topology() const;
template BvhTopology BvhTree<3>::topology() const;
template bool BvhTree<2>::build(std::span<const Aabb<2>>, const BvhTopology&);
template bool BvhTree<3>::build(std::span<const Aabb<3>>, const BvhTopology&);

}  // namespace abut::detail
