// The data of a solid level: the numbers of points, faces, nodes, pieces and corners, the box of all faces, the points,
// the faces, for each node the doubles of its plane, then for each the numbers of its face, its sides and its pieces,
// the pieces, the corners, and the parts.

#include <abut/math/detail/no_index.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/file.hpp>
#include <abut/shape/file/blob.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/solid_bsp/tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace detail {

template <>
struct BlobScalar<SolidPiece> {
    using type = std::uint32_t;
};

}  // namespace detail

namespace {

template <int D>
constexpr SavedKind solid_kind = D == 2 ? SavedKind::solid_bsp_2d : SavedKind::solid_bsp_3d;

/// The numbers of a node, in the order of the file; the node may be const.
template <class Node, class Visit>
void each_double(Node& node, Visit visit) {
    for (int axis = 0; axis < node.plane.normal.length(); ++axis) visit(node.plane.normal[axis]);
    visit(node.plane.offset);
    visit(node.plane.relative_error);
    visit(node.plane.error_at_origin);
}
template <class Node, class Visit>
void each_index(Node& node, Visit visit) {
    visit(node.plane.face);
    visit(node.front);
    visit(node.back);
    visit(node.first_piece);
    visit(node.pieces);
}

template <int D>
constexpr std::size_t bytes_of_node = (D + 3) * sizeof(double) + 5 * sizeof(std::uint32_t);

template <int D>
bool is_plane(const SolidPlane<D>& plane, std::size_t faces) {
    const double size = length(plane.normal);
    return size > 0 && std::isfinite(size) && std::isfinite(plane.offset) && plane.relative_error >= 0 &&
           std::isfinite(plane.relative_error) && plane.error_at_origin >= 0 && std::isfinite(plane.error_at_origin) &&
           (plane.face == no_index || plane.face < faces);
}

/// Children follow their parents, so there are no cycles, and each node but the first has one parent. Sets the depth.
template <int D>
const char* fault_of_solid_nodes(SolidTree<D>& tree) {
    const std::size_t count = tree.nodes.size();
    std::vector<std::uint16_t> depth(count, 0);
    if (count > 0) depth[0] = 1;
    for (std::size_t i = 0; i < count; ++i) {
        const SolidNode<D>& node = tree.nodes[i];
        if (!is_plane(node.plane, tree.faces.size())) return "has a node without a plane";
        if (depth[i] == 0) return "has a node that no other refers to";
        tree.depth = std::max<std::size_t>(tree.depth, depth[i]);
        if (tree.depth > solid_depth) return "has a tree that is too deep";
        if (node.pieces > tree.pieces.size() || node.first_piece > tree.pieces.size() - node.pieces)
            return "has a node with pieces that don't exist";
        for (const std::uint32_t child : {node.front, node.back}) {
            if (child == solid_leaf || child == open_leaf) continue;
            if (child >= count || child <= i || depth[child] != 0) return "has a node below itself or another";
            depth[child] = static_cast<std::uint16_t>(depth[i] + 1);
        }
    }
    return nullptr;
}

template <int D>
const char* fault_of_pieces(const SolidTree<D>& tree) {
    for (const SolidPiece& piece : tree.pieces) {
        const bool enough = D == 2 ? piece.corners == 2 : piece.corners >= 3;
        if (!enough || piece.corners > tree.corners.size() || piece.first_corner > tree.corners.size() - piece.corners)
            return "has a piece with corners that don't exist";
        if (!tree.faces.empty() && piece.face >= tree.faces.size()) return "has a piece of a face that doesn't exist";
    }
    for (const Vec<D>& corner : tree.corners)
        if (!is_finite<D>(corner)) return "has a corner that is not finite";
    if (tree.nodes.empty()) return tree.bounds == Aabb<D>::empty() ? nullptr : "has a box without faces";
    bool is_box = is_finite<D>(tree.bounds.min) && is_finite<D>(tree.bounds.max);
    for (int axis = 0; axis < D; ++axis) is_box = is_box && tree.bounds.min[axis] <= tree.bounds.max[axis];
    return is_box ? nullptr : "has an empty box";
}

}  // namespace

