#include <abut/math/detail/next_float.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/simd/square_root.hpp>
#include <abut/query/detail/solid/touching_moves.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>

namespace abut::detail {
namespace {

/// A sine that may be rounding, and how far beyond its ends, relative to it, an edge may be met.
constexpr double parallel_sine = 1e-6, beyond_end = 1e-9;

/// The box around a box after each of some moves.
Aabb3 moved_by(const Aabb3& box, std::initializer_list<DVec<3>> moves) {
    Aabb3 result = Aabb3::empty();
    for (const DVec<3>& move : moves)
        for (int i = 0; i < 3; ++i) {
            const auto low = static_cast<float>(static_cast<double>(box.min[i]) + move[i]);
            const auto high = static_cast<float>(static_cast<double>(box.max[i]) + move[i]);
            result.min[i] = std::min(result.min[i], next_down(low));
            result.max[i] = std::max(result.max[i], next_up(high));
        }
    return result;
}

/// A face of one solid, and the moves of the other along its normal.
class FaceMoves {
public:
    FaceMoves(const Corners& corners, const DVec<3>& normal) : corners_(corners), normal_(normal) {
        for (std::size_t i = 0; i < 3; ++i) {
            const DVec<3> edge = corners[next_corner(i)] - corners[i];
            inward_[i] = cross(normal, edge);
            tolerance_[i] = -beyond_end * length_squared(edge);
        }
    }

    /// How far a point must move to lie on the face; none if it isn't behind the face.
    std::optional<double> distance(const DVec<3>& point) const {
        for (std::size_t i = 0; i < 3; ++i)
            if (dot(inward_[i], point - corners_[i]) < tolerance_[i]) return std::nullopt;
        return dot(normal_, corners_[0] - point);
    }

private:
    const Corners& corners_;
    DVec<3> normal_;
    std::array<DVec<3>, 3> inward_;
    std::array<double, 3> tolerance_;
};

/// Moves of B along the normals of the faces of one of the solids. `sign` is that of the normal in the move.
void each_face_move(const PlacedSolid& faces, const PlacedSolid& corners, double sign,
                    const TouchingMoveVisitor& visitor) {
    for (std::uint32_t i = 0; i < faces.triangle_count(); ++i) {
        const Corners face = faces.corners(i);
        const DVec<3> across = cross(face[1] - face[0], face[2] - face[0]);
        const double size = length(across);
        if (!(size > 0)) continue;
        const DVec<3> normal = across / size, direction = normal * sign;
        const double least = visitor.least(direction, direction), limit = visitor.limit();
        if (!(least < limit)) continue;
        const FaceMoves moves(face, normal);
        const Aabb3 behind = moved_by(box_of(face), {normal * -least, normal * -limit});
        corners.each_triangle(behind, [&](std::uint32_t other) {
            for (const DVec<3>& corner : corners.corners(other))
                if (const std::optional<double> distance = moves.distance(corner))
                    if (*distance > least && *distance < visitor.limit()) visitor.visit(direction, *distance);
            return true;
        });
    }
}

/// A convex edge of a solid, between two faces.
struct ConvexEdge {
    DVec<3> from, to;
    std::array<DVec<3>, 2> normals;  ///< of the faces, of length 1
    std::array<DVec<3>, 2> inward;   ///< from the edge to the third corner of each face

