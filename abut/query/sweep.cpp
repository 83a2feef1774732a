// Continuous collision detection of two shapes: the time of impact of a motion in a straight line (a shape cast, or
// convex cast) or with rotation.

#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/solid/solid_motion.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/sweep.hpp>

namespace abut {

using namespace detail;

namespace {

/// Filters the normal of a hit on an internal edge of a composite shape, which is placed as at the moment of the hit;
/// `point` is the point of contact there.
template <int D>
void filter_normal(const MoverAtHit<D>& mover, const View<D>& shape, const DVec<D>& point, Hit<D>& hit) {
    Hit<D> filtered = hit;
    filtered.point = to_float(point);
    filter_hit_normal<D>(mover, shape, nullptr, filtered);
    hit.normal = filtered.normal;
}

// Straight motions.

/// The two motions of a query.
template <int D>
struct Motions {
    Path<D> path;      ///< of A relative to B
    DVec<D> motion_b;  ///< of B in the world

    Motions(const Vec<D>& a, const Vec<D>& b) : motion_b(b) {
        const DVec<D> displacement = DVec<D>(a) - motion_b;
        path.length = length(displacement);
        path.direction = normalized(displacement);
    }
};

template <int D>
void write_hit(const Motions<D>& motions, const LinearImpact<D>& first, Hit<D>& hit) {
    const double fraction = std::min(first.along / motions.path.length, 1.0);
    hit.fraction = static_cast<float>(fraction);
    hit.distance = static_cast<float>(first.along);
    hit.point = to_float(first.point + motions.motion_b * fraction);
    hit.normal = to_float(-first.normal);
    hit.started_inside = first.started_inside;
    hit.feature = first.feature;
}

/// Calls find(path, first) for the first impact along a path.
template <int D, class Shapes, class Find>
void find_first_impact(const Shapes& a, const Vec<D>& motion_a, const Shapes& b, const Vec<D>& motion_b,
                       const Find& find, std::optional<Hit<D>>& result) {
    if (!detail::is_valid_pair(a, b, motion_a, motion_b)) return;
    const Motions<D> motions(motion_a, motion_b);
    if (!(motions.path.length > 0)) return;
    LinearImpact<D> first;
    if (find(motions.path, first)) write_hit(motions, first, result.emplace());
}

/// Out of line, to keep the fast path small.
[[gnu::noinline]] void sweep_views(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b,
                                   const Vec2& motion_b, const QueryOptions<2>& options,
                                   std::optional<Hit<2>>& result) {
    result = sweep(convex_of(a), motion_a, convex_of(b), motion_b, options);
}

// Motions with rotation.

/// The float at or below a time from 0 to 1.
float rounded_down(double time) {
    const float nearest = static_cast<float>(time);
    return static_cast<double>(nearest) > time ? std::nextafter(nearest, 0.0f) : nearest;
}

/// Calls find(impact) in a frame in which A's pivot stays at the origin, so that precision doesn't depend on the
/// distance from the world's origin.
template <int D, class Shape, class Find>
std::optional<Hit<D>> hit_on_paths(const Shape& a, RigidPath<D>& path_a, const Shape& b, RigidPath<D>& path_b,
                                   const Find& find) {
    std::optional<Hit<D>> result;
    if (!detail::is_valid_pair(a, b, path_a, path_b)) return result;
    const DVec<D> start = path_a.start.offset, move = path_a.move;
    path_b.start.offset -= start;
    path_b.move -= move;
    path_a.start.offset = path_a.move = DVec<D>(0.0);
    RotatingImpact<D> impact;
    if (!find(impact)) return result;
    Hit<D>& hit = result.emplace();
    hit.fraction = rounded_down(impact.time);
    hit.distance = hit.fraction * static_cast<float>(length(path_b.move));
    hit.point = to_float(impact.point + start + move * impact.time);
    hit.normal = to_float(-impact.normal);
    hit.started_inside = impact.started_inside;
    hit.feature = impact.feature;
    return result;
}

template <int D>
std::optional<Hit<D>> sweep_part_paths(const View<D>& a, RigidPath<D> path_a, const View<D>& b, RigidPath<D> path_b,
                                       const QueryOptions<D>& options) {
    RotatingImpact<D> first;
    std::optional<Hit<D>> result = hit_on_paths(a, path_a, b, path_b, [&](RotatingImpact<D>& impact) {
        const bool found = time_of_impact<D>(a, path_a, b, path_b, search_options(a, b, options), impact);
        first = impact;
        return found;
    });
    if (result && std::holds_alternative<Composite<D>>(b)) {
        MoverAtHit<D> mover = rotating_mover_at_hit(a, path_a, first.time, first.point);
        mover.direction -= path_b.velocity(first.time, first.point);
        filter_normal<D>(mover, moved(b, place_at(path_b, first.time)), first.point, *result);
    }
    return result;
}

/// The rest of a path after a time.
RigidPath<3> rest_of(const RigidPath<3>& path, double time) {
    return {place_at(path, time), path.move * (1 - time), path.angular_velocity * (1 - time)};
}

std::optional<Hit<3>> sweep_solid(const View<3>& a, const RigidPath<3>& path_a, const View<3>& b,
                                  const RigidPath<3>& path_b, const QueryOptions<3>& options) {
    const auto closest_at = [&](double time) {
        return closest(moved(a, place_at(path_a, time)), moved(b, place_at(path_b, time)));
    };
    const auto closing = [&](const Closest<3>& nearest) {
        const DVec<3> place = (DVec<3>(nearest.on_a) + DVec<3>(nearest.on_b)) * 0.5;
        return dot(path_a.velocity(0, place) - path_b.velocity(0, place), DVec<3>(nearest.normal));
    };
    const auto surface_hit = [&](double time) {
        return time == 0 ? sweep_part_paths(a, path_a, b, path_b, options)
                         : sweep_part_paths(a, rest_of(path_a, time), b, rest_of(path_b, time), options);
    };
    const double max_speed = relative_motion_bounds(path_a, path_b, reach_of(bounds(a))).speed;
    return detail::sweep_solid(moved(a, path_a.start), moved(b, path_b.start), max_speed,
                               length(path_a.move - path_b.move), closest_at, closing, surface_hit);
}

}  // namespace

template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Vec<D>& motion_a, const Convex<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    const auto find = [&](const Path<D>& path, LinearImpact<D>& first) {
        return front_time_of_impact<D>(a, path, b, 0, {options.cache, options.trace}, first);
    };
    find_first_impact(a, motion_a, b, motion_b, find, result);
    return result;
}