template <int D>
std::vector<std::byte> save(const SolidBsp<D>& level) {
    const SolidTree<D>& tree = *level.tree_;
    BlobWriter writer =
        begin_shape(solid_kind<D>, 256 + tree.points.size() * sizeof(Vec<D>) + tree.faces.size() * D * 4 +
                                       tree.nodes.size() * bytes_of_node<D> + tree.pieces.size() * sizeof(SolidPiece) +
                                       tree.corners.size() * sizeof(Vec<D>));
    for (const std::size_t count :
         {tree.points.size(), tree.faces.size(), tree.nodes.size(), tree.pieces.size(), tree.corners.size()})
        writer.number(static_cast<std::uint64_t>(count));
    writer.array(std::span<const Vec<D>>(std::array{tree.bounds.min, tree.bounds.max}));
    writer.array(std::span(tree.points));
    writer.array(std::span(tree.faces));
    for (const SolidNode<D>& node : tree.nodes) each_double(node, [&](double number) { writer.number(number); });
    for (const SolidNode<D>& node : tree.nodes) each_index(node, [&](std::uint32_t index) { writer.number(index); });
    writer.array(std::span(tree.pieces));
    writer.array(std::span(tree.corners));
    tree.parts.save(writer);
    return end_shape(std::move(writer));
}

template <int D>
Result<SolidBsp<D>> load_solid_bsp(std::span<const std::byte> bytes) {
    enter_library();
    constexpr SavedKind kind = solid_kind<D>;
    BlobReader reader(bytes);
    if (std::optional<Problem> wrong = open_shape(reader, bytes, kind)) return *std::move(wrong);
    auto tree = std::make_shared<SolidTree<D>>();
    std::uint64_t points = 0, faces = 0, nodes = 0, pieces = 0, corners = 0;
    std::vector<Vec<D>> box;
    bool whole = true;
    for (std::uint64_t* count : {&points, &faces, &nodes, &pieces, &corners}) whole = whole && reader.number(*count);
    whole = whole && reader.array(box, 2) && reader.array(tree->points, points) && reader.array(tree->faces, faces) &&
            nodes <= reader.left() / bytes_of_node<D>;
    if (!whole) return truncated_shape(kind);
    tree->nodes.resize(static_cast<std::size_t>(nodes));
    for (SolidNode<D>& node : tree->nodes) each_double(node, [&](double& number) { reader.number(number); });
    for (SolidNode<D>& node : tree->nodes) each_index(node, [&](std::uint32_t& index) { reader.number(index); });
    if (!reader.array(tree->pieces, pieces) || !reader.array(tree->corners, corners)) return truncated_shape(kind);
    const char* fault = tree->parts.load(reader);
    if (fault == nullptr && reader.left() != 0) return overlong_shape(kind);
    tree->bounds = {box[0], box[1]};
    // A level of brushes has no points and faces.
    if (fault == nullptr && (faces > 0 || points > 0))
        if (std::optional<Problem> problem = problem_of_faces<D>(tree->points, tree->faces, "a level"))
            return *std::move(problem);
    if (fault == nullptr) fault = fault_of_solid_nodes(*tree);
    if (fault == nullptr) fault = fault_of_pieces(*tree);
    if (fault != nullptr) return bad_shape(kind, fault);
    tree->root = tree->nodes.empty() ? open_leaf : 0;
    return SolidBsp<D>(std::move(tree));
}

template std::vector<std::byte> save(const SolidBsp<2>&);
template std::vector<std::byte> save(const SolidBsp<3>&);
template Result<SolidBsp<2>> load_solid_bsp<2>(std::span<const std::byte>);
template Result<SolidBsp<3>> load_solid_bsp<3>(std::span<const std::byte>);

}  // namespace abut
