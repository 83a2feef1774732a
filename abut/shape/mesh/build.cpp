// Builds the tree of a mesh by the surface area heuristic: binned splits as in a Bvh for many triangles, exhaustive
// splits for few, and then an optimal collapse of the binary tree to eight children.

#include <abut/broad_phase/bvh/node.hpp>
#include <abut/broad_phase/bvh/split.hpp>
#include <abut/broad_phase/bvh/surface_area.hpp>
#include <abut/math/detail/radix_sort.hpp>
#include <abut/math/simd/lanes-inl.h>
#include <abut/math/simd/square_root.hpp>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {
namespace {

/// The maximum size of a small set; the bits of one word hold its vertices.
inline constexpr std::uint32_t max_small_set = 16;

/// An accumulating bounding box.
class GrowingBox {
public:
    void add(const BvhItem& item) {
        low_ = lanes::lesser(low_, lanes::at(item.min));
        high_ = lanes::greater(high_, lanes::at(item.max));
    }
    float area() const {
        const lanes::Floats4 extent = high_ - low_;
        const lanes::Floats4 sides = extent * lanes::shuffled<1, 2, 0, 3>(extent, extent);
        return sides[0] + sides[1] + sides[2];
    }
    Aabb3 box() const { return {{low_[0], low_[1], low_[2]}, {high_[0], high_[1], high_[2]}}; }

private:
    lanes::Floats4 low_ = lanes::Floats4(std::numeric_limits<float>::infinity());
    lanes::Floats4 high_ = lanes::Floats4(-std::numeric_limits<float>::infinity());
};

/// The number of set bits, by arithmetic. std::popcount is a function call on targets without the instruction.
int popcount(std::uint64_t bits) {
    bits -= bits >> 1 & 0x5555555555555555;
    bits = (bits & 0x3333333333333333) + (bits >> 2 & 0x3333333333333333);
    bits = (bits + (bits >> 4)) & 0x0F0F0F0F0F0F0F0F;
    return static_cast<int>(bits * 0x0101010101010101 >> 56);
}

bool fits_one_leaf(std::uint32_t count, std::uint64_t corners) {
    return count <= mesh_lanes && popcount(corners) <= static_cast<int>(mesh_lanes);
}

/// An estimate of the leaves that a set of triangles with these vertices needs.
float estimated_leaves(std::uint32_t count, std::uint64_t corners) {
    return fits_one_leaf(count, corners) ? 1.0f : std::max(2.0f, 0.2f * static_cast<float>(count));
}

constexpr std::uint8_t no_vertex = 255;

/// A sort key: orders by the float, then by the index.
std::uint64_t key(float place, std::uint32_t index) {
    return std::uint64_t{key_of(place)} << 32 | index;
}

/// Sorts by counting ranks in O(n^2), without branches; fast for few keys. No two keys are equal.
void sort(const std::array<std::uint64_t, max_small_set>& keys, std::uint32_t count,
          std::array<std::uint8_t, max_small_set>& order) {
    std::array<std::uint32_t, max_small_set> rank{};
    for (std::uint32_t i = 1; i < count; ++i) {
        std::uint32_t before = 0;
        for (std::uint32_t j = 0; j < i; ++j) {
            const std::uint32_t is_before = keys[j] < keys[i] ? 1 : 0;
            before += is_before;
            rank[j] += 1 - is_before;
        }
        rank[i] = before;
    }
    for (std::uint32_t i = 0; i < count; ++i) order[rank[i]] = static_cast<std::uint8_t>(i);
}

/// The extent |x| + |y| + |z| of the box of a leaf's vertices, rounded up.
float extent_of(const MeshLeaf& leaf) {
    float result = 0;
    for (const auto& row : leaf.corner) {
        const lanes::Floats4 a = lanes::at(row), b = lanes::at(row + 4);
        result += (lanes::greatest_lane(lanes::greater(a, b)) - lanes::least_lane(lanes::lesser(a, b))) * (1 + 1e-6f);
    }
    // Products that underflow aren't bounded by their factors.
    return result > 1e-9f && result < 1e12f ? result : std::numeric_limits<float>::infinity();
}

/// The square of twice the area of a leaf's largest triangle.
float largest_squared_area(const MeshLeaf& leaf) {
    float result = 0;
    for (std::uint32_t rest = leaf.used; rest != 0; rest &= rest - 1) {
        const Triangle3 t = leaf.at(static_cast<std::uint32_t>(std::countr_zero(rest)));
        const Vec3 ab = t.b - t.a, ac = t.c - t.a;
        const Vec3 normal{ab.y * ac.z - ab.z * ac.y, ab.z * ac.x - ab.x * ac.z, ab.x * ac.y - ab.y * ac.x};
        result = std::max(result, normal.x * normal.x + normal.y * normal.y + normal.z * normal.z);
    }
    return result;
}

/// An immutable small set of triangles. A part of it is given by its order along each axis.
class SmallTriangleSet {
public:
    /// `same` maps each point to the lowest index at its position.
    SmallTriangleSet(std::span<const BvhItem> items, std::span<const glm::uvec3> triangles,
                     std::span<const std::uint32_t> same)
        : count_(static_cast<std::uint32_t>(items.size())) {
        std::array<std::uint8_t, 256> table;
        table.fill(no_vertex);
        for (std::uint32_t i = 0; i < count_; ++i) {
            items_[i] = items[i];
            const glm::uvec3& t = triangles[items[i].index];
            triangle_vertices_[i] = {vertex_number(same[t.x], table), vertex_number(same[t.y], table),
                                     vertex_number(same[t.z], table)};
            vertex_bits_[i] = VertexBits{1} << triangle_vertices_[i][0] | VertexBits{1} << triangle_vertices_[i][1] |
                              VertexBits{1} << triangle_vertices_[i][2];
        }
    }

