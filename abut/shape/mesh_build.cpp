// The tree of a mesh from nothing: parted as that of a Bvh is while there are many triangles, and where they are few by
// trying every place on each axis, for it is there that the leaves are made.

#include <abut/broad_phase/bvh_jobs.hpp>
#include <abut/broad_phase/bvh_size.hpp>
#include <abut/broad_phase/bvh_split.hpp>
#include <abut/shape/mesh_tree.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <new>

namespace abut {
namespace {

/// So few triangles are parted by trying all places; their corners are told by the bits of one word.
constexpr std::uint32_t few_items = 16;

using Corners = std::uint64_t;

struct Range : BvhRange<3> {
    bool is_leaf;
};

/// A node of the tree of two children each that comes first, with what it costs to make it one of eight.
struct Fork {
    static constexpr std::size_t most = mesh_lanes - 1;

    Aabb3 box;
    std::uint32_t left, right;  ///< forks; of a leaf, its first item and the one after its last
    bool is_leaf;
    /// The least sum of the areas of all nodes that are made of what is below, if it hangs as at most i + 1 children on
    /// the node above; and how many of these are left, 0 where it is a child by itself.
    std::array<float, most> cost;
    std::array<std::uint8_t, most> to_left;
    std::uint8_t own_to_left;  ///< of the eight children that it has as a node
};

/// The box of a triangle, wider by what the search for a ray's hit may take for hit.
BvhItem item_of(const Triangle3& t, std::uint32_t index) {
    BvhItem result{{0, 0, 0}, index, {0, 0, 0}, 0};
    float sum = 0;
    for (int i = 0; i < 3; ++i) {
        result.min[i] = std::min({t.a[i], t.b[i], t.c[i]});
        result.max[i] = std::max({t.a[i], t.b[i], t.c[i]});
        sum += result.max[i] - result.min[i];
    }
    for (int i = 0; i < 3; ++i) {
        result.min[i] -= 0x1p-22f * sum + 0x1p-23f * std::abs(result.min[i]);
        result.max[i] += 0x1p-22f * sum + 0x1p-23f * std::abs(result.max[i]);
    }
    return result;
}

/// A box that grows, as a plain array: quicker than an Aabb where there are thousands.
struct Grown {
    std::array<float, 3> min, max;

    Grown() {
        min.fill(std::numeric_limits<float>::infinity());
        max.fill(-std::numeric_limits<float>::infinity());
    }
    void add(const BvhItem& item) {
        for (std::size_t i = 0; i < 3; ++i) {
            min[i] = std::min(min[i], item.min[i]);
            max[i] = std::max(max[i], item.max[i]);
        }
    }
    float area() const {
        const float x = max[0] - min[0], y = max[1] - min[1], z = max[2] - min[2];
        return x * y + y * z + z * x;
    }
    Aabb3 box() const { return {{min[0], min[1], min[2]}, {max[0], max[1], max[2]}}; }
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
        for (std::uint32_t i = 0; i < count; ++i) {
            const Triangle3 t = triangle(i);
            exact = merged(exact, merged(Aabb3{t.a, t.a}, merged(Aabb3{t.b, t.b}, Aabb3{t.c, t.c})));
            items_[i] = item_of(t, i);
        }
        tree_.leaves.reserve(count / 4 + 1);
        tree_.nodes.reserve(count / 20 + 1);
        tree_.order.reserve(count);
        Range all{whole_range<3>(items_, 0, count, 0), false};
        all.leaves = count;
        bounded_ = is_bounded(all.box);
        all.is_leaf = fits(all);
        forks_.reserve(count / 2 + 1);
        const std::uint32_t root = grow(all);
        tree_.roots[0] = {add(root), exact};
        tree_.leaves.shrink_to_fit();
        tree_.nodes.shrink_to_fit();
    }

private:
    Triangle3 triangle(std::uint32_t index) const {
        const glm::uvec3& t = triangles_[index];
        return {points_[t.x], points_[t.y], points_[t.z]};
    }

    std::uint32_t grow(const Range& range) {
        Fork fork{range.box, range.begin, range.end, range.is_leaf, {}, {}, 0};
        if (!range.is_leaf) {
            Range left, right;
            part(range, left, right);
            fork.left = grow(left);
            fork.right = grow(right);
            find_costs(fork);
        }
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
        if (fork.is_leaf) return add_leaf(fork.left, fork.right);
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

    void part(const Range& range, Range& left, Range& right) {
        if (range.count() > few_items)
            split<3>(items_, bounded_, range, left, right);
        else
            part_few(range, left, right);
        left.leaves = left.count();
        right.leaves = right.count();
        left.is_leaf = fits(left);
        right.is_leaf = fits(right);
    }

    /// The corners of a few items, a bit each.
    void name_corners(const BvhRange<3>& range, std::array<Corners, few_items>& named) const {
        std::array<std::uint32_t, 3 * few_items> known;
        std::uint32_t count = 0;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const glm::uvec3& t = triangles_[items_[i].index];
            Corners bits = 0;
            for (glm::length_t k = 0; k < 3; ++k) {
                const std::uint32_t point = same_[t[k]];
                std::uint32_t number = 0;
                while (number < count && known[number] != point) ++number;
                if (number == count) known[count++] = point;
                bits |= Corners{1} << number;
            }
            named[i - range.begin] = bits;
        }
    }

