// The set is parted from the solid where it crosses no triangle and is not inside. Along a direction it gets there step
// by step: past the last of the triangles that it crosses, or, inside the solid, as far as the surface is away. The
// directions are those of the triangles that it crosses and of those near it, the axes, and the normals of the planes
// through which a move left the solid. A search over moves to where planes meet takes care of notches.

#include <abut/query/detail/pair_dispatch.hpp>
#include <abut/query/detail/solid/convex_depth.hpp>
#include <abut/query/detail/solid/placed_solid.hpp>
#include <abut/query/detail/solid/plane_meets.hpp>
#include <abut/shape/ball.hpp>
#include <abut/shape/view/part.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace abut::detail {
namespace {

/// A point of a convex core, near its middle.
DVec<3> middle_of_core(const Convex<3>& set) {
    DVec<3> sum(0.0);
    if (set.core == Core::points && set.inner_radius == 0) {
        for (std::uint32_t i = 0; i < set.count; ++i) sum += set.place.point(DVec<3>(set.vertices()[i]));
        return sum / static_cast<double>(set.count);
    }
    for (int i = 0; i < 3; ++i)
        for (const double sign : {1.0, -1.0}) sum += core_support(set, axis<3>(i, sign)).position;
    return sum / 6.0;
}

/// A segment or a triangle, which may enter a solid by an edge, where it is 0 deep in each triangle.
bool is_thin(const Convex<3>& set) {
    return set.core == Core::points && set.count > 1 && set.count <= 3 && set.radius == 0 && set.inner_radius == 0;
}

/// A set slightly inside of one with a volume; none for others. If the smaller set touches a triangle, the triangle
/// shares a point with the interior of the set.
std::optional<Convex<3>> eroded(const Convex<3>& set, const DVec<3>& middle, double tolerance) {
    Convex<3> result = set;
    if (set.radius > 8 * tolerance) {
        result.radius -= tolerance;
        return result;
    }
    const bool is_round =
        set.inner_radius > 0 || set.core == Core::function || (set.core == Core::discs && set.own[0] != set.own[1]);
    if (!is_round || determinant(set.place) == 0) return std::nullopt;
    const double shrunk = 1 - 4 * tolerance / size(set);
    for (DVec<3>& column : result.place.column) column *= shrunk;
    result.scale *= shrunk;
    result.place.offset += (middle - set.place.offset) * (1 - shrunk);
    return result;
}

class ConvexSearch : LeastMoveSearch {
public:
    ConvexSearch(const View<3>& solid, const Convex<3>& set)
        : surface_(surface_view(solid)), solid_(solid), set_(set), middle_(middle_of_core(set)) {
        const double extent = length(DVec<3>(solid_.box().max) - DVec<3>(solid_.box().min));
        const double smaller = std::min(size(set), extent);
        const Aabb3 box = bounds(set);
        double farthest = 0;
        for (const Aabb3& around : {solid_.box(), box})
            farthest = std::max({farthest, largest(DVec<3>(around.min)), largest(DVec<3>(around.max))});
        tolerance_ = 1e-6 * (smaller > 0 ? smaller : extent) + 1e-12 * farthest;
        eroded_ = eroded(set, middle_, tolerance_);
        float_step_ = 0x1p-23 * farthest;
    }

    bool is_inside() const { return is_inside_at(DVec<3>(0.0)); }

    bool find(Closest<3>& closest) {
        bool crosses = false;
        each_crossing(DVec<3>(0.0), [&](const Convex<3>& triangle) {
            crosses = true;
            crossed_[crossed_count_++] = triangle;
            return crossed_count_ < crossed_.size();
        });
        if (!crosses && !is_inside()) return false;
        find_least_possible();
        try_direction(nearest_direction_);
        for (std::size_t i = 0; i < crossed_count_ && !is_least(); ++i) {
            try_direction(distance_from(crossed_[i], set_).normal);
            if (!is_least()) try_direction(normal_of(crossed_[i]));
        }
        for (int i = 0; i < 3; ++i)
            for (const double sign : {1.0, -1.0})
                if (!is_least()) try_direction(axis<3>(i, sign));
        if (!is_least()) try_triangles_near();
        if (!is_least() && best_distance_ < unlimited_move) search_meets(max_meets, 2 * tolerance_);
        if (!(best_distance_ < unlimited_move)) leave_box(solid_.box(), bounds(set_));
        write(closest);
        return true;
    }

private:
    Convex<3> moved_by(const DVec<3>& move) const { return moved_by(move, set_); }
    static Convex<3> moved_by(const DVec<3>& move, const Convex<3>& set) {
        Convex<3> result = set;
        result.place.offset += move;
        return result;
    }

