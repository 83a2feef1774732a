// The data of a mesh: the numbers of points, triangles, leaves, nodes and components, flags, the box of all triangles,
// the points, the triangles, their neighbours, and the tree as it lies in memory.

#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/surface.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace abut::detail {
namespace {

/// What is wrong with loaded data, and the index of the triangle, leaf or node. Null `what`: nothing.
struct MeshFault {
    const char* what = nullptr;
    std::size_t index = 0;
};

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

/// Checks everything but the points and the corners of the triangles; `exact` is the box of all triangles. Without a
/// fault no query leaves the data, has numbers that are not finite, or takes longer than a search of all triangles:
/// every number names something, each leaf and each node but the root is the child of one node, the tree is of limited
/// depth, each triangle is in one leaf, and each leaf or node is within the box of its parent.
///
/// Not checked, since it takes as long as everything else: whether the leaves have the corners of the triangles,
/// whether triangles that are called neighbours are adjacent, and whether a mesh that says so is closed.
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

}  // namespace
template <>
struct BlobScalar<std::array<std::uint32_t, 3>> {
    using type = std::uint32_t;
};
/// Floats and references: all of four bytes.
template <>
struct BlobScalar<MeshNode> {
    using type = std::uint32_t;
};
template <>
struct BlobScalar<MeshLeaf> {
    using type = std::uint32_t;
};

namespace {

constexpr std::uint32_t closed_flag = 1, inward_flag = 2, all_mesh_flags = 3;

/// The numbers of 16 bits of a leaf in the order in which words of 32 bits hold them: on big-endian machines each two
/// trade places.
void order_halves([[maybe_unused]] std::span<MeshLeaf> leaves) {
    if constexpr (std::endian::native != std::endian::little)
        for (MeshLeaf& leaf : leaves)
            for (std::uint32_t lane = 0; lane < mesh_lanes; lane += 2)
                std::swap(leaf.triangle[lane], leaf.triangle[lane + 1]);
}

/// Quick tests without branches; what is wrong is found by the slow ones.
bool are_sound(std::span<const Vec3> points, std::span<const glm::uvec3> triangles) {
    constexpr float largest = std::numeric_limits<float>::max();
    bool finite = true;
    for (const Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis) finite &= std::abs(p[axis]) <= largest;
    std::uint32_t highest = 0;
    for (const glm::uvec3& t : triangles) highest = std::max(highest, std::max(t.x, std::max(t.y, t.z)));
    return finite && !triangles.empty() && highest < points.size();
}

}  // namespace
}  // namespace abut::detail

namespace abut {

using namespace detail;

std::vector<std::byte> save(const Mesh& mesh) {
    const MeshSurface& surface = mesh_surface(mesh);
    const MeshTree& tree = surface.tree;
    BlobWriter writer =
        begin_shape(SavedKind::mesh, 256 + surface.points.size() * sizeof(Vec3) +
                                         surface.triangles.size() * (2 * sizeof(glm::uvec3) + sizeof(std::uint32_t)) +
                                         tree.leaves.size() * sizeof(MeshLeaf) + tree.nodes.size() * sizeof(MeshNode) +
                                         surface.components.size() * sizeof(std::uint32_t));
    for (const std::size_t count : {surface.points.size(), surface.triangles.size(), tree.leaves.size(),
                                    tree.nodes.size(), surface.components.size()})
        writer.number(static_cast<std::uint64_t>(count));
    writer.number((surface.adjacency.closed ? closed_flag : 0) | (surface.inward ? inward_flag : 0));
    const Aabb3& box = tree.root(0).box;
    writer.array(std::span<const Vec3>(std::array{box.min, box.max}));
    writer.array(std::span(surface.points));
    writer.array(std::span(surface.triangles));
    writer.array(std::span(surface.adjacency.neighbours));
    writer.array(std::span(tree.order));
    if constexpr (std::endian::native == std::endian::little) {
        writer.array(std::span(tree.leaves));
    } else {
        auto leaves = tree.leaves;
        order_halves(leaves);
        writer.array(std::span<const MeshLeaf>(leaves));
    }
    writer.array(std::span(tree.nodes));
    writer.array(std::span(surface.components));
    return end_shape(std::move(writer));
}

Result<Mesh> load_mesh(std::span<const std::byte> bytes) {
    enter_library();
    auto surface = std::make_shared<MeshSurface>();
    MeshTree& tree = surface->tree;
    std::uint64_t points = 0, triangles = 0, leaves = 0, nodes = 0, components = 0;
    std::uint32_t flags = 0;
    std::vector<Vec3> box;
    const auto read = [&](BlobReader& reader) {
        bool whole = true;
        for (std::uint64_t* count : {&points, &triangles, &leaves, &nodes, &components})
            whole = whole && reader.number(*count);
        return whole && reader.number(flags) && reader.array(box, 2) && reader.array(surface->points, points) &&
               reader.array(surface->triangles, triangles) && reader.array(surface->adjacency.neighbours, triangles) &&
               reader.array(tree.order, triangles) && reader.array(tree.leaves, leaves) &&
               reader.array(tree.nodes, nodes) && reader.array(surface->components, components);
    };
    if (std::optional<Problem> wrong = read_shape(bytes, SavedKind::mesh, read)) return *std::move(wrong);
    if (flags > all_mesh_flags) return bad_shape(SavedKind::mesh, "is of an unknown kind");
    if (!are_sound(surface->points, surface->triangles))
        if (std::optional<Problem> problem = problem_of_faces<3>(surface->points, surface->triangles, "a mesh"))
            return *std::move(problem);
    // References have 31 bits, and the last few have a meaning.
    if (triangles > bvh_leaf_bit - 16) return bad_shape(SavedKind::mesh, "has more than 2^31 triangles");
    order_halves(tree.leaves);
    surface->adjacency.closed = (flags & closed_flag) != 0;
    surface->inward = (flags & inward_flag) != 0;
    const Aabb3 exact{box[0], box[1]};
    if (const MeshFault fault = fault_of(*surface, exact); fault.what != nullptr)
        return bad_shape(SavedKind::mesh, fault.what, fault.index);
    set_root(tree, tree.nodes.empty() ? bvh_leaf_bit : 0, exact);
    return Mesh(std::move(surface));
}

}  // namespace abut
