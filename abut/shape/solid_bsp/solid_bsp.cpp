#include <abut/broad_phase/bvh.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/detail/coincident.hpp>
#include <abut/math/predicates.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/shape/detail/line_crossing.hpp>
#include <abut/shape/mesh/check_triangles.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/shape/solid_bsp.hpp>
#include <abut/shape/solid_bsp/tree.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace abut::detail {
namespace {

/// The signed crossing of a face by the line ahead of a point.
struct Crossing {
    int winding = 0;
    double height = 0;  ///< height of the point above the face's plane, times the length of its normal
    bool faces_ahead = false;
};

template <int D>
DVec<D> corner_of(const SolidTree<D>& tree, std::uint32_t face, int corner) {
    return DVec<D>(tree.points[tree.faces[face][corner]]);
}

Crossing crossing(const SolidTree<2>& tree, std::uint32_t face, const SolidPlane<2>& plane, const DVec<2>& place,
                  int ahead) {
    const int aside = 1 - ahead;
    const bool from_below = corner_of(tree, face, 0)[aside] <= place[aside];
    const bool to_below = corner_of(tree, face, 1)[aside] <= place[aside];
    if (from_below == to_below) return {};
    return {plane.normal[ahead] > 0 ? 1 : -1, dot(plane.normal, place) - plane.offset, plane.normal[ahead] > 0};
}

Crossing crossing(const SolidTree<3>& tree, std::uint32_t face, const SolidPlane<3>& plane, const DVec<3>& place,
                  int ahead) {
    const std::array<DVec<3>, 3> corners{corner_of(tree, face, 0), corner_of(tree, face, 1), corner_of(tree, face, 2)};
    return {crossing_by_line(corners, place, ahead), dot(plane.normal, place) - plane.offset, plane.normal[ahead] > 0};
}

/// True if each vertex has equally many incoming and outgoing segments.
bool is_closed(const SolidTree<2>& tree) {
    std::vector<Vec3> points;
    points.reserve(tree.points.size());
    for (const Vec2& point : tree.points) points.emplace_back(point.x, point.y, 0.0f);
    const std::vector<std::uint32_t> first = first_coincident(points);
    std::vector<int> balance(points.size(), 0);
    for (const glm::uvec2& face : tree.faces) {
        ++balance[first[face.x]];
        --balance[first[face.y]];
    }
    return std::all_of(balance.begin(), balance.end(), [](int each) { return each == 0; });
}

bool is_closed(const SolidTree<3>& tree) {
    return edge_faults(weld(tree.points, tree.faces).triangles).closed;
}

/// Twice the signed area or six times the signed volume: positive if the faces bound a finite solid.
template <int D>
double signed_content(const SolidTree<D>& tree) {
    double result = 0;
    const DVec<D> origin(tree.points[tree.faces[0][0]]);
    for (std::uint32_t face = 0; face < tree.faces.size(); ++face) {
        const DVec<D> a = corner_of(tree, face, 0) - origin, b = corner_of(tree, face, 1) - origin;
        if constexpr (D == 2)
            result += cross(a, b);
        else
            result += dot(a, cross(b, corner_of(tree, face, 2) - origin));
    }
    return result;
}

/// Refers to the points and faces of the tree.
template <int D>
class SolidWinding {
public:
    SolidWinding(const SolidTree<D>& tree, double margin) : tree_(tree), margin_(margin), closed_(is_closed(tree)) {
        if (!closed_) return;
        outer_winding_ = signed_content(tree) < 0 ? 1 : 0;
        std::vector<Aabb<D>> boxes;
        boxes.reserve(tree.faces.size());
        for (const auto& face : tree.faces) {
            Aabb<D> box = Aabb<D>::empty();
            for (int i = 0; i < D; ++i) box = merged(box, Aabb<D>{tree.points[face[i]], tree.points[face[i]]});
            boxes.push_back(box);
        }
        faces_.build(boxes);
    }

    /// True if each vertex (2D) or edge (3D) has equally many incoming and outgoing faces.
    bool closed() const { return closed_; }

    /// Whether the space in front of a plane and behind it is solid, at a point of the plane. Nothing if a face that
    /// isn't coplanar is within the margin of the point.
    std::optional<SolidSides> beside(const DVec<D>& place, const SolidPlane<D>& plane) const {
        // The line runs along the axis nearest to the normal.
        int axis = 0;
        for (int i = 1; i < D; ++i)
            if (std::abs(plane.normal[i]) > std::abs(plane.normal[axis])) axis = i;
        Aabb<D> ahead = grown(Aabb<D>{to_float(place), to_float(place)}, static_cast<float>(margin_));
        ahead.max[axis] = std::numeric_limits<float>::infinity();

        const double size = length(plane.normal);
        bool is_certain = true;
        int in_front = outer_winding_, behind = outer_winding_;
        faces_.each_overlapping(ahead, [&](std::uint32_t face) -> bool {
            const SolidPlane<D> other = plane_of_face(tree_, face);
            const Crossing found = crossing(tree_, face, other, place, axis);
            const double other_size = length(other.normal);
            if (found.winding == 0 || other_size == 0) return true;
            double from_front = found.height, from_behind = found.height;
            if (std::abs(found.height) <= margin_ * other_size) {
                // The face is coplanar, or crosses the plane here.
                const double along = dot(plane.normal, other.normal) / (size * other_size);
                if (1 - std::abs(along) > 1e-9) return is_certain = false;
                from_front = along;
                from_behind = -along;
            }
            if ((from_front < 0) == found.faces_ahead) in_front += found.winding;
            if ((from_behind < 0) == found.faces_ahead) behind += found.winding;
            return true;
        });
        if (!is_certain) return std::nullopt;
        return SolidSides{in_front > 0, behind > 0};
    }

private:
    const SolidTree<D>& tree_;
    double margin_;
    bool closed_;
    int outer_winding_ = 0;  ///< added to all winding numbers: 1 if the solid is unbounded
    Bvh<D> faces_;
};

}  // namespace
}  // namespace abut::detail

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
Result<SolidBsp<D>> SolidBsp<D>::build(const PointSpan<D>& given, std::span<const Face> faces) {
    detail::enter_library();
    const PackedPoints<D> packed(given);
    const std::span<const Vec<D>> points = packed.points();
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

#define ABUT_INSTANTIATE(D)                                                                                   \
    template SolidBsp<D>::SolidBsp(std::shared_ptr<const SolidTree<D>>);                                      \
    template Result<SolidBsp<D>> SolidBsp<D>::build(const PointSpan<D>&, std::span<const SolidBsp<D>::Face>); \
    template bool SolidBsp<D>::contains(const Vec<D>&) const;                                                 \
    template void SolidBsp<D>::visit_from(const Vec<D>&, SolidBsp<D>::PieceCall) const;                       \
    template Aabb<D> SolidBsp<D>::bounds() const;                                                             \
    template void SolidBsp<D>::each_part(const Aabb<D>&, PartVisitor<D>) const;                               \
    template void SolidBsp<D>::each_part_along(const MovingBox<D>&, PartReachVisitor<D>) const;               \
    template void SolidBsp<D>::each_part_near(const Aabb<D>&, PartReachVisitor<D>) const;                     \
    template Aabb<D> SolidBsp<D>::part_bounds() const;                                                        \
    template std::size_t SolidBsp<D>::part_count() const;                                                     \
    template std::size_t SolidBsp<D>::node_count() const;                                                     \
    template std::size_t SolidBsp<D>::depth() const;                                                          \
    template std::size_t SolidBsp<D>::piece_count() const;
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