template <>
std::optional<Hit<2>> sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                            const QueryOptions<2>& options) {
    std::optional<Hit<2>> result;
    if (options.trace != nullptr || closed_form_sweep(a, motion_a, b, motion_b, result) == PairAnswer::unknown)
        sweep_views(a, motion_a, b, motion_b, options, result);
    return result;
}
template <>
std::optional<Hit<3>> sweep(const ShapeRef<3>& a, const Vec3& motion_a, const ShapeRef<3>& b, const Vec3& motion_b,
                            const QueryOptions<3>& options) {
    return sweep(convex_of(a), motion_a, convex_of(b), motion_b, options);
}

namespace {

template <int D>
std::optional<Hit<D>> sweep_parts_unfiltered(const View<D>& a, const Vec<D>& motion_a, const View<D>& b,
                                             const Vec<D>& motion_b, const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    const auto find = [&](const Path<D>& path, LinearImpact<D>& first) {
        const SearchOptions<D> options_of_pair = search_options(a, b, options);
        return first_impact(a, path, b, {options_of_pair.cache, options_of_pair.trace}, first);
    };
    find_first_impact(a, motion_a, b, motion_b, find, result);
    return result;
}

template <int D>
std::optional<Hit<D>> sweep_parts(const View<D>& a, const Vec<D>& motion_a, const View<D>& b, const Vec<D>& motion_b,
                                  const QueryOptions<D>& options) {
    std::optional<Hit<D>> result = sweep_parts_unfiltered(a, motion_a, b, motion_b, options);
    if (result && std::holds_alternative<Composite<D>>(b)) {
        // Relative to B's start.
        const DVec<D> moved_b = DVec<D>(motion_b) * static_cast<double>(result->fraction);
        const DVec<D> moved_a = DVec<D>(motion_a) * static_cast<double>(result->fraction);
        filter_normal(linear_mover_at_hit<D>(a, moved_a - moved_b), b, DVec<D>(result->point) - moved_b, *result);
    }
    return result;
}

View<3> translated(const View<3>& shape, const DVec<3>& by) {
    Affine<3> place = Affine<3>();
    place.offset = by;
    return moved(shape, place);
}

std::optional<Hit<3>> sweep_solid(const View<3>& a, const Vec3& motion_a, const View<3>& b, const Vec3& motion_b,
                                  const QueryOptions<3>& options) {
    const DVec<3> of_a(motion_a), of_b(motion_b);
    const double speed = length(of_a - of_b);
    const auto closest_at = [&](double time) {
        return closest(translated(a, of_a * time), translated(b, of_b * time));
    };
    const auto closing = [&](const Closest<3>& nearest) { return dot(of_a - of_b, DVec<3>(nearest.normal)); };
    const auto surface_hit = [&](double time) {
        return time == 0 ? sweep_parts(a, motion_a, b, motion_b, options)
                         : sweep_parts(translated(a, of_a * time), to_float(of_a * (1 - time)),
                                       translated(b, of_b * time), to_float(of_b * (1 - time)), options);
    };
    return detail::sweep_solid(a, b, speed, speed, closest_at, closing, surface_hit);
}

}  // namespace

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Vec<D>& motion_a, const View<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options) {
    if constexpr (D == 3)
        if (has_solid(a, b) && detail::is_valid_pair(a, b, motion_a, motion_b))
            return sweep_solid(a, motion_a, b, motion_b, options);
    return sweep_parts(a, motion_a, b, motion_b, options);
}