    struct Part {
        std::array<std::array<std::uint8_t, max_small_set>, 3> order;
        std::uint32_t count = 0;
    };

    SmallTriangleSet::Part all() const {
        Part result;
        result.count = count_;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::array<std::uint64_t, max_small_set> keys;
            for (std::uint32_t i = 0; i < count_; ++i)
                keys[i] = key(items_[i].min[axis] + items_[i].max[axis], items_[i].index);
            sort(keys, count_, result.order[axis]);
        }
        return result;
    }

    /// True if the part fits in one leaf.
    bool fits_leaf(const Part& part) const {
        if (part.count > mesh_lanes) return false;
        VertexBits corners = 0;
        for (std::uint32_t i = 0; i < part.count; ++i) corners |= vertex_bits_[part.order[0][i]];
        return fits_one_leaf(part.count, corners);
    }

    Aabb3 box(const Part& part) const {
        GrowingBox result;
        for (std::uint32_t i = 0; i < part.count; ++i) result.add(items_[part.order[0][i]]);
        return result.box();
    }

    /// Writes a part that fits one leaf. The triangles' indices in the mesh go to `order`.
    void fill(const Part& part, std::span<const Vec3> points, MeshLeaf& leaf, std::uint32_t* order) const {
        std::array<std::uint64_t, max_small_set> keys;
        VertexBits corners = 0;
        for (std::uint32_t i = 0; i < part.count; ++i) {
            const std::uint8_t item = part.order[0][i];
            keys[i] = std::uint64_t{items_[item].index} << 32 | item;
            corners |= vertex_bits_[item];
        }
        std::array<std::uint8_t, max_small_set> by_index;
        sort(keys, part.count, by_index);
        std::array<std::uint32_t, 3 * max_small_set> number;
        std::uint32_t count = 0;
        Vec3 position{};
        for (VertexBits rest = corners; rest != 0; rest &= rest - 1) {
            const auto known = static_cast<std::uint32_t>(std::countr_zero(rest));
            position = points[vertices_[known]];
            for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
            number[known] = count++;
        }
        for (; count < mesh_lanes; ++count)
            for (int axis = 0; axis < 3; ++axis) leaf.corner[axis][count] = position[axis];
        for (std::uint32_t lane = 0; lane < part.count; ++lane) {
            const auto item = static_cast<std::uint32_t>(keys[by_index[lane]] & 0xFFFFFFFF);
            const auto& c = triangle_vertices_[item];
            leaf.triangle[lane] = static_cast<std::uint16_t>(number[c[0]] | number[c[1]] << 3 | number[c[2]] << 6);
            order[lane] = items_[item].index;
        }
        for (std::uint32_t lane = part.count; lane < mesh_lanes; ++lane) leaf.triangle[lane] = 0;
        leaf.used = (1u << part.count) - 1;
        set_sizes(leaf);
    }