    bool fits(const BvhRange<3>& range) const {
        if (range.count() > mesh_lanes) return false;
        std::array<Corners, few_items> corners;
        name_corners(range, corners);
        Corners all = 0;
        for (std::uint32_t i = 0; i < range.count(); ++i) all |= corners[i];
        return fit(range.count(), all);
    }
    static bool fit(std::uint32_t count, Corners corners) {
        return count <= mesh_lanes && std::popcount(corners) <= static_cast<int>(mesh_lanes);
    }
    /// About how many leaves so many triangles with these corners become.
    static float leaves_of(std::uint32_t count, Corners corners) {
        return fit(count, corners) ? 1.0f : std::max(2.0f, 0.2f * static_cast<float>(count));
    }

    /// Where the areas of the two sides, each times its leaves, are least.
    void part_few(const Range& range, Range& left, Range& right) {
        const std::uint32_t count = range.count();
        BvhItem* items = items_ + range.begin;
        std::array<Corners, few_items> corners;
        name_corners(range, corners);
        using Order = std::array<std::uint8_t, few_items>;
        Order best{};
        std::uint32_t best_count = 0;
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Order order = sorted(items, count, axis);
            std::array<float, few_items> right_cost;
            Grown box;
            Corners seen = 0;
            for (std::uint32_t i = count - 1; i > 0; --i) {
                box.add(items[order[i]]);
                seen |= corners[order[i]];
                right_cost[i] = box.area() * leaves_of(count - i, seen);
            }
            box = Grown();
            seen = 0;
            for (std::uint32_t i = 1; i < count; ++i) {
                box.add(items[order[i - 1]]);
                seen |= corners[order[i - 1]];
                const float cost = box.area() * leaves_of(i, seen) + right_cost[i];
                if (cost < least || best_count == 0) {
                    least = cost;
                    best = order;
                    best_count = i;
                }
            }
        }
        std::array<BvhItem, few_items> parted;
        for (std::uint32_t i = 0; i < count; ++i) parted[i] = items[best[i]];
        std::copy_n(parted.begin(), count, items);
        const std::uint32_t middle = range.begin + best_count;
        left = side(range.begin, middle, range.depth + 1);
        right = side(middle, range.end, range.depth + 1);
    }

    /// Their places along an axis; the lower index first where they are equal.
    static std::array<std::uint8_t, few_items> sorted(const BvhItem* items, std::uint32_t count, std::size_t axis) {
        std::array<std::uint8_t, few_items> order{};
        std::array<float, few_items> places;
        for (std::uint32_t i = 0; i < count; ++i) {
            const float place = items[i].min[axis] + items[i].max[axis];
            std::uint32_t to = i;
            for (; to > 0 &&
                   (places[to - 1] > place || (places[to - 1] == place && items[order[to - 1]].index > items[i].index));
                 --to) {
                places[to] = places[to - 1];
                order[to] = order[to - 1];
            }
            places[to] = place;
            order[to] = static_cast<std::uint8_t>(i);
        }
        return order;
    }

    Range side(std::uint32_t begin, std::uint32_t end, int depth) const {
        Grown box;
        for (std::uint32_t i = begin; i < end; ++i) box.add(items_[i]);
        return {{begin, end, 0, depth, box.box()}, false};
    }

    std::uint32_t add_leaf(std::uint32_t begin, std::uint32_t end) {
        const std::uint32_t count = end - begin;
        std::sort(items_ + begin, items_ + end, [](const BvhItem& a, const BvhItem& b) { return a.index < b.index; });
        MeshLeaf& leaf = tree_.leaves.emplace_back();
        leaf.first = static_cast<std::uint32_t>(tree_.order.size());
        leaf.count = count;
        leaf.extent = 0;
        std::array<std::uint32_t, mesh_lanes> known{};
        std::uint32_t corners = 0;
        for (std::uint32_t lane = 0; lane < mesh_lanes; ++lane) {
            leaf.triangle[lane] = 0;
            if (lane >= count) continue;
            const std::uint32_t index = items_[begin + lane].index;
            tree_.order.push_back(index);
            std::uint32_t numbers = 0;
            for (glm::length_t k = 0; k < 3; ++k) {
                const std::uint32_t point = same_[triangles_[index][k]];
                std::uint32_t number = 0;
                while (number < corners && known[number] != point) ++number;
                if (number == corners) known[corners++] = point;
                numbers |= number << (3 * k);
            }
            leaf.triangle[lane] = static_cast<std::uint16_t>(numbers);
        }
        for (std::uint32_t number = 0; number < mesh_lanes; ++number)
            for (int axis = 0; axis < 3; ++axis)
                leaf.corner[axis][number] = points_[known[std::min(number, corners - 1)]][axis];
        for (std::uint32_t lane = 0; lane < count; ++lane) leaf.extent = std::max(leaf.extent, extent(leaf.at(lane)));
        return static_cast<std::uint32_t>(tree_.leaves.size() - 1) | bvh_leaf_bit;
    }

    static float extent(const Triangle3& t) {
        const Vec3 ab = t.b - t.a, ac = t.c - t.a;
        const float of_ab = std::abs(ab.x) + std::abs(ab.y) + std::abs(ab.z);
        const float of_ac = std::abs(ac.x) + std::abs(ac.y) + std::abs(ac.z);
        return std::max(of_ab, of_ac) * (1 + 1e-6f);
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

MeshTree build_mesh_tree(std::span<const Vec3> points, std::span<const glm::uvec3> triangles,
                         std::span<const std::uint32_t> same) {
    MeshTree tree;
    Builder(points, triangles, same, tree).build();
    return tree;
}

}  // namespace abut
