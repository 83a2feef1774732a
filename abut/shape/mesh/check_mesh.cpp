#include <abut/math/detail/no_index.hpp>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/check_mesh.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

namespace abut::detail {
namespace {

/// Bits that are set once each.
class OnceSet {
public:
    explicit OnceSet(std::size_t size) : size_(size), words_((size + 63) / 64) {}

    /// False if the bit is set already or out of range.
    bool add(std::uint32_t bit) {
        if (bit >= size_) return false;
        std::uint64_t& word = words_[bit / 64];
        const std::uint64_t mask = std::uint64_t{1} << bit % 64, before = word;
        word |= mask;
        ++count_;
        return (before & mask) == 0;
    }
    bool is_full() const { return count_ == size_; }

private:
    std::size_t size_, count_ = 0;
    std::vector<std::uint64_t> words_;
};

/// Neighbours are triangles, or one of the two numbers that name none, which are the largest.
MeshFault fault_of_neighbours(const MeshSurface& surface) {
    const auto& neighbours = surface.adjacency.neighbours;
    constexpr std::uint32_t names = 2;
    static_assert(no_neighbour + names == 1 && many_neighbours + names == 0);
    const auto is_bad = [end = static_cast<std::uint32_t>(surface.triangles.size())](std::uint32_t neighbour) {
        return neighbour + names >= end + names;
    };
    bool any_bad = false;
    for (const auto& row : neighbours)
        for (const std::uint32_t neighbour : row) any_bad |= is_bad(neighbour);  // without a branch, for SIMD
    if (!any_bad) return {};
    const auto bad = std::find_if(neighbours.begin(), neighbours.end(),
                                  [&](const auto& row) { return std::any_of(row.begin(), row.end(), is_bad); });
    return {"names a neighbour that doesn't exist", static_cast<std::size_t>(bad - neighbours.begin())};
}

/// Whether the numbers of a leaf are those of one that begins at `first`, with `left` triangles to come.
bool is_sound(const MeshLeaf& leaf, std::size_t first, std::size_t left) {
    const std::uint32_t count = leaf.count();
    bool sound = count > 0 && count <= std::min<std::size_t>(mesh_lanes, left) && leaf.used == (1u << count) - 1 &&
                 leaf.first == first;
    std::uint32_t beyond = 0;
    for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) beyond |= lane < count ? 0u : leaf.triangle[lane];
    for (const std::uint16_t numbers : leaf.triangle) beyond |= numbers & ~511u;
    return sound && beyond == 0;
}

/// Each triangle is in one leaf.
MeshFault fault_of_leaves(const MeshSurface& surface) {
    const MeshTree& tree = surface.tree;
    const std::size_t count = surface.triangles.size();
    OnceSet is_used(count);
    std::size_t first = 0;
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
        const std::uint32_t in_leaf = tree.leaves[i].count();
        if (!is_sound(tree.leaves[i], first, count - first)) return {"has a leaf that contradicts itself", i};
        for (const std::uint32_t item : std::span(tree.order).subspan(first, in_leaf))
            if (!is_used.add(item)) return {"has a triangle in two leaves", i};
        first += in_leaf;
    }
    return first == count ? MeshFault{} : MeshFault{"has a triangle in no leaf"};
}

/// Whether all vertices of a leaf are within a box, and finite.
bool is_within(const MeshLeaf& leaf, const Aabb3& box) {
    constexpr float largest = std::numeric_limits<float>::max();
    bool result = true;
    for (int axis = 0; axis < 3; ++axis) {
        const float low = std::max(box.min[axis], -largest), high = std::min(box.max[axis], largest);
        for (const float x : leaf.corner[axis]) result &= (x >= low) & (x <= high);
    }
    return result;
}
bool is_within(const Aabb3& inner, const Aabb3& outer) {
    bool result = true;
    for (int axis = 0; axis < 3; ++axis) {
        result &= inner.min[axis] >= outer.min[axis];
        result &= inner.max[axis] <= outer.max[axis];
    }
    return result;
}

/// Whether the lane has the bits of a box that no query overlaps.
bool is_clear(const MeshNode& node, std::uint32_t lane) {
    static const MeshNode clear = [] {
        MeshNode result;
        clear_box(result, 0);
        return result;
    }();
    bool result = true;
    for (int axis = 0; axis < 3; ++axis)
        result &=
            std::bit_cast<std::uint32_t>(node.min[axis][lane]) == std::bit_cast<std::uint32_t>(clear.min[axis][0]) &&
            std::bit_cast<std::uint32_t>(node.max[axis][lane]) == std::bit_cast<std::uint32_t>(clear.max[axis][0]);
    return result;
}

/// Children follow their parents, so there are no cycles.
MeshFault fault_of_nodes(const MeshTree& tree, const Aabb3& exact) {
    if (tree.nodes.empty())
        return tree.leaves.size() == 1 && is_within(tree.leaves[0], exact)
                   ? MeshFault{}
                   : MeshFault{"has leaves that no node refers to, or another box than its leaf"};
    if (!is_within(exact, tree.nodes[0].bounds())) return {"has a box that its tree doesn't have"};
    OnceSet node_is_used(tree.nodes.size()), leaf_is_used(tree.leaves.size());
    std::vector<std::uint8_t> depth(tree.nodes.size(), 1);
    static_assert(bvh_depth < 255);
    node_is_used.add(0);
    for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
        const MeshNode& node = tree.nodes[i];
        for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
            const std::uint32_t ref = node.child[lane];
            if (ref == bvh_none) {
                if (!is_clear(node, lane)) return {"has a node with a box and no child", i};
                continue;
            }
            if (lane > 0 && node.child[lane - 1] == bvh_none) return {"has a node with a gap", i};
            const bool leaf = is_leaf(ref);
            if (!leaf && ref <= i) return {"has a node below itself", i};
            if (!(leaf ? leaf_is_used : node_is_used).add(ref & ~bvh_leaf_bit))
                return {"has a node with a child that doesn't exist or has another parent", i};
            const Aabb3 box = node.box(lane);
            if (!(leaf ? is_within(tree.leaf(ref), box) : is_within(tree.nodes[ref].bounds(), box)))
                return {"has a node whose box is too small", i};
            if (leaf) continue;
            depth[ref] = static_cast<std::uint8_t>(depth[i] + 1);
            if (depth[ref] > bvh_depth) return {"has a tree that is too deep", i};
        }
    }
    if (!node_is_used.is_full() || !leaf_is_used.is_full()) return {"has leaves or nodes that no node refers to"};
    return {};
}

}  // namespace

MeshFault fault_of(const MeshSurface& surface, const Aabb3& exact) {
    const std::size_t count = surface.triangles.size();
    if (surface.adjacency.closed == surface.components.empty())
        return {"has components without being closed, or is closed without any"};
    if (!is_finite<3>(exact.min) || !is_finite<3>(exact.max)) return {"has a box that is not finite"};
    for (int axis = 0; axis < 3; ++axis)
        if (!(exact.min[axis] <= exact.max[axis])) return {"has an empty box"};
    for (std::size_t i = 0; i < surface.components.size(); ++i)
        if (surface.components[i] >= count || (i > 0 && surface.components[i] <= surface.components[i - 1]))
            return {"has components out of order", i};
    if (const MeshFault fault = fault_of_neighbours(surface); fault.what != nullptr) return fault;
    if (const MeshFault fault = fault_of_leaves(surface); fault.what != nullptr) return fault;
    return fault_of_nodes(surface.tree, exact);
}

}  // namespace abut::detail