template <int D>
std::optional<Hit<D>> detail::sweep_unfiltered(const View<D>& a, const Vec<D>& motion, const View<D>& b) {
    if (has_solid(a, b)) return sweep(a, motion, b, Vec<D>(0.0f), {});
    return sweep_parts_unfiltered(a, motion, b, Vec<D>(0.0f), {});
}

template <int D>
std::optional<Hit<D>> detail::sweep_paths(const Convex<D>& a, RigidPath<D> path_a, const Convex<D>& b,
                                          RigidPath<D> path_b, const QueryOptions<D>& options) {
    return hit_on_paths(a, path_a, b, path_b, [&](RotatingImpact<D>& impact) {
        return time_of_impact<D>(a, path_a, b, path_b, {}, {options.cache, options.trace}, impact);
    });
}

template <int D>
std::optional<Hit<D>> detail::sweep_paths(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b,
                                          const RigidPath<D>& path_b, const QueryOptions<D>& options) {
    if constexpr (D == 3)
        if (has_solid(a, b) && detail::is_valid_pair(a, b, path_a, path_b))
            return abut::sweep_solid(a, path_a, b, path_b, options);
    return abut::sweep_part_paths(a, path_a, b, path_b, options);
}

template <int D>
std::optional<Hit<D>> detail::sweep_paths(const ShapeRef<D>& a, const RigidPath<D>& path_a, const ShapeRef<D>& b,
                                          const RigidPath<D>& path_b, const QueryOptions<D>& options) {
    return sweep_paths(convex_of(a), path_a, convex_of(b), path_b, options);
}

#define ABUT_INSTANTIATE(D)                                                                                            \
    template std::optional<Hit<D>> detail::sweep_unfiltered(const View<D>&, const Vec<D>&, const View<D>&);            \
    template std::optional<Hit<D>> detail::sweep_paths(const View<D>&, const RigidPath<D>&, const View<D>&,            \
                                                       const RigidPath<D>&, const QueryOptions<D>&);                   \
    template std::optional<Hit<D>> detail::sweep_paths(const Convex<D>&, RigidPath<D>, const Convex<D>&, RigidPath<D>, \
                                                       const QueryOptions<D>&);                                        \
    template std::optional<Hit<D>> detail::sweep_paths(const ShapeRef<D>&, const RigidPath<D>&, const ShapeRef<D>&,    \
                                                       const RigidPath<D>&, const QueryOptions<D>&);                   \
    template std::optional<Hit<D>> sweep(const View<D>&, const Vec<D>&, const View<D>&, const Vec<D>&,                 \
                                         const QueryOptions<D>&);                                                      \
    template std::optional<Hit<D>> sweep(const Convex<D>&, const Vec<D>&, const Convex<D>&, const Vec<D>&,             \
                                         const QueryOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
