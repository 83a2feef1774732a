#include <abut/convex/pairs/point2.hpp>
#include <abut/convex/pairs/voronoi2.hpp>

namespace abut::detail {
namespace {

/// A walk takes a step or two. One that reaches this bound cycles on rounding.
constexpr int max_steps = 3 * static_cast<int>(max_soa_edges);

/// The Voronoi region test of a vertex: the edge beside corner i to which a direction from the corner leans, and the
/// projection onto it. The direction is in the region of the vertex itself if it leans to neither edge.
struct VertexRegion {
    bool outside;
    std::uint32_t side;
    double along;  ///< from the start of the edge
    double length;
};
VertexRegion vertex_region_of(const PolygonSoa& sides, std::uint32_t i, const DVec<2>& from_corner) {
    const double after = dot(sides.along(i), from_corner);
    if (after > 0) return {true, i, after, sides.length(i)};
    const std::uint32_t last = sides.before(i);
    const double before = dot(sides.along(last), from_corner);
    if (!(before < 0)) return {false, i, 0, 0};
    const double length = sides.length(last);
    return {true, last, length + before, length};
}

class Walk {
public:
    Walk(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], FeaturePair& features)
        : sides_{&a, &b}, seen_(seen), features_(features) {}

    bool finish() {
        auto& corners = features_.corners;
        // After a step to an end of an edge the other polygon is tested first, or the walk might return.
        std::uint32_t first = 0;
        for (int step = 0; step < max_steps; ++step) {
            const DVec<2> between = other_corner(0, corners[1]) - sides_[0]->corner(corners[0]);
            const DVec<2> direction[2] = {between, -seen_[1].vector(between)};
            bool outside = false;
            for (std::uint32_t turn = 0; turn < 2 && !outside; ++turn) {
                const std::uint32_t of = turn == 0 ? first : 1 - first;
                const VertexRegion to = vertex_region_of(*sides_[of], corners[of], direction[of]);
                if (!to.outside) continue;
                outside = true;
                if (to.along >= to.length || to.along <= 0) {
                    corners[of] = to.along <= 0 ? to.side : sides_[of]->after(to.side);
                    continue;
                }
                const Step outcome = step_to_edge(of, to.side);
                if (outcome != Step::moved) return outcome == Step::found;
                first = 1 - of;
            }
            if (outside) continue;
            features_.is_edge = false;
            return length_squared(between) > 0;
        }
        return false;
    }

private:
    enum class Step { found, moved, failed };

    /// A corner of the other polygon, relative to this one.
    DVec<2> other_corner(std::uint32_t of, std::uint32_t i) const { return seen_[of].point(sides_[1 - of]->corner(i)); }

    /// The other's corner in front of an edge. Moves to lower corners while they are nearer, and on to the end of the
    /// edge if the lower corner lies past it.
    Step step_to_edge(std::uint32_t of, std::uint32_t side) {
        const PolygonSoa &reference = *sides_[of], &other = *sides_[1 - of];
        std::uint32_t& k = features_.corners[1 - of];
        const auto gap = [&] { return dot(reference.normal(side), other_corner(of, k)) - reference.offset(side); };
        // A segment has two edges back to back.
        if (gap() < 0 && !(reference.area() > 0)) side = (side + reference.count / 2) % reference.count;
        if (!(gap() > 0)) return Step::failed;
        const DVec<2> down = -seen_[1 - of].vector(reference.normal(side));
        const double length = reference.length(side);
        for (std::uint32_t i = 0; i < other.count; ++i) {
            const bool forward = dot(other.along(k), down) > 0;
            if (!forward && !(dot(other.along(other.before(k)), down) < 0)) {
                features_.is_edge = true;
                features_.of = of;
                features_.side = side;
                return gap() > 0 ? Step::found : Step::failed;
            }
            const std::uint32_t edge = forward ? k : other.before(k), next = forward ? other.after(k) : edge;
            const double along = dot(reference.along(side), other_corner(of, next) - reference.corner(side));
            if (along >= 0 && along <= length) {
                k = next;
                continue;
            }
            // The other's edge passes an end of the edge: the end lies in front of the other's edge, or past its far
            // corner.
            const std::uint32_t end = along < 0 ? side : reference.after(side);
            features_.corners[of] = end;
            const DVec<2> from = seen_[1 - of].point(reference.corner(end)) - other.corner(edge);
            const double place = dot(other.along(edge), from);
            if (forward ? place >= other.length(edge) : place <= 0) k = next;
            return Step::moved;
        }
        return Step::failed;
    }

    const PolygonSoa* sides_[2];
    const Rigid2 (&seen_)[2];
    FeaturePair& features_;
};

}  // namespace

bool walk_to_closest(const PolygonSoa& a, const PolygonSoa& b, const Rigid2 (&seen)[2], FeaturePair& features) {
    return Walk(a, b, seen, features).finish();
}

/// Inside, the second nearest edge is the right one. Outside, of collinear edges the wrong one may have been found.
PointLocation locate_past_edge(PolygonSoa sides, Double2 local, std::uint32_t side, double gap) {
    const DVec<2> point = vector_of(local), normal = sides.normal(side);
    PointLocation place{gap, lanes::double2(normal.x, normal.y), side, sides.after(side)};
    const std::uint32_t after = place.second;
    const bool before = dot(sides.along(side), point - sides.corner(side)) < 0;
    if (!(place.gap > 0) && sides.count > 2) {
        place.first = before ? sides.before(side) : after;
        place.second = sides.after(place.first);
        return place;
    }
    std::uint32_t corner = before ? side : after;
    VertexRegion to = vertex_region_of(sides, corner, point - sides.corner(corner));
    for (std::uint32_t i = 0; i < sides.count && to.outside && !(to.along > 0 && to.along < to.length); ++i) {
        corner = to.along > 0 ? sides.after(to.side) : to.side;
        to = vertex_region_of(sides, corner, point - sides.corner(corner));
    }
    place.first = to.outside ? to.side : corner;
    place.second = to.outside ? sides.after(to.side) : corner;
    const DVec<2> from = point - sides.corner(corner);
    const double away = length(from);
    if (!to.outside && away > on_corner * (largest(point) + sides.size())) {
        place.gap = away;
        place.normal = lanes::double2(from.x / away, from.y / away);
    }
    return place;
}

}  // namespace abut::detail
