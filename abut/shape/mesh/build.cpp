// Builds the tree of a mesh by the surface area heuristic: binned splits as in a Bvh for many triangles, exhaustive
// splits for few, and then an optimal collapse of the binary tree to eight children.

#include <abut/broad_phase/bvh/split.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/leaf_split.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace abut::detail {
namespace {

/// A node of the binary tree that is built first, with the costs of its collapse into nodes of eight children.
struct BinaryNode {
    static constexpr std::size_t max_slots = mesh_lanes - 1;

    Aabb3 box;
    std::uint32_t left, right;  ///< child indices; for a leaf, its reference
    bool is_leaf;
    /// cost[i]: the minimum sum of the node areas below it if it contributes at most i + 1 children to the node above.
    /// to_left is the number of these from the left child; 0 if it is a child itself.
    std::array<float, max_slots> cost;
    std::array<std::uint8_t, max_slots> to_left;
    std::uint8_t own_to_left;  ///< left share of its eight children if it becomes a node
};

class Builder {
public:
    Builder(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same,
            MeshTree& tree)
        : points_(points), triangles_(triangles), same_(same), tree_(tree) {}

    void build() {
        const auto count = static_cast<std::uint32_t>(triangles_.size());
        storage_ = std::make_unique_for_overwrite<BvhItem[]>(count);
        items_ = storage_.get();
        Aabb3 exact = Aabb3::empty();
        for (std::uint32_t i = 0; i < count; ++i) items_[i] = item_of(triangle(i), i, exact);
        tree_.leaves.reserve(count / 4 + 1);
        tree_.nodes.reserve(count / 20 + 1);
        tree_.order.reserve(count);
        BvhRange<3> all = whole_range<3>(items_, 0, count, 0);
        all.leaves = count;
        bounded_ = is_bounded(all.box);
        nodes_.reserve(count / 2 + 1);
        const std::uint32_t root = grow(all);
        set_root(tree_, add(root), exact);
        tree_.leaves.shrink_to_fit();
        tree_.nodes.shrink_to_fit();
    }

private:
    Triangle3 triangle(std::uint32_t index) const {
        const glm::uvec3& t = triangles_[index];
        return {points_[t.x], points_[t.y], points_[t.z]};
    }

    std::uint32_t grow(const BvhRange<3>& range) {
        if (range.count() <= max_small_set) {
            const SmallTriangleSet small({items_ + range.begin, range.count()}, triangles_, same_);
            return grow(small, small.all(), range.box);
        }
        BvhRange<3> left, right;
        split<3>(items_, bounded_, range, left, right);
        left.leaves = left.count();
        right.leaves = right.count();
        const std::uint32_t to_left = grow(left);
        return join(range.box, to_left, grow(right));
    }

    /// Leaves are stored in the order of their creation.
    std::uint32_t grow(const SmallTriangleSet& small, const SmallTriangleSet::Part& part, const Aabb3& box) {
        if (small.fits_leaf(part)) return put({box, add_leaf(small, part), 0, true, {}, {}, 0});
        SmallTriangleSet::Part left, right;
        small.split(part, left, right);
        const std::uint32_t to_left = grow(small, left, small.box(left));
        return join(box, to_left, grow(small, right, small.box(right)));
    }

    std::uint32_t join(const Aabb3& box, std::uint32_t left, std::uint32_t right) {
        BinaryNode node{box, left, right, false, {}, {}, 0};
        find_costs(node);
        return put(node);
    }
    std::uint32_t put(const BinaryNode& node) {
        nodes_.push_back(node);
        return static_cast<std::uint32_t>(nodes_.size() - 1);
    }

    /// Dynamic programming of Ylitie, Karras and Laine, "Efficient incoherent ray traversal on GPUs through compressed
    /// wide BVHs", 2017. The leaves are fixed, so only inner nodes have a cost.
    void find_costs(BinaryNode& node) const {
        const BinaryNode &left = nodes_[node.left], &right = nodes_[node.right];
        const auto shared = [&](std::size_t children, std::uint8_t& to_left) {
            float best = std::numeric_limits<float>::infinity();
            to_left = 1;
            for (std::size_t i = 1; i < children; ++i) {
                const float cost = left.cost[i - 1] + right.cost[children - i - 1];
                if (!(cost < best)) continue;
                best = cost;
                to_left = static_cast<std::uint8_t>(i);
            }
            return best;
        };
        node.cost[0] = shared(mesh_lanes, node.own_to_left) + static_cast<float>(box_size(node.box).area);
        for (std::size_t i = 1; i < BinaryNode::max_slots; ++i) {
            node.cost[i] = shared(i + 1, node.to_left[i]);
            if (node.cost[i] < node.cost[i - 1]) continue;
            node.cost[i] = node.cost[i - 1];
            node.to_left[i] = node.to_left[i - 1];
        }
    }

