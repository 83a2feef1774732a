#include <abut/convex/polygon_manifold.hpp>
#include <abut/math/lanes-inl.h>

namespace abut {
namespace {

/// A side as seen from the reference of the meeting.
struct Edge {
    DVec<2> ends[2];
    std::uint32_t names[2];
    DVec<2> normal;
    double alignment;  ///< of its normal with the direction it is to look along
};

/// The corners of a box are counted round it here, as `face_along` does.
std::uint32_t name_of(const Sides& sides, std::uint32_t corner) {
    return sides.numbering == Numbering::box ? (corner + 2) & 3 : sides.corner_number(corner);
}

/// Of the sides beside a corner the one that looks most along a direction, both in the polygon's own frame.
inline std::uint32_t facing_side(const Sides& sides, std::uint32_t corner, const DVec<2>& direction,
                                 double& alignment) {
    const auto looks = [&](std::uint32_t side) {
        const bool proper = sides.corner(side) != sides.corner(sides.after(side));
        return proper ? dot(sides.normal(side), direction) : -1;
    };
    const std::uint32_t last = sides.before(corner);
    const double next_looks = looks(corner), last_looks = looks(last);
    alignment = std::max(next_looks, last_looks);
    return last_looks > next_looks ? last : corner;
}

void find_reference_edge(const PolygonPair& pair, const Meeting& meeting, Edge& edge) {
    const Sides& sides = pair.sides(meeting.of);
    const std::uint32_t side = facing_side(sides, meeting.reference_corners[0], meeting.normal, edge.alignment);
    const std::uint32_t after = sides.after(side);
    edge.ends[0] = sides.corner(side);
    edge.ends[1] = sides.corner(after);
    edge.names[0] = name_of(sides, side);
    edge.names[1] = name_of(sides, after);
    edge.normal = sides.normal(side);
}

void find_other_edge(const PolygonPair& pair, const Meeting& meeting, Edge& edge) {
    const Sides& sides = pair.sides(1 - meeting.of);
    const Rigid2& seen = pair.seen_from(meeting.of);
    const DVec<2> direction = -pair.seen_from(1 - meeting.of).vector(meeting.normal);
    const std::uint32_t side = facing_side(sides, meeting.other_corners[0], direction, edge.alignment);
    const std::uint32_t after = sides.after(side);
    edge.ends[0] = seen.point(sides.corner(side));
    edge.ends[1] = seen.point(sides.corner(after));
    edge.names[0] = name_of(sides, side);
    edge.names[1] = name_of(sides, after);
    edge.normal = seen.vector(sides.normal(side));
}

/// At most three points: the ends of an edge that was cut off, and the place where the two are nearest.
struct Candidates {
    std::array<ManifoldPoint<2>, 3> points;
    std::size_t count = 0;
};

/// The part of an edge beside a side that runs from `low` to `high` along `across`. False: there is none. By arithmetic
/// without a branch: which ends are cut off can't be guessed.
inline bool cut_to(const Edge& reference, const DVec<2>& across, Edge& edge, double (&along)[2]) {
    using namespace lanes;
    const double low = dot(across, reference.ends[0]), high = dot(across, reference.ends[1]);
    const Both from{low, low}, to{high, high}, at{dot(across, edge.ends[0]), dot(across, edge.ends[1])};
    const Both kept = lesser(greater(at, from), to), way = kept - at;
    const std::uint32_t below = bits(at < from), above = bits(at > to);
    if (below == 3 || above == 3) return false;
    const DVec<2> whole = edge.ends[1] - edge.ends[0];
    const double run = at[1] - at[0], part = run != 0 ? 1 / run : 0;
    for (std::uint32_t i = 0; i < 2; ++i) {
        edge.ends[i] += whole * (way[i] * part);
        const std::uint32_t cut_low = below >> i & 1u, cut_high = above >> i & 1u;
        edge.names[i] |= ((reference.names[0] + 1) * cut_low | (reference.names[1] + 1) * cut_high) << 16;
        along[i] = kept[i];
    }
    return true;
}

/// Number by number.
inline void put(const ManifoldPoint<2>& from, ManifoldPoint<2>& to) {
    to.position.x = from.position.x;
    to.position.y = from.position.y;
    to.depth = from.depth;
    to.feature = from.feature;
}

/// The deepest, of those as deep to within the slack the first, and the farthest from it.
void thin_out(const Candidates& all, double slack, Manifold<2>& result) {
    result.count = std::min(all.count, result.points.size());
    if (all.count < 3) {
        for (std::size_t i = 0; i < result.count; ++i) put(all.points[i], result.points[i]);
        return;
    }
    const auto& points = all.points;
    const double least = std::max({points[0].depth, points[1].depth, points[2].depth}) - slack;
    const std::size_t deepest = points[0].depth >= least ? 0 : points[1].depth >= least ? 1 : 2;
    const std::size_t i = (deepest + 1) % 3, j = (deepest + 2) % 3;
    const auto far = [&](std::size_t k) { return length_squared(points[k].position - points[deepest].position); };
    put(points[deepest], result.points[0]);
    put(points[far(j) > far(i) ? j : i], result.points[1]);
}

}  // namespace

void set_polygon_manifold(const PolygonPair& pair, const Meeting& meeting, const SignedDistance<2>& distance,
                          double margin, Manifold<2>& result) {
    const Outline &a = pair.outline(0), &b = pair.outline(1);
    const double slack = 1e-6 * std::min(a.sides.size + a.radius, b.sides.size + b.radius);
    const double depth = -distance.distance;
    const Rigid2& place = pair.outline(meeting.of).place;
    Edge of_reference, of_other;
    find_reference_edge(pair, meeting, of_reference);
    find_other_edge(pair, meeting, of_other);

    Candidates candidates;
    if (std::max(of_reference.alignment, of_other.alignment) >= aligned) {
        const bool first_is_a = meeting.of == 0;
        const double of_a = first_is_a ? of_reference.alignment : of_other.alignment,
                     of_b = first_is_a ? of_other.alignment : of_reference.alignment;
        const bool a_is_reference = of_a >= of_b - 1e-6;
        const bool same = a_is_reference == first_is_a;
        const Edge& reference = same ? of_reference : of_other;
        Edge& incident = same ? of_other : of_reference;
        const DVec<2> out = same ? meeting.normal : -meeting.normal, across(-out.y, out.x);
        const double reference_radius = a_is_reference ? a.radius : b.radius;
        const double incident_radius = a_is_reference ? b.radius : a.radius;

        // Counter-clockwise, a side runs along `across`.
        double along[2] = {0, 0};
        const bool left = cut_to(reference, across, incident, along);
        // Where but an end is left of the edge, it is one point: the end itself, if it wasn't cut off.
        const bool one = std::abs(along[0] - along[1]) <= slack;
        const std::size_t dropped = !one ? 2 : incident.names[1] < 1u << 16 ? 0 : 1;
        const double one_slope = 1 / dot(reference.normal, out);
        for (std::size_t i = 0; i < 2 && left; ++i) {
            if (i == dropped) continue;
            const double gap = dot(reference.normal, incident.ends[i] - reference.ends[0]) * one_slope;
            const double here = std::min(reference_radius + incident_radius - gap, depth);
            if (here < -margin - slack) continue;
            const DVec<2> middle = incident.ends[i] - out * (incident_radius - 0.5 * here);
            candidates.points[candidates.count++] = {place.point(middle), margin > 0 ? here : std::max(here, 0.0),
                                                     incident.names[i]};
        }
    }
    bool as_deep = false;
    for (std::size_t i = 0; i < candidates.count; ++i) as_deep = as_deep || candidates.points[i].depth >= depth - slack;
    if (!as_deep)
        candidates.points[candidates.count++] = {distance.on_a - distance.normal * (0.5 * depth), depth,
                                                 distance.corners.a[0] << 8 ^ distance.corners.b[0]};
    thin_out(candidates, slack, result);
}

}  // namespace abut
