// Winding numbers by signed crossings of an axis-parallel line. The vertices of a face are ordered half-open in one
// coordinate, so a line through a vertex or edge crosses exactly one of the faces that share it.

#include <abut/math/detail/coincident.hpp>
#include <abut/shape/solid_bsp/winding.hpp>

#include <algorithm>
#include <array>
#include <tuple>

namespace abut::detail {
namespace {

/// The signed crossing of a face by the line ahead of a point.
struct Crossing {
    int winding = 0;
    double height = 0;  ///< height of the point above the face's plane, times the length of its normal
    bool faces_ahead = false;
};

constexpr int next_axis(int axis, int steps, int dimension) {
    return (axis + steps) % dimension;
}

DVec<2> corner_of(const SolidTree<2>& tree, std::uint32_t face, int corner) {
    return DVec<2>(tree.points[tree.faces[face][corner]]);
}
DVec<3> corner_of(const SolidTree<3>& tree, std::uint32_t face, int corner) {
    return DVec<3>(tree.points[tree.faces[face][corner]]);
}

Crossing crossing(const SolidTree<2>& tree, std::uint32_t face, const SolidPlane<2>& plane, const DVec<2>& place,
                  int ahead) {
    const int aside = 1 - ahead;
    const bool from_below = corner_of(tree, face, 0)[aside] <= place[aside];
    const bool to_below = corner_of(tree, face, 1)[aside] <= place[aside];
    if (from_below == to_below) return {};
    return {plane.normal[ahead] > 0 ? 1 : -1, dot(plane.normal, place) - plane.offset, plane.normal[ahead] > 0};
}

bool before(const DVec<3>& a, const DVec<3>& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// The side of the line from a to b in the projection along an axis; equal for both faces of an edge.
double left_of(const DVec<3>& a, const DVec<3>& b, const DVec<3>& place, int v, int w) {
    if (before(b, a)) return -left_of(b, a, place, v, w);
    return (b[v] - a[v]) * (place[w] - a[w]) - (b[w] - a[w]) * (place[v] - a[v]);
}

Crossing crossing(const SolidTree<3>& tree, std::uint32_t face, const SolidPlane<3>& plane, const DVec<3>& place,
                  int ahead) {
    const int v = next_axis(ahead, 1, 3), w = next_axis(ahead, 2, 3);
    int winding = 0;
    for (int i = 0; i < 3; ++i) {
        const DVec<3> from = corner_of(tree, face, i), to = corner_of(tree, face, (i + 1) % 3);
        const bool from_below = from[w] <= place[w], to_below = to[w] <= place[w];
        if (from_below == to_below) continue;
        const double left = left_of(from, to, place, v, w);
        if (from_below && left > 0) ++winding;
        if (to_below && left < 0) --winding;
    }
    return {winding, dot(plane.normal, place) - plane.offset, plane.normal[ahead] > 0};
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
    const std::vector<std::uint32_t> first = first_coincident(tree.points);
    std::vector<std::tuple<std::uint32_t, std::uint32_t, int>> edges;  // lower point, higher point, direction
    edges.reserve(3 * tree.faces.size());
    for (const glm::uvec3& face : tree.faces)
        for (glm::length_t i = 0; i < 3; ++i) {
            const std::uint32_t from = first[face[i]], to = first[face[(i + 1) % 3]];
            if (from != to) edges.emplace_back(std::min(from, to), std::max(from, to), from < to ? 1 : -1);
        }
    std::sort(edges.begin(), edges.end());
    int balance = 0;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto& [low, high, direction] = edges[i];
        balance += direction;
        const bool last =
            i + 1 == edges.size() || std::get<0>(edges[i + 1]) != low || std::get<1>(edges[i + 1]) != high;
        if (last && balance != 0) return false;
    }
    return true;
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