    struct Children {
        std::array<std::uint32_t, mesh_lanes> nodes;
        std::uint32_t count = 0;
    };
    /// Collects at most `max_count` children that a binary node contributes.
    void collect(std::uint32_t which, std::uint32_t max_count, Children& children) const {
        const BinaryNode& node = nodes_[which];
        const std::uint32_t to_left = node.is_leaf ? 0 : node.to_left[max_count - 1];
        if (to_left == 0) {
            children.nodes[children.count++] = which;
            return;
        }
        collect(node.left, to_left, children);
        collect(node.right, max_count - to_left, children);
    }

    std::uint32_t add(std::uint32_t which) {
        const BinaryNode& node = nodes_[which];
        if (node.is_leaf) return node.left;
        Children children;
        collect(node.left, node.own_to_left, children);
        collect(node.right, mesh_lanes - node.own_to_left, children);
        const auto result = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
            const bool used = lane < children.count;
            const std::uint32_t child = used ? add(children.nodes[lane]) : bvh_none;
            MeshNode& rows = tree_.nodes[result];
            rows.child[lane] = child;
            if (used)
                rows.set(lane, nodes_[children.nodes[lane]].box);
            else
                clear_box(rows, lane);
        }
        return result;
    }

    std::uint32_t add_leaf(const SmallTriangleSet& small, const SmallTriangleSet::Part& part) {
        MeshLeaf& leaf = tree_.leaves.emplace_back();
        leaf.first = static_cast<std::uint32_t>(tree_.order.size());
        tree_.order.resize(tree_.order.size() + part.count);
        small.fill(part, points_, leaf, tree_.order.data() + leaf.first);
        return static_cast<std::uint32_t>(tree_.leaves.size() - 1) | bvh_leaf_bit;
    }

    std::span<const Vec3> points_;
    std::span<const glm::uvec3> triangles_;
    std::span<const std::uint32_t> same_;
    MeshTree& tree_;
    std::unique_ptr<BvhItem[]> storage_;
    BvhItem* items_ = nullptr;
    bool bounded_ = true;
    std::vector<BinaryNode, LargePages<BinaryNode>> nodes_;
};

}  // namespace

BvhItem item_of(const Triangle3& t, std::uint32_t index, Aabb3& all) {
    BvhItem result{{0, 0, 0}, index, {0, 0, 0}, 0};
    float sum = 0;
    for (int i = 0; i < 3; ++i) {
        result.min[i] = std::min({t.a[i], t.b[i], t.c[i]});
        result.max[i] = std::max({t.a[i], t.b[i], t.c[i]});
        all.min[i] = std::min(all.min[i], result.min[i]);
        all.max[i] = std::max(all.max[i], result.max[i]);
        sum += result.max[i] - result.min[i];
    }
    for (int i = 0; i < 3; ++i) {
        result.min[i] -= 0x1p-22f * sum + 0x1p-23f * std::abs(result.min[i]);
        result.max[i] += 0x1p-22f * sum + 0x1p-23f * std::abs(result.max[i]);
    }
    return result;
}

void set_root(MeshTree& tree, std::uint32_t ref, const Aabb3& exact) {
    tree.roots[0] = {ref, exact};
    const DVec<3> low(exact.min), high(exact.max);
    tree.middle = (low + high) * 0.5;
    tree.off_center = std::abs(tree.middle.x) + std::abs(tree.middle.y) + std::abs(tree.middle.z);
    tree.spread = std::max(largest(low), largest(high)) < max_mesh_extent
                      ? (high.x - low.x + high.y - low.y + high.z - low.z) * (0.5 + 1e-9)
                      : std::numeric_limits<double>::infinity();
}

MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same) {
    MeshTree tree;
    Builder(points, triangles, same, tree).build();
    return tree;
}

}  // namespace abut::detail
