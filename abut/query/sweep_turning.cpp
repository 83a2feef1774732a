#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/sweep/rotating.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/sweep_turning.hpp>

namespace abut {
namespace {

/// The float at or below a time from 0 to 1.
float rounded_down(double time) {
    const float nearest = static_cast<float>(time);
    return static_cast<double>(nearest) > time ? std::nextafter(nearest, 0.0f) : nearest;
}

/// Filters the normal of a hit on an internal edge of a composite shape.
template <int D>
void filter_normal(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
                   const RotatingImpact<D>& impact, Hit<D>& hit) {
    if (!std::holds_alternative<Composite<D>>(b)) return;
    const View<D> moved_b = moved(b, place_at(path_b, impact.time));
    const auto closest_points = [&](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
        each_closest_point_on(moved_b, from, within, visit);
    };
    MoverAtHit<D> mover = rotating_mover_at_hit(a, path_a, impact.time, impact.point);
    mover.direction -= path_b.velocity(impact.time, impact.point);
    Hit<D> filtered = hit;
    filtered.point = to_float(impact.point);
    filter_hit_normal<D>(mover, moved_b, closest_points, filtered);
    hit.normal = filtered.normal;
}
/// A single part has no internal edges.
template <int D>
void filter_normal(const Convex<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&,
                   const RotatingImpact<D>&, Hit<D>&) {}

/// Calls find(path_a, path_b, impact) in a frame in which A's pivot stays at the origin, so that precision doesn't
/// depend on the distance from the world's origin.
template <int D, class Shape, class Find>
void find_hit(const Shape& a, RigidPath<D>& path_a, const Shape& b, RigidPath<D>& path_b, const Find& find,
              std::optional<Hit<D>>& result) {
    if (!detail::is_valid_pair(a, b, path_a, path_b)) return;
    const DVec<D> start = path_a.start.offset, move = path_a.move;
    path_b.start.offset -= start;
    path_b.move -= move;
    path_a.start.offset = path_a.move = DVec<D>(0.0);
    RotatingImpact<D> impact;
    if (!find(path_a, path_b, impact)) return;
    Hit<D>& hit = result.emplace();
    hit.fraction = rounded_down(impact.time);
    hit.distance = hit.fraction * static_cast<float>(length(path_b.move));
    hit.point = to_float(impact.point + start + move * impact.time);
    hit.normal = to_float(-impact.normal);
    hit.started_inside = impact.started_inside;
    hit.feature = impact.feature;
    filter_normal(a, path_a, b, path_b, impact, hit);
}

template <int D>
std::optional<Hit<D>> sweep_paths(const Convex<D>& a, RigidPath<D> path_a, const Convex<D>& b, RigidPath<D> path_b,
                                  const QueryOptions<D>& options) {
    const auto find = [&](const auto& local_a, const auto& local_b, RotatingImpact<D>& impact) {
        return time_of_impact<D>(a, local_a, b, local_b, RotatingSweepLimits{}, {options.cache, options.trace}, impact);
    };
    std::optional<Hit<D>> result;
    find_hit(a, path_a, b, path_b, find, result);
    return result;
}

template <int D>
std::optional<Hit<D>> sweep_paths(const View<D>& a, RigidPath<D> path_a, const View<D>& b, RigidPath<D> path_b,
                                  const QueryOptions<D>& options) {
    const auto find = [&](const auto& local_a, const auto& local_b, RotatingImpact<D>& impact) {
        return time_of_impact<D>(a, local_a, b, local_b, search_options(a, b, options), impact);
    };
    std::optional<Hit<D>> result;
    find_hit(a, path_a, b, path_b, find, result);
    return result;
}

}  // namespace

template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Motion<D>& motion_a, const Convex<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options) {
    return sweep_paths(a, rigid_path(motion_a), b, rigid_path(motion_b), options);
}
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Motion<D>& motion_a, const ShapeRef<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options) {
    return sweep(convex_of(a), motion_a, convex_of(b), motion_b, options);
}
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Motion<D>& motion_a, const View<D>& b, const Motion<D>& motion_b,
                            const QueryOptions<D>& options) {
    return sweep_paths(a, rigid_path(motion_a), b, rigid_path(motion_b), options);
}

template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const Convex<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return sweep_paths(a, rigid_path(from_a, to_a), b, rigid_path(from_b, to_b), options);
}
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const ShapeRef<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return sweep(convex_of(a), from_a, to_a, convex_of(b), from_b, to_b, options);
}
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const View<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return sweep_paths(a, rigid_path(from_a, to_a), b, rigid_path(from_b, to_b), options);
}

#define ABUT_INSTANTIATE_FOR(D, S)                                                                           \
    template std::optional<Hit<D>> sweep(const S&, const Motion<D>&, const S&, const Motion<D>&,             \
                                         const QueryOptions<D>&);                                            \
    template std::optional<Hit<D>> sweep(const S&, const Pose<D>&, const Pose<D>&, const S&, const Pose<D>&, \
                                         const Pose<D>&, const QueryOptions<D>&);
#define ABUT_INSTANTIATE(D)            \
    ABUT_INSTANTIATE_FOR(D, View<D>)   \
    ABUT_INSTANTIATE_FOR(D, Convex<D>) \
    ABUT_INSTANTIATE_FOR(D, ShapeRef<D>)
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE
#undef ABUT_INSTANTIATE_FOR

}  // namespace abut