    static SignedDistance<3> distance_from(const Convex<3>& triangle, const Convex<3>& set) {
        return part_distance<3>(triangle, set, SearchOptions<3>{});
    }

    /// Whether the set crosses a triangle after a move, deeper than the tolerance.
    bool crosses(const Convex<3>& triangle, const DVec<3>& move) const {
        if (eroded_) return part_overlaps<3>(triangle, moved_by(move, *eroded_), SearchOptions<3>{});
        return distance_from(triangle, moved_by(move)).distance < -tolerance_;
    }

    /// Visits the triangles that the set crosses after a move; false stops.
    template <class Visit>
    void each_crossing(const DVec<3>& move, const Visit& visit) const {
        each_part<3>(std::get<Composite<3>>(surface_), bounds(moved_by(move)),
                     [&](const Convex<3>& triangle, std::uint32_t) -> bool {
                         return !crosses(triangle, move) || visit(triangle);
                     });
    }

    /// Whether a point is inside of a set that crosses no triangle.
    bool is_inside_at(const DVec<3>& move) const {
        if (is_inside_point(middle_ + move)) return true;
        if (!is_thin(set_)) return false;
        const Convex<3> moved = moved_by(move);
        std::optional<DVec<3>> first;
        bool found = false;
        each_part<3>(std::get<Composite<3>>(surface_), bounds(moved),
                     [&](const Convex<3>& triangle, std::uint32_t) -> bool {
                         const SignedDistance<3> touch = part_distance<3>(triangle, moved, SearchOptions<3>{});
                         if (touch.distance > tolerance_) return true;
                         if (!first) first = touch.on_a;
                         found = is_inside_point((touch.on_a + middle_ + move) * 0.5) ||
                                 is_inside_point((touch.on_a + *first) * 0.5);
                         return !found;
                     });
        return found;
    }
    bool is_inside_point(const DVec<3>& point) const { return solid_.side_of(point) == PointSide::inside; }

    bool parts(const DVec<3>& move) const override {
        bool any = false;
        each_crossing(move, [&](const Convex<3>&) { return !(any = true); });
        return !any && !is_inside_at(move);
    }

    bool is_least() const { return best_distance_ <= least_possible_ * 1.01 + tolerance_; }

    /// No move is shorter than the radius of a ball in the set, less the signed distance of its centre.
    void find_least_possible() {
        const auto offer = [&](const DVec<3>& center) {
            const Closest<3> nearest = closest(surface_, Ball<3>{to_float(center), 0});
            const bool inside = solid_.side_of(DVec<3>(to_float(center))) == PointSide::inside;
            const double distance = std::abs(static_cast<double>(nearest.distance)), sign = inside ? -1 : 1;
            const double least = set_.radius - sign * distance;
            if (nearest_direction_ != DVec<3>(0.0) && least <= least_possible_) return;
            least_possible_ = least;
            nearest_direction_ = DVec<3>(nearest.normal) * sign;
        };
        offer(middle_);
        if (set_.core != Core::points || set_.inner_radius > 0) return;
        for (std::uint32_t i = 0; i < std::min(set_.count, max_centers); ++i)
            offer(set_.place.point(DVec<3>(set_.vertices()[i])));
    }

    /// False if one of the first triangles that the set crosses at the start is still crossed at the limit, and so in
    /// between.
    bool may_improve(const DVec<3>& direction) override {
        if (!(limit() < unlimited_move)) return true;
        return std::none_of(crossed_.begin(), crossed_.begin() + static_cast<std::ptrdiff_t>(crossed_count_),
                            [&](const Convex<3>& triangle) { return crosses(triangle, direction * limit()); });
    }

