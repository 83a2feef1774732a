// The tree of a mesh from nothing: parted as that of a Bvh is while there are many triangles, and with more care where
// they are few.

#include <abut/broad_phase/bvh_jobs.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/bvh_split.hpp>
#include <abut/shape/mesh_few.hpp>
#include <abut/shape/mesh_tree_parts.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>

namespace abut {
namespace {

/// A node of the tree of two children each that comes first, with what it costs to make it one of eight.
struct Fork {
    static constexpr std::size_t most = mesh_lanes - 1;

    Aabb3 box;
    std::uint32_t left, right;  ///< forks; of a leaf, itself and nothing
    bool is_leaf;
    /// The least sum of the areas of all nodes that are made of what is below, if it hangs as at most i + 1 children on
    /// the node above; and how many of these are left, 0 where it is a child by itself.
    std::array<float, most> cost;
    std::array<std::uint8_t, most> to_left;
    std::uint8_t own_to_left;  ///< of the eight children that it has as a node
};

class Builder {
public:
    Builder(std::span<const Vec3> points, std::span<const glm::uvec3> triangles, std::span<const std::uint32_t> same,
            MeshTree& tree)
        : points_(points), triangles_(triangles), same_(same), tree_(tree) {}

    void build() {
        const auto count = static_cast<std::uint32_t>(triangles_.size());
        room_ = std::make_unique_for_overwrite<BvhItem[]>(count);
        items_ = room_.get();
        Aabb3 exact = Aabb3::empty();
        for (std::uint32_t i = 0; i < count; ++i) items_[i] = item_of(triangle(i), i, exact);
        tree_.leaves.reserve(count / 4 + 1);
        tree_.nodes.reserve(count / 20 + 1);
        tree_.order.reserve(count);
        BvhRange<3> all = whole_range<3>(items_, 0, count, 0);
        all.leaves = count;
        bounded_ = is_bounded(all.box);
        forks_.reserve(count / 2 + 1);
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
        if (range.count() <= mesh_few) {
            const FewTriangles few({items_ + range.begin, range.count()}, triangles_, same_);
            return grow(few, few.all(), range.box);
        }
        BvhRange<3> left, right;
        split<3>(items_, bounded_, range, left, right);
        left.leaves = left.count();
        right.leaves = right.count();
        const std::uint32_t to_left = grow(left);
        return join(range.box, to_left, grow(right));
    }

    /// The leaves follow one another as they are come upon.
    std::uint32_t grow(const FewTriangles& few, const FewTriangles::Part& part, const Aabb3& box) {
        if (few.fit(part)) return put({box, add_leaf(few, part), 0, true, {}, {}, 0});
        FewTriangles::Part left, right;
        few.split(part, left, right);
        const std::uint32_t to_left = grow(few, left, few.box(left));
        return join(box, to_left, grow(few, right, few.box(right)));
    }

    std::uint32_t join(const Aabb3& box, std::uint32_t left, std::uint32_t right) {
        Fork fork{box, left, right, false, {}, {}, 0};
        find_costs(fork);
        return put(fork);
    }
    std::uint32_t put(const Fork& fork) {
        forks_.push_back(fork);
        return static_cast<std::uint32_t>(forks_.size() - 1);
    }

    /// As Ylitie, Karras and Laine do, "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017.
    /// The leaves are what they are; so only nodes cost anything.
    void find_costs(Fork& fork) const {
        const Fork &left = forks_[fork.left], &right = forks_[fork.right];
        const auto shared = [&](std::size_t children, std::uint8_t& to_left) {
            float least = std::numeric_limits<float>::infinity();
            to_left = 1;
            for (std::size_t i = 1; i < children; ++i) {
                const float cost = left.cost[i - 1] + right.cost[children - i - 1];
                if (!(cost < least)) continue;
                least = cost;
                to_left = static_cast<std::uint8_t>(i);
            }
            return least;
        };
        fork.cost[0] = shared(mesh_lanes, fork.own_to_left) + static_cast<float>(box_size(fork.box).area);
        for (std::size_t i = 1; i < Fork::most; ++i) {
            fork.cost[i] = shared(i + 1, fork.to_left[i]);
            if (fork.cost[i] < fork.cost[i - 1]) continue;
            fork.cost[i] = fork.cost[i - 1];
            fork.to_left[i] = fork.to_left[i - 1];
        }
    }

    struct Children {
        std::array<std::uint32_t, mesh_lanes> fork;
        std::uint32_t count = 0;
    };
    /// The children that a fork becomes, at most so many.
    void collect(std::uint32_t which, std::uint32_t most, Children& children) const {
        const Fork& fork = forks_[which];
        const std::uint32_t to_left = fork.is_leaf ? 0 : fork.to_left[most - 1];
        if (to_left == 0) {
            children.fork[children.count++] = which;
            return;
        }
        collect(fork.left, to_left, children);
        collect(fork.right, most - to_left, children);
    }

    std::uint32_t add(std::uint32_t which) {
        const Fork& fork = forks_[which];
        if (fork.is_leaf) return fork.left;
        Children children;
        collect(fork.left, fork.own_to_left, children);
        collect(fork.right, mesh_lanes - fork.own_to_left, children);
        const auto result = static_cast<std::uint32_t>(tree_.nodes.size());
        tree_.nodes.emplace_back();
        for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
            const bool used = lane < children.count;
            const std::uint32_t child = used ? add(children.fork[lane]) : bvh_none;
            MeshNode& node = tree_.nodes[result];
            node.child[lane] = child;
            if (used)
                node.set(lane, forks_[children.fork[lane]].box);
            else
                node.clear(lane);
        }
        return result;
    }

    std::uint32_t add_leaf(const FewTriangles& few, const FewTriangles::Part& part) {
        MeshLeaf& leaf = tree_.leaves.emplace_back();
        leaf.first = static_cast<std::uint32_t>(tree_.order.size());
        tree_.order.resize(tree_.order.size() + part.count);
        few.fill(part, points_, leaf, tree_.order.data() + leaf.first);
        return static_cast<std::uint32_t>(tree_.leaves.size() - 1) | bvh_leaf_bit;
    }

    std::span<const Vec3> points_;
    std::span<const glm::uvec3> triangles_;
    std::span<const std::uint32_t> same_;
    MeshTree& tree_;
    std::unique_ptr<BvhItem[]> room_;
    BvhItem* items_ = nullptr;
    bool bounded_ = true;
    std::vector<Fork, LargePages<Fork>> forks_;
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
    tree.spread = std::max(largest(low), largest(high)) < mesh_most
                      ? (high.x - low.x + high.y - low.y + high.z - low.z) * (0.5 + 1e-9)
                      : std::numeric_limits<double>::infinity();
}

MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same) {
    MeshTree tree;
    Builder(points, triangles, same, tree).build();
    return tree;
}

}  // namespace abut
