// The Minkowski sum of two polyhedra: the support points of both at the vertices of the overlay of their Gauss maps.

#include <abut/convex/hull/hull.hpp>
#include <abut/convex/hull/minkowski.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace abut::detail {
namespace {

/// Along directions this close, the support points of one are within `GaussMap::tolerance_` of those of the other.
constexpr double same_direction = hull_tolerance / 4;

/// An edge on the Gauss map: the arc of the directions n along which both its ends are support points,
///
///     dot(n, along) == 0,     dot(n, left) >= 0,     dot(n, right) >= 0,
///
/// where `left` and `right` lie in the planes of its faces, orthogonal to it and out of the face. For a flat polygon
/// they are equal, and the arc is a semicircle.
struct Arc {
    std::uint32_t from = 0, to = 0;
    DVec<3> along{0.0}, left{0.0}, right{0.0};  ///< of length 1
    DVec<3> middle{0.0};                        ///< of length 1
    double reach = 0;                           ///< of the arc's directions from its middle

    /// Without its ends.
    bool holds(const DVec<3>& n) const { return dot(n, left) > same_direction && dot(n, right) > same_direction; }
};

class GaussMap {
public:
    explicit GaussMap(const SummandSurface& surface) : surface_(surface), tolerance_(hull_tolerance * extent()) {
        for (std::size_t face = 0; face < surface.facets->loop_ends.size(); ++face)
            normals_.push_back(normal(surface.facets->loop(face)));
        for (const FacetEdge& edge : surface.facets->edges) arcs_.push_back(arc(edge));
    }

    std::size_t faces() const { return normals_.size(); }
    const DVec<3>& normal(std::size_t face) const { return normals_[face]; }
    std::span<const std::uint32_t> loop(std::size_t face) const { return surface_.facets->loop(face); }
    std::span<const Arc> arcs() const { return arcs_; }
    const DVec<3>& corner(std::uint32_t i) const { return surface_.corners[i]; }

    /// The support points along n, to within the tolerance.
    void farthest(const DVec<3>& n, std::vector<std::uint32_t>& result) const {
        result.clear();
        double maximum = -std::numeric_limits<double>::infinity();
        for (const DVec<3>& corner : surface_.corners) maximum = std::max(maximum, dot(n, corner));
        for (std::uint32_t i = 0; i < surface_.corners.size(); ++i)
            if (dot(n, corner(i)) >= maximum - tolerance_) result.push_back(i);
    }

private:
    double extent() const {
        double result = 0;
        for (const DVec<3>& corner : surface_.corners) result = std::max(result, largest(corner - surface_.corners[0]));
        return result;
    }

    /// From the corners (Newell), because the normals of `Facets` are rounded.
    DVec<3> normal(std::span<const std::uint32_t> loop) const {
        DVec<3> area(0.0);
        const DVec<3>& origin = corner(loop[0]);
        for (std::size_t i = 1; i + 1 < loop.size(); ++i)
            area += cross(corner(loop[i]) - origin, corner(loop[i + 1]) - origin);
        return normalized(surface_.mirrored ? -area : area);
    }

    Arc arc(const FacetEdge& edge) const {
        const auto [left, right] =
            surface_.mirrored ? std::pair(edge.right, edge.left) : std::pair(edge.left, edge.right);
        Arc result;
        result.from = edge.from;
        result.to = edge.to;
        result.along = normalized(corner(edge.to) - corner(edge.from));
        result.left = normalized(cross(result.along, normals_[left]));
        result.right = normalized(cross(normals_[right], result.along));
        result.middle = normalized(normals_[left] + normals_[right] + result.left + result.right);
        result.reach = std::max(length(normals_[left] - result.middle), length(normals_[right] - result.middle));
        return result;
    }

    const SummandSurface& surface_;
    double tolerance_;  ///< a smaller height difference counts as zero
    std::vector<DVec<3>> normals_;
    std::vector<Arc> arcs_;
};

/// Corners that are coplanar orthogonal to n, as a convex loop in that plane.
class FlatLoop {
public:
    FlatLoop(const GaussMap& map, std::span<const std::uint32_t> corners, const DVec<3>& n) {
        const DVec<3> x = perpendicular(n), y = cross(n, x);
        std::vector<Vec2> flat;
        for (const std::uint32_t i : corners) {
            const DVec<3> seen = map.corner(i) - map.corner(corners[0]);
            flat.push_back(to_float(DVec<2>(dot(x, seen), dot(y, seen))));
        }
        for (const std::uint32_t i : hull_loop(flat)) {
            points_.emplace_back(flat[i]);
            numbers_.push_back(corners[i]);
        }
    }

    std::span<const DVec<2>> points() const { return points_; }
    std::uint32_t number(std::uint32_t i) const { return numbers_[i]; }

private:
    std::vector<DVec<2>> points_;
    std::vector<std::uint32_t> numbers_;
};

/// Adds the corners of the sums of a face of `map` and the support points of `other` along its normal.
template <class Add>
void add_faces(const GaussMap& map, const GaussMap& other, Add add) {
    std::vector<std::uint32_t> farthest;
    for (std::size_t face = 0; face < map.faces(); ++face) {
        const DVec<3>& n = map.normal(face);
        other.farthest(n, farthest);
        const FlatLoop loop(map, map.loop(face), n), other_loop(other, farthest, n);
        for (const CornerPair& pair : sum_corners(loop.points(), other_loop.points()))
            add(loop.number(pair.a), other_loop.number(pair.b));
    }
}

/// Whether the arcs share an inner direction, which is one of the two orthogonal to both edges. Ends of arcs are faces.
bool cross_one_another(const Arc& a, const Arc& b) {
    const double reach = a.reach + b.reach;
    if (length_squared(a.middle - b.middle) > reach * reach) return false;
    const DVec<3> across = cross(a.along, b.along);
    const double sine = length(across);
    if (!(sine > 0)) return false;
    const DVec<3> n = across / sine;
    return (a.holds(n) && b.holds(n)) || (a.holds(-n) && b.holds(-n));
}

template <class Add>
void add_crossings(const GaussMap& map_a, const GaussMap& map_b, Add add) {
    for (const Arc& a : map_a.arcs())
        for (const Arc& b : map_b.arcs())
            if (cross_one_another(a, b))
                for (const std::uint32_t i : {a.from, a.to})
                    for (const std::uint32_t j : {b.from, b.to}) add(i, j);
}

}  // namespace

std::vector<CornerPair> sum_corners(const SummandSurface& a, const SummandSurface& b) {
    std::vector<CornerPair> result;
    const auto add = [&](std::uint32_t i, std::uint32_t j) { result.push_back({i, j}); };
    if (a.facets == nullptr || b.facets == nullptr) {
        for (std::uint32_t i = 0; i < a.corners.size(); ++i)
            for (std::uint32_t j = 0; j < b.corners.size(); ++j) add(i, j);
        return result;
    }
    const GaussMap map_a(a), map_b(b);
    add_faces(map_a, map_b, add);
    add_faces(map_b, map_a, [&](std::uint32_t j, std::uint32_t i) { add(i, j); });
    add_crossings(map_a, map_b, add);
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

}  // namespace abut::detail