    Exit exit_along(const DVec<3>& direction, double limit) override {
        double distance = 0;
        DVec<3> normal(0.0);
        for (int i = 0; i < max_steps && distance < limit; ++i) {
            const double before = distance;
            each_crossing(direction * before, [&](const Convex<3>& triangle) {
                if (distance == before || crosses(triangle, direction * distance))
                    distance = exit_from(triangle, direction, distance, limit, normal);
                return distance < limit;
            });
            if (distance > before) continue;
            if (!is_inside_at(direction * distance)) return {distance, normal};
            const double gap = static_cast<double>(closest(surface_, View<3>(moved_by(direction * distance))).distance);
            distance += std::max(gap, 0.0) + 2 * tolerance_;
        }
        return {};
    }

    /// How far the set goes until it no longer crosses a triangle, which it crosses now. The distance of two convex
    /// sets is a convex function of the move, so Newton's method from beyond the exit never passes it.
    double exit_from(const Convex<3>& triangle, const DVec<3>& direction, double from, double limit,
                     DVec<3>& normal) const {
        double distance =
            dot(direction, core_support(triangle, direction).position - core_support(set_, -direction).position) +
            set_.radius;
        if (distance > limit) {
            if (crosses(triangle, direction * limit)) return unlimited_move;
            distance = limit;
        }
        for (int i = 0; i < max_steps; ++i) {
            const SignedDistance<3> gap = distance_from(triangle, moved_by(direction * distance));
            normal = gap.normal;
            const double speed = dot(gap.normal, direction);
            if (!(gap.distance > 0.1 * tolerance_) || !(speed > 1e-9)) break;
            distance -= gap.distance / speed;
        }
        return std::max(distance, from + tolerance_);
    }

    void try_triangles_near() {
        const double reach =
            std::min(best_distance_, size(set_) + length(DVec<3>(solid_.box().max - solid_.box().min)));
        int count = 0;
        each_part<3>(std::get<Composite<3>>(surface_), grown(bounds(set_), static_cast<float>(reach)),
                     [&](const Convex<3>& triangle, std::uint32_t) -> bool {
                         try_direction(normal_of(triangle));
                         return !is_least() && ++count < max_normals;
                     });
    }

    /// Out of the solid.
    DVec<3> normal_of(const Convex<3>& triangle) const {
        const auto corner = [&](std::size_t i) { return triangle.place.point(DVec<3>(triangle.vertices()[i])); };
        const DVec<3> normal = normalized<3>(cross(corner(1) - corner(0), corner(2) - corner(0)));
        return solid_.is_flipped() ? -normal : normal;
    }

    void collect_planes(const DVec<3>& move, NearestPlanes& planes) const override {
        std::size_t count = 0;
        each_crossing(move, [&](const Convex<3>& triangle) {
            const SignedDistance<3> crossing = distance_from(triangle, moved_by(move));
            planes.add({crossing.normal, dot(crossing.normal, move) - crossing.distance}, limit());
            const DVec<3> normal = normal_of(triangle);
            const double depth = dot(normal, triangle.place.point(DVec<3>(triangle.vertices()[0]))) -
                                 dot(normal, core_support(set_, -normal).position) + set_.radius;
            planes.add({normal, depth}, limit());
            return ++count < crossed_.size();
        });
    }

    void write(Closest<3>& result) const {
        const DVec<3> move = DVec<3>(best_.normal) * best_distance_;
        const Closest<3> touch = closest(surface_, View<3>(moved_by(move)));
        result.distance = static_cast<float>(-best_distance_);
        result.normal = best_.normal;
        result.on_a = touch.on_a;
        result.on_b = to_float(DVec<3>(touch.on_a) - move);
        result.feature_a = touch.feature_a;
        result.feature_b = touch.feature_b;
    }

    static constexpr std::uint32_t max_centers = 16;
    static constexpr int max_steps = 64, max_normals = 12, max_meets = 8;

    View<3> surface_;
    PlacedSolid solid_;
    const Convex<3>& set_;
    std::optional<Convex<3>> eroded_;
    DVec<3> middle_, nearest_direction_{0.0};
    std::array<Convex<3>, 8> crossed_;  ///< at the start
    std::size_t crossed_count_ = 0;
    double least_possible_ = 0;
};

}  // namespace

bool is_inside_solid(const View<3>& solid, const Convex<3>& set) {
    return ConvexSearch(solid, set).is_inside();
}

bool find_convex_depth(const View<3>& solid, const Convex<3>& set, Closest<3>& closest) {
    return ConvexSearch(solid, set).find(closest);
}

}  // namespace abut::detail
