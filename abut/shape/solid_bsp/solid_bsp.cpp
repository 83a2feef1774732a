#include <abut/math/assert.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_bsp/tree.hpp>
#include <abut/shape/solid_bsp/winding.hpp>

#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// Relative to the largest coordinate: far above the rounding of doubles, far below that of floats.
constexpr double relative_margin = 0x1p-40;

bool has_extent(const SolidTree<2>& tree, const glm::uvec2& face) {
    return tree.points[face.x] != tree.points[face.y];
}
bool has_extent(const SolidTree<3>& tree, const glm::uvec3& face) {
    return !on_line(tree.points[face.x], tree.points[face.y], tree.points[face.z]);
}

/// Whether a leaf that contains the point is solid.
template <int D>
bool is_in_solid_leaf(const SolidTree<D>& tree, std::uint32_t at, const Vec<D>& point) {
    while (at < open_leaf) {
        const SolidNode<D>& node = tree.nodes[at];
        const int side = side_of(tree, node.plane, point);
        if (side == 0 && is_in_solid_leaf(tree, node.back, point)) return true;
        at = side < 0 ? node.back : node.front;
    }
    return at == solid_leaf;
}

template <int D>
bool visit_pieces(const SolidTree<D>& tree, std::uint32_t at, const Vec<D>& eye,
                  FunctionRef<bool(std::uint32_t, std::span<const Vec<D>>)> visit) {
    while (at < open_leaf) {
        const SolidNode<D>& node = tree.nodes[at];
        const bool in_front = side_of(tree, node.plane, eye) >= 0;
        if (!visit_pieces(tree, in_front ? node.front : node.back, eye, visit)) return false;
        for (std::uint32_t i = node.first_piece; i < node.first_piece + node.pieces; ++i) {
            const SolidPiece& piece = tree.pieces[i];
            if (!visit(piece.face, {tree.corners.data() + piece.first_corner, piece.corners})) return false;
        }
        at = in_front ? node.back : node.front;
    }
    return true;
}

}  // namespace

template <int D>
Result<SolidBsp<D>> SolidBsp<D>::build(std::span<const Vec<D>> points, std::span<const Face> faces) {
    detail::enter_library();
    if (std::optional<Problem> problem = problem_of_faces<D>(points, faces, "a level")) return *std::move(problem);
    auto tree = std::make_shared<SolidTree<D>>();
    tree->points.assign(points.begin(), points.end());
    tree->faces.assign(faces.begin(), faces.end());

    double largest_coordinate = 0;
    std::vector<SolidFragment<D>> fragments;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        if (!has_extent(*tree, faces[i])) continue;
        SolidFragment<D> fragment{i, {}};
        for (int j = 0; j < D; ++j) {
            fragment.corners.push_back({DVec<D>(points[faces[i][j]]), faces[i][j]});
            largest_coordinate = std::max(largest_coordinate, largest(fragment.corners.back().position));
        }
        fragments.push_back(std::move(fragment));
    }
    const double margin = relative_margin * largest_coordinate;
    const SolidWinding<D> winding(*tree, margin);
    const auto plane = [&](std::uint32_t face) { return plane_of_face(*tree, face); };
    const auto sides = [&](const DVec<D>& place, const SolidPlane<D>& at) -> std::optional<SolidSides> {
        return winding.closed() ? winding.beside(place, at) : SolidSides();
    };
    build_tree<D>(*tree, {std::move(fragments), margin, plane, sides});
    add_cells<D>(*tree, margin);
    tree->parts.finish();
    return SolidBsp(std::move(tree));
}

template <int D>
bool SolidBsp<D>::contains(const Vec<D>& point) const {
    detail::enter_library();
    const bool finite = is_finite(point);
    ABUT_ASSERT(finite);
    return finite && is_in_solid_leaf(*tree_, tree_->root, point);
}

template <int D>
void SolidBsp<D>::visit_from(const Vec<D>& eye, PieceCall visit) const {
    detail::enter_library();
    ABUT_ASSERT(is_finite(eye));
    if (is_finite(eye)) visit_pieces<D>(*tree_, tree_->root, eye, visit);
}

template <int D>
Aabb<D> SolidBsp<D>::bounds() const {
    detail::enter_library();
    return tree_->bounds;
}
template <int D>
void SolidBsp<D>::each_part(const Aabb<D>& box, PartVisitor<D> visit) const {
    detail::enter_library();
    tree_->parts.each_part(box, visit);
}
template <int D>
void SolidBsp<D>::each_part_along(const MovingBox<D>& box, PartReachVisitor<D> visit) const {
    detail::enter_library();
    tree_->parts.each_part_along(box, visit);
}
template <int D>
void SolidBsp<D>::each_part_near(const Aabb<D>& box, PartReachVisitor<D> visit) const {
    detail::enter_library();
    tree_->parts.each_part_near(box, visit);
}
template <int D>
Aabb<D> SolidBsp<D>::part_bounds() const {
    detail::enter_library();
    return tree_->parts.bounds();
}
template <int D>
std::size_t SolidBsp<D>::part_count() const {
    return tree_->parts.size();
}
template <int D>
std::size_t SolidBsp<D>::node_count() const {
    return tree_->nodes.size();
}
template <int D>
std::size_t SolidBsp<D>::depth() const {
    return tree_->depth;
}
template <int D>
std::size_t SolidBsp<D>::piece_count() const {
    return tree_->pieces.size();
}

#define ABUT_INSTANTIATE(D)                                                                                       \
    template SolidBsp<D>::SolidBsp(std::shared_ptr<const SolidTree<D>>);                                          \
    template Result<SolidBsp<D>> SolidBsp<D>::build(std::span<const Vec<D>>, std::span<const SolidBsp<D>::Face>); \
    template bool SolidBsp<D>::contains(const Vec<D>&) const;                                                     \
    template void SolidBsp<D>::visit_from(const Vec<D>&, SolidBsp<D>::PieceCall) const;                           \
    template Aabb<D> SolidBsp<D>::bounds() const;                                                                 \
    template void SolidBsp<D>::each_part(const Aabb<D>&, PartVisitor<D>) const;                                   \
    template void SolidBsp<D>::each_part_along(const MovingBox<D>&, PartReachVisitor<D>) const;                   \
    template void SolidBsp<D>::each_part_near(const Aabb<D>&, PartReachVisitor<D>) const;                         \
    template Aabb<D> SolidBsp<D>::part_bounds() const;                                                            \
    template std::size_t SolidBsp<D>::part_count() const;                                                         \
    template std::size_t SolidBsp<D>::node_count() const;                                                         \
    template std::size_t SolidBsp<D>::depth() const;                                                              \
    template std::size_t SolidBsp<D>::piece_count() const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
