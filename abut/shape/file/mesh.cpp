// The data of a mesh: the numbers of points, triangles, leaves, nodes and components, flags, the box of all triangles,
// the points, the triangles, their neighbours, and the tree as it lies in memory.

#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/mesh/build.hpp>
#include <abut/shape/mesh/check_mesh.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/surface.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

namespace abut::detail {

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