    /// Splits a part of two or more triangles where the sum of side areas times estimated leaf counts is smallest.
    void split(const Part& part, Part& left, Part& right) const {
        const std::uint32_t count = part.count;
        std::size_t best_axis = 0;
        std::uint32_t best_count = 0;
        float best_cost = std::numeric_limits<float>::infinity();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto& order = part.order[axis];
            std::array<float, max_small_set> right_cost;
            GrowingBox after, before;
            VertexBits used_vertices = 0;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                after.add(items_[order[i]]);
                used_vertices |= vertex_bits_[order[i]];
                right_cost[i] = after.area() * estimated_leaves(count - i, used_vertices);
            }
            used_vertices = 0;
            for (std::uint32_t i = 1; i < count; ++i) {
                before.add(items_[order[i - 1]]);
                used_vertices |= vertex_bits_[order[i - 1]];
                const float cost = before.area() * estimated_leaves(i, used_vertices) + right_cost[i];
                if (cost < best_cost || best_count == 0) {
                    best_cost = cost;
                    best_axis = axis;
                    best_count = i;
                }
            }
        }
        std::uint32_t on_left = 0;
        for (std::uint32_t i = 0; i < best_count; ++i) on_left |= 1u << part.order[best_axis][i];
        left.count = best_count;
        right.count = count - best_count;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::uint32_t to_left = 0, to_right = 0;
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint8_t item = part.order[axis][i];
                // Written to both sides: the side is unpredictable.
                const std::uint32_t is_left = on_left >> item & 1u;
                left.order[axis][to_left] = item;
                right.order[axis][to_right] = item;
                to_left += is_left;
                to_right += 1 - is_left;
            }
        }
    }

private:
    using VertexBits = std::uint64_t;

    /// The vertex number of a point, found by a hash table with linear probing. Branch-free at the end, since new
    /// points are unpredictable.
    std::uint8_t vertex_number(std::uint32_t point, std::array<std::uint8_t, 256>& table) {
        std::uint32_t place = point * 0x9E3779B1u >> 24;
        while (table[place] != no_vertex && vertices_[table[place]] != point) place = (place + 1) & 255;
        const bool is_new = table[place] == no_vertex;
        const auto result = static_cast<std::uint8_t>(is_new ? vertex_count_ : table[place]);
        table[place] = result;
        vertices_[result] = point;
        vertex_count_ += is_new ? 1 : 0;
        return result;
    }

    std::uint32_t count_, vertex_count_ = 0;
    std::array<BvhItem, max_small_set> items_;
    std::array<std::array<std::uint8_t, 3>, max_small_set>
        triangle_vertices_;                                  ///< corners of each triangle, as indices into `vertices_`
    std::array<VertexBits, max_small_set> vertex_bits_;      ///< corners of each triangle as a bit set
    std::array<std::uint32_t, 3 * max_small_set> vertices_;  ///< point indices
};

}  // namespace

void set_sizes(MeshLeaf& leaf) {
    leaf.extent = extent_of(leaf);
    // The second term also covers the rounding of the first.
    leaf.min_area = 4e-3f * square_root(largest_squared_area(leaf)) + 1.1e-5f * leaf.extent * leaf.extent;
}

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
        storage_.reserve(count);
        Aabb3 exact = Aabb3::empty();
        for (std::uint32_t i = 0; i < count; ++i) storage_.push_back(item_of(triangle(i), i, exact));
        items_ = storage_.data();
        tree_.leaves.reserve(count / 4 + 1);
        tree_.nodes.reserve(count / 20 + 1);
        tree_.order.reserve(count);
        BvhRange<3> all = whole_range<3>(items_, 0, count, 0);
        all.leaves = count;
        bounded_ = is_bounded(all.box);
        nodes_.reserve(count / 2 + 1);
        const std::uint32_t root = grow(all);
        set_root(tree_, add(root), exact);
        trim(tree_.leaves);
        trim(tree_.nodes);
    }

private:
    /// Gives back capacity if it is much. A copy to new memory takes up to a third of the time of a build; capacity
    /// that isn't used has no memory from the system in a large array.
    template <class Array>
    static void trim(Array& array) {
        if (array.capacity() > array.size() + array.size() / 2) array.shrink_to_fit();
    }

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
    std::vector<BvhItem, LargePages<BvhItem>> storage_;
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
