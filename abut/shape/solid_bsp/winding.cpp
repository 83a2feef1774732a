// Winding numbers by signed crossings of an axis-parallel line.

#include <abut/math/detail/coincident.hpp>
#include <abut/shape/detail/line_crossing.hpp>
#include <abut/shape/mesh/half_edges.hpp>
#include <abut/shape/solid_bsp/winding.hpp>
#include <abut/shape/weld.hpp>

#include <algorithm>
#include <array>

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

}  // namespace

template <int D>
SolidWinding<D>::SolidWinding(const SolidTree<D>& tree, double margin)
    : tree_(tree), margin_(margin), closed_(is_closed(tree)) {
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

template <int D>
std::optional<SolidSides> SolidWinding<D>::beside(const DVec<D>& place, const SolidPlane<D>& plane) const {
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

template class SolidWinding<2>;
template class SolidWinding<3>;

}  // namespace abut::detail
