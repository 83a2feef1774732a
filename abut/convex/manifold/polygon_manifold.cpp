#include <abut/convex/manifold/polygon_manifold.hpp>
#include <abut/math/simd/double2-inl.h>

namespace abut::detail {
namespace {

/// An edge in the frame of the reference polygon.
struct ProjectedEdge {
    DVec<2> ends[2];
    std::uint32_t names[2];
    DVec<2> normal;
    double alignment;  ///< of its normal with the contact direction
};

/// Corners of a box are numbered in cyclic order here, as in `face_along`.
std::uint32_t name_of(const PolygonSoa& sides, std::uint32_t corner) {
    return sides.order == CornerOrder::box ? (corner + 2) & 3 : sides.corner_number(corner);
}

/// Of the edges beside a corner the one whose normal is nearest to a direction, both in the polygon's own frame.
inline std::uint32_t facing_edge(const PolygonSoa& sides, std::uint32_t corner, const DVec<2>& direction,
                                 double& alignment) {
    const auto alignment_of = [&](std::uint32_t side) {
        const bool proper = sides.corner(side) != sides.corner(sides.after(side));
        return proper ? dot(sides.normal(side), direction) : -1;
    };
    const std::uint32_t last = sides.before(corner);
    const double next_alignment = alignment_of(corner), last_alignment = alignment_of(last);
    alignment = std::max(next_alignment, last_alignment);
    return last_alignment > next_alignment ? last : corner;
}

void find_reference_edge(const PolygonPair& pair, const ClosestFeatures2& closest, ProjectedEdge& edge) {
    const PolygonSoa& sides = pair.sides(closest.of);
    const std::uint32_t side = facing_edge(sides, closest.reference_corners[0], closest.normal, edge.alignment);
    const std::uint32_t after = sides.after(side);
    edge.ends[0] = sides.corner(side);
    edge.ends[1] = sides.corner(after);
    edge.names[0] = name_of(sides, side);
    edge.names[1] = name_of(sides, after);
    edge.normal = sides.normal(side);
}

void find_other_edge(const PolygonPair& pair, const ClosestFeatures2& closest, ProjectedEdge& edge) {
    const PolygonSoa& sides = pair.sides(1 - closest.of);
    const Rigid2& seen = pair.seen_from(closest.of);
    const DVec<2> direction = -pair.seen_from(1 - closest.of).vector(closest.normal);
    const std::uint32_t side = facing_edge(sides, closest.other_corners[0], direction, edge.alignment);
    const std::uint32_t after = sides.after(side);
    edge.ends[0] = seen.point(sides.corner(side));
    edge.ends[1] = seen.point(sides.corner(after));
    edge.names[0] = name_of(sides, side);
    edge.names[1] = name_of(sides, after);
    edge.normal = seen.vector(sides.normal(side));
}

/// At most three points: the ends of a clipped edge, and the closest point.
struct Candidates {
    std::array<ManifoldPoint<2>, 3> points;
    std::size_t count = 0;
};

/// Clips an edge to the range of the reference edge along `across`. Returns false if nothing remains. It has no
/// branches, which can't be predicted.
inline bool cut_to(const ProjectedEdge& reference, const DVec<2>& across, ProjectedEdge& edge, double (&along)[2]) {
    using namespace lanes;
    const double low = dot(across, reference.ends[0]), high = dot(across, reference.ends[1]);
    const Double2 from{low, low}, to{high, high}, at{dot(across, edge.ends[0]), dot(across, edge.ends[1])};
    const Double2 clamped = lesser(greater(at, from), to), shift = clamped - at;
    const std::uint32_t below = bits(at < from), above = bits(at > to);
    if (below == 3 || above == 3) return false;
    const DVec<2> whole = edge.ends[1] - edge.ends[0];
    const double run = at[1] - at[0], part = run != 0 ? 1 / run : 0;
    for (std::uint32_t i = 0; i < 2; ++i) {
        edge.ends[i] += whole * (shift[i] * part);
        const std::uint32_t cut_low = below >> i & 1u, cut_high = above >> i & 1u;
        edge.names[i] |= ((reference.names[0] + 1) * cut_low | (reference.names[1] + 1) * cut_high) << 16;
        along[i] = clamped[i];
    }
    return true;
}

/// Member by member.
inline void write_point(const ManifoldPoint<2>& from, ManifoldPoint<2>& to) {
    to.position.x = from.position.x;
    to.position.y = from.position.y;
    to.depth = from.depth;
    to.feature = from.feature;
}

/// The first of the deepest to within the tolerance, and the point farthest from it.
void reduce(const Candidates& all, double tolerance, Manifold<2>& result) {
    result.count = std::min(all.count, result.points.size());
    if (all.count < 3) {
        for (std::size_t i = 0; i < result.count; ++i) write_point(all.points[i], result.points[i]);
        return;
    }
    const auto& points = all.points;
    const double threshold = std::max({points[0].depth, points[1].depth, points[2].depth}) - tolerance;
    const std::size_t deepest = points[0].depth >= threshold ? 0 : points[1].depth >= threshold ? 1 : 2;
    const std::size_t i = (deepest + 1) % 3, j = (deepest + 2) % 3;
    const auto far = [&](std::size_t k) { return length_squared(points[k].position - points[deepest].position); };
    write_point(points[deepest], result.points[0]);
    write_point(points[far(j) > far(i) ? j : i], result.points[1]);
}

}  // namespace

void set_polygon_manifold(const PolygonPair& pair, const ClosestFeatures2& closest, const SignedDistance<2>& distance,
                          double margin, Manifold<2>& result) {
    const PlacedPolygon &a = pair.polygon(0), &b = pair.polygon(1);
    const double tolerance = 1e-6 * std::min(a.sides.size + a.radius, b.sides.size + b.radius);
    const double depth = -distance.distance;
    const Rigid2& place = pair.polygon(closest.of).place;
    ProjectedEdge of_reference, of_other;
    find_reference_edge(pair, closest, of_reference);
    find_other_edge(pair, closest, of_other);

    Candidates candidates;
    if (std::max(of_reference.alignment, of_other.alignment) >= aligned) {
        const bool first_is_a = closest.of == 0;
        const double of_a = first_is_a ? of_reference.alignment : of_other.alignment,
                     of_b = first_is_a ? of_other.alignment : of_reference.alignment;
        const bool a_is_reference = of_a >= of_b - 1e-6;
        const bool same = a_is_reference == first_is_a;
        const ProjectedEdge& reference = same ? of_reference : of_other;
        ProjectedEdge& incident = same ? of_other : of_reference;
        const DVec<2> out = same ? closest.normal : -closest.normal, across(-out.y, out.x);
        const double reference_radius = a_is_reference ? a.radius : b.radius;
        const double incident_radius = a_is_reference ? b.radius : a.radius;

        // Counter-clockwise, an edge runs along `across`.
        double along[2] = {0, 0};
        const bool left = cut_to(reference, across, incident, along);
        // If only an end of the edge remains, it is one point: the end itself, if it wasn't clipped.
        const bool one = std::abs(along[0] - along[1]) <= tolerance;
        const std::size_t dropped = !one ? 2 : incident.names[1] < 1u << 16 ? 0 : 1;
        const double one_slope = 1 / dot(reference.normal, out);
        for (std::size_t i = 0; i < 2 && left; ++i) {
            if (i == dropped) continue;
            const double gap = dot(reference.normal, incident.ends[i] - reference.ends[0]) * one_slope;
            const double here = std::min(reference_radius + incident_radius - gap, depth);
            if (here < -margin - tolerance) continue;
            const DVec<2> middle = incident.ends[i] - out * (incident_radius - 0.5 * here);
            candidates.points[candidates.count++] = {place.point(middle), margin > 0 ? here : std::max(here, 0.0),
                                                     incident.names[i]};
        }
    }
    bool as_deep = false;
    for (std::size_t i = 0; i < candidates.count; ++i)
        as_deep = as_deep || candidates.points[i].depth >= depth - tolerance;
    if (!as_deep)
        candidates.points[candidates.count++] = {distance.on_a - distance.normal * (0.5 * depth), depth,
                                                 distance.corners.a[0] << 8 ^ distance.corners.b[0]};
    reduce(candidates, tolerance, result);
}

}  // namespace abut::detail
