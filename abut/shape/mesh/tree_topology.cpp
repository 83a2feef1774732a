#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/tree_topology.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace abut::detail {
namespace {

class TopologyReader {
public:
    TopologyReader(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                   const MeshTreeTopology& topology)
        : points_(points), triangles_(triangles), topology_(topology) {}

    std::optional<MeshTree> tree() {
        const bool counted = topology_.order.size() == triangles_.size() &&
                             topology_.corners.size() == triangles_.size() && !topology_.counts.empty() &&
                             topology_.children.size() % mesh_lanes == 0;
        if (!counted || !add_leaves() || !add_nodes()) return std::nullopt;
        const bool has_nodes = !tree_.nodes.empty();
        if (!has_nodes && tree_.leaves.size() > 1) return std::nullopt;
        set_root(tree_, has_nodes ? 0 : bvh_leaf_bit, exact_);
        return std::move(tree_);
    }

private:
    /// Checks that each triangle is in one leaf and fits it.
    bool add_leaves() {
        std::vector<bool> is_used(triangles_.size(), false);
        for (const std::uint32_t item : topology_.order) {
            if (item >= is_used.size() || is_used[item]) return false;
            is_used[item] = true;
        }
        tree_.order.assign(topology_.order.begin(), topology_.order.end());
        tree_.leaves.reserve(topology_.counts.size());
        std::size_t first = 0;
        for (const std::uint8_t count : topology_.counts) {
            if (count == 0 || count > mesh_lanes || count > topology_.order.size() - first) return false;
            if (!add_leaf(static_cast<std::uint32_t>(first), count)) return false;
            first += count;
        }
        return first == topology_.order.size();
    }

    bool add_leaf(std::uint32_t first, std::uint32_t count) {
        constexpr std::uint32_t no_point = bvh_none;
        std::array<std::uint32_t, mesh_lanes> point;
        point.fill(no_point);
        MeshLeaf& leaf = tree_.leaves.emplace_back();
        Aabb3 box = Aabb3::empty();
        for (std::uint32_t lane = 0; lane < count; ++lane) {
            const std::uint32_t item = topology_.order[first + lane];
            if (lane > 0 && topology_.order[first + lane - 1] >= item) return false;
            const std::uint16_t numbers = topology_.corners[first + lane];
            if (numbers >= 1u << 9) return false;
            const glm::uvec3& t = triangles_[item];
            for (int k = 0; k < 3; ++k) {
                std::uint32_t& vertex = point[numbers >> 3 * k & 7u];
                if (vertex != no_point && vertex != t[k]) return false;
                vertex = t[k];
            }
            leaf.triangle[lane] = numbers;
            const BvhItem wide = item_of({points_[t.x], points_[t.y], points_[t.z]}, item, exact_);
            box = merged(box, Aabb3{{wide.min[0], wide.min[1], wide.min[2]}, {wide.max[0], wide.max[1], wide.max[2]}});
        }
        const auto end = std::find(point.begin(), point.end(), no_point);
        if (std::any_of(end, point.end(), [](std::uint32_t p) { return p != no_point; })) return false;
        for (std::uint32_t number = 0; number < mesh_lanes; ++number) {
            const Vec3& position = points_[point[number] != no_point ? point[number] : *(end - 1)];
            for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][number] = position[axis];
        }
        for (std::uint32_t lane = count; lane < mesh_lanes; ++lane) leaf.triangle[lane] = 0;
        leaf.first = first;
        leaf.used = (1u << count) - 1;
        set_sizes(leaf);
        leaf_boxes_.push_back(box);
        return true;
    }

    /// Checks that each node but the root, and each leaf, is the child of one node, and that children follow their
    /// parents.
    bool add_nodes() {
        const std::size_t count = topology_.children.size() / mesh_lanes;
        std::vector<bool> node_is_used(count, false), leaf_is_used(tree_.leaves.size(), false);
        std::vector<int> depth(count, 1);
        std::size_t child_count = 0;
        tree_.nodes.resize(count);
        for (std::uint32_t node = 0; node < count; ++node) {
            bool ended = false;
            for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
                const std::uint32_t ref = topology_.children[mesh_lanes * node + lane];
                tree_.nodes[node].child[lane] = ref;
                if (ended && ref != bvh_none) return false;
                ended = ended || ref == bvh_none;
                if (ended) continue;
                const std::uint32_t number = ref & ~bvh_leaf_bit;
                std::vector<bool>& those = is_leaf(ref) ? leaf_is_used : node_is_used;
                if (number >= those.size() || those[number] || (!is_leaf(ref) && number <= node)) return false;
                those[number] = true;
                ++child_count;
                if (is_leaf(ref)) continue;
                depth[number] = depth[node] + 1;
                if (depth[number] > bvh_depth) return false;
            }
        }
        if (count > 0 && child_count != count - 1 + leaf_is_used.size()) return false;
        set_boxes();
        return true;
    }

    /// Bottom-up: the last nodes have only leaves as children.
    void set_boxes() {
        std::vector<Aabb3> boxes(tree_.nodes.size(), Aabb3::empty());
        for (std::size_t node = boxes.size(); node-- > 0;) {
            MeshNode& rows = tree_.nodes[node];
            for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
                const std::uint32_t ref = rows.child[lane];
                if (ref == bvh_none) {
                    clear_box(rows, lane);
                    continue;
                }
                const Aabb3& box = is_leaf(ref) ? leaf_boxes_[ref & ~bvh_leaf_bit] : boxes[ref];
                rows.set(lane, box);
                boxes[node] = merged(boxes[node], box);
            }
        }
    }

    std::span<const Vec3> points_;
    std::span<const glm::uvec3> triangles_;
    const MeshTreeTopology& topology_;
    MeshTree tree_;
    Aabb3 exact_ = Aabb3::empty();
    std::vector<Aabb3> leaf_boxes_;
};

}  // namespace

MeshTreeTopology topology_of(const MeshTree& tree) {
    MeshTreeTopology topology;
    topology.order.assign(tree.order.begin(), tree.order.end());
    for (const MeshLeaf& leaf : tree.leaves) {
        topology.counts.push_back(static_cast<std::uint8_t>(leaf.count()));
        topology.corners.insert(topology.corners.end(), leaf.triangle, leaf.triangle + leaf.count());
    }
    for (const MeshNode& node : tree.nodes)
        topology.children.insert(topology.children.end(), node.child, node.child + mesh_lanes);
    return topology;
}

std::optional<MeshTree> build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                                        const MeshTreeTopology& topology) {
    return TopologyReader(points, triangles, topology).tree();
}

}  // namespace abut::detail