    /// Whether nothing of the faces is farther along a direction, which is perpendicular to the edge.
    bool is_farthest_along(const DVec<3>& direction) const {
        return std::all_of(inward.begin(), inward.end(),
                           [&](const DVec<3>& to_corner) {
                               const double along = dot(direction, to_corner);
                               return along <= 0 ||
                                      along * along <= parallel_sine * parallel_sine * length_squared(to_corner);
                           }) &&
               dot(direction, normals[0] + normals[1]) > 0;
    }
};

/// Whether an edge is between two triangles, of which this is the first.
bool is_first_at_edge(const PlacedSolid& solid, std::uint32_t triangle, std::size_t side) {
    const std::uint32_t neighbour = solid.neighbour(triangle, side);
    return neighbour != no_neighbour && neighbour != many_neighbours && neighbour > triangle;
}

/// The edge of a triangle from a corner to the next, if it is convex.
std::optional<ConvexEdge> convex_edge(const PlacedSolid& solid, std::uint32_t triangle, const Corners& corners,
                                      std::size_t side) {
    ConvexEdge edge{corners[side], corners[next_corner(side)], {}, {}};
    const Corners other = solid.corners(solid.neighbour(triangle, side));
    const auto across = std::find_if(other.begin(), other.end(),
                                     [&](const DVec<3>& corner) { return corner != edge.from && corner != edge.to; });
    if (across == other.end()) return std::nullopt;
    edge.inward = {corners[next_corner(next_corner(side))] - edge.from, *across - edge.from};
    const DVec<3> along = edge.to - edge.from;
    edge.normals = {normalized<3>(cross(along, edge.inward[0])), normalized<3>(cross(edge.inward[1], along))};
    const double height = dot(edge.normals[0], edge.inward[1]);
    if (!(height < 0 && height * height > parallel_sine * parallel_sine * length_squared(edge.inward[1])))
        return std::nullopt;
    return edge;
}

/// The shortest way from one edge to another, if it is perpendicular to both and leads from inner points.
struct WayBetweenEdges {
    DVec<3> direction{0.0};
    double distance = 0;
};
std::optional<WayBetweenEdges> way_between(const DVec<3>& from, const DVec<3>& along, const DVec<3>& other_from,
                                           const DVec<3>& other_along) {
    const DVec<3> across = cross(along, other_along), between = other_from - from;
    const double squared = length_squared(across), height = dot(across, between);
    const auto is_inside = [&](double scaled) {
        return scaled >= -beyond_end * squared && scaled <= (1 + beyond_end) * squared;
    };
    if (!is_inside(dot(cross(between, other_along), across)) || !is_inside(dot(cross(between, along), across)))
        return std::nullopt;
    if (!(squared > parallel_sine * parallel_sine * length_squared(along) * length_squared(other_along)))
        return std::nullopt;
    const double size = square_root(squared);
    return WayBetweenEdges{across / (height < 0 ? -size : size), std::abs(height) / size};
}

/// The box around where B's edges are that touch an edge of A after a move that is wanted.
Aabb3 box_around(const ConvexEdge& edge, double least, double limit) {
    const Aabb3 box = box_of({edge.from, edge.to, edge.to});
    const DVec<3>&first = edge.normals[0], &last = edge.normals[1];
    const DVec<3> sum = first + last;
    const double blunt = length_squared(sum);
    if (blunt < 0.1) return grown(box, static_cast<float>(limit));
    // The arc is in the hull of its ends and of the point where the tangents at them meet.
    return moved_by(box, {first * -least, last * -least, first * -limit, last * -limit, sum * (-2 * limit / blunt)});
}

void each_edge_move(const PlacedSolid& a, const PlacedSolid& b, const TouchingMoveVisitor& visitor) {
    for (std::uint32_t i = 0; i < a.triangle_count(); ++i) {
        const Corners corners = a.corners(i);
        for (std::size_t side = 0; side < 3; ++side) {
            if (!is_first_at_edge(a, i, side)) continue;
            const std::optional<ConvexEdge> edge = convex_edge(a, i, corners, side);
            if (!edge) continue;
            const double least = visitor.least(edge->normals[0], edge->normals[1]), limit = visitor.limit();
            if (!(least < limit)) continue;
            const DVec<3> along = edge->to - edge->from;
            b.each_triangle(box_around(*edge, least, limit), [&](std::uint32_t other) {
                const Corners t = b.corners(other);
                for (std::size_t k = 0; k < 3; ++k) {
                    if (!is_first_at_edge(b, other, k)) continue;
                    const auto way = way_between(t[k], t[next_corner(k)] - t[k], edge->from, along);
                    if (!way || way->distance <= least || way->distance >= visitor.limit()) continue;
                    if (!edge->is_farthest_along(way->direction)) continue;
                    const std::optional<ConvexEdge> met = convex_edge(b, other, t, k);
                    if (met && met->is_farthest_along(-way->direction)) visitor.visit(way->direction, way->distance);
                }
                return true;
            });
        }
    }
}

}  // namespace

void each_touching_move(const PlacedSolid& a, const PlacedSolid& b, const TouchingMoveVisitor& visitor) {
    each_face_move(a, b, 1, visitor);
    each_face_move(b, a, -1, visitor);
    each_edge_move(a, b, visitor);
}

}  // namespace abut::detail
