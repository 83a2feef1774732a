#include <abut/math/assert.hpp>
#include <abut/query/felt_hit.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/sweep_turning.hpp>
#include <abut/query/turning_parts.hpp>

namespace abut {
namespace {

template <int D>
bool is_finite(const RigidPath<D>& path) {
    double sum = angular_speed(path.angular_velocity);
    for (int i = 0; i < D; ++i) sum += path.start.offset[i] + path.move[i];
    for (const DVec<D>& column : path.start.column)
        for (int i = 0; i < D; ++i) sum += column[i];
    return std::isfinite(sum);
}

/// The float at or below a time from 0 to 1.
float rounded_down(double time) {
    const float nearest = static_cast<float>(time);
    return static_cast<double>(nearest) > time ? std::nextafter(nearest, 0.0f) : nearest;
}

/// The normal of a meeting with a shape of many parts, as it is felt.
template <int D>
void feel(const View<D>& a, const RigidPath<D>& path_a, const View<D>& b, const RigidPath<D>& path_b,
          const Meeting<D>& meeting, Hit<D>& hit) {
    if (!std::holds_alternative<Composite<D>>(b)) return;
    const View<D> there = moved(b, place_at(path_b, meeting.time));
    const auto feet = [&](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
        each_foot_on(there, from, within, visit);
    };
    Arrival<D> mover = turning_arrival(a, path_a, meeting.time, meeting.point);
    mover.way -= path_b.velocity(meeting.time, meeting.point);
    Hit<D> felt = hit;
    felt.point = to_float(meeting.point);
    feel_hit<D>(mover, there, feet, felt);
    hit.normal = felt.normal;
}
/// There are no seams in one part.
template <int D>
void feel(const Convex<D>&, const RigidPath<D>&, const Convex<D>&, const RigidPath<D>&, const Meeting<D>&, Hit<D>&) {}

/// `find` is asked for the first meeting, in a frame in which A's pivot stays at the origin: what is far from the
/// world's keeps its digits.
template <int D, class Shape, class Find>
void find_hit(const Shape& a, RigidPath<D>& path_a, const Shape& b, RigidPath<D>& path_b, const Find& find,
              std::optional<Hit<D>>& result) {
    const bool finite = is_finite(a) && is_finite(b) && is_finite(path_a) && is_finite(path_b);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const DVec<D> start = path_a.start.offset, move = path_a.move;
    path_b.start.offset -= start;
    path_b.move -= move;
    path_a.start.offset = path_a.move = DVec<D>(0.0);
    Meeting<D> meeting;
    if (!find(path_a, path_b, meeting)) return;
    Hit<D>& hit = result.emplace();
    hit.fraction = rounded_down(meeting.time);
    hit.distance = hit.fraction * static_cast<float>(length(path_b.move));
    hit.point = to_float(meeting.point + start + move * meeting.time);
    hit.normal = to_float(-meeting.normal);
    hit.started_inside = meeting.started_inside;
    hit.feature = meeting.feature;
    feel(a, path_a, b, path_b, meeting, hit);
}

template <int D>
std::optional<Hit<D>> between(const Convex<D>& a, RigidPath<D> path_a, const Convex<D>& b, RigidPath<D> path_b,
                              const QueryOptions<D>& options) {
    const auto find = [&](const auto& way_a, const auto& way_b, Meeting<D>& meeting) {
        return first_meeting<D>(a, way_a, b, way_b, TurningLimits{}, {options.cache, options.trace}, meeting);
    };
    std::optional<Hit<D>> result;
    find_hit(a, path_a, b, path_b, find, result);
    return result;
}

template <int D>
std::optional<Hit<D>> between(const View<D>& a, RigidPath<D> path_a, const View<D>& b, RigidPath<D> path_b,
                              const QueryOptions<D>& options) {
    const auto find = [&](const auto& way_a, const auto& way_b, Meeting<D>& meeting) {
        return first_meeting<D>(a, way_a, b, way_b, search_options(a, b, options), meeting);
    };
    std::optional<Hit<D>> result;
    find_hit(a, path_a, b, path_b, find, result);
    return result;
}

}  // namespace

template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Motion<D>& motion_a, const Convex<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options) {
    return between(a, rigid_path(motion_a), b, rigid_path(motion_b), options);
}
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Motion<D>& motion_a, const ShapeRef<D>& b,
                            const Motion<D>& motion_b, const QueryOptions<D>& options) {
    return sweep(convex_of(a), motion_a, convex_of(b), motion_b, options);
}
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Motion<D>& motion_a, const View<D>& b, const Motion<D>& motion_b,
                            const QueryOptions<D>& options) {
    return between(a, rigid_path(motion_a), b, rigid_path(motion_b), options);
}

template <int D>
std::optional<Hit<D>> sweep(const Convex<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const Convex<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return between(a, rigid_path(from_a, to_a), b, rigid_path(from_b, to_b), options);
}
template <int D>
std::optional<Hit<D>> sweep(const ShapeRef<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const ShapeRef<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return sweep(convex_of(a), from_a, to_a, convex_of(b), from_b, to_b, options);
}
template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Pose<D>& from_a, const Pose<D>& to_a, const View<D>& b,
                            const Pose<D>& from_b, const Pose<D>& to_b, const QueryOptions<D>& options) {
    return between(a, rigid_path(from_a, to_a), b, rigid_path(from_b, to_b), options);
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
