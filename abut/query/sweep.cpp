#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/sweep/linear.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/sweep.hpp>

namespace abut {
namespace {

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
    if (options.trace != nullptr || closed_form_sweep(a, motion_a, b, motion_b, result) == ClosedFormAnswer::unknown)
        sweep_views(a, motion_a, b, motion_b, options, result);
    return result;
}
template <>
std::optional<Hit<3>> sweep(const ShapeRef<3>& a, const Vec3& motion_a, const ShapeRef<3>& b, const Vec3& motion_b,
                            const QueryOptions<3>& options) {
    return sweep(convex_of(a), motion_a, convex_of(b), motion_b, options);
}

template <int D>
std::optional<Hit<D>> sweep(const View<D>& a, const Vec<D>& motion_a, const View<D>& b, const Vec<D>& motion_b,
                            const QueryOptions<D>& options) {
    std::optional<Hit<D>> result;
    const auto find = [&](const Path<D>& path, LinearImpact<D>& first) {
        const SearchOptions<D> options_of_pair = search_options(a, b, options);
        return first_impact(a, path, b, {options_of_pair.cache, options_of_pair.trace}, first);
    };
    find_first_impact(a, motion_a, b, motion_b, find, result);
    if (result && std::holds_alternative<Composite<D>>(b)) {
        // The point relative to B's start.
        const DVec<D> moved_b = DVec<D>(motion_b) * static_cast<double>(result->fraction);
        const DVec<D> moved_a = DVec<D>(motion_a) * static_cast<double>(result->fraction);
        const Vec<D> point = result->point;
        result->point = to_float(DVec<D>(point) - moved_b);
        const auto closest_points = [&](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
            each_closest_point_on(b, from, within, visit);
        };
        filter_hit_normal<D>(linear_mover_at_hit<D>(a, moved_a - moved_b), b, closest_points, *result);
        result->point = point;
    }
    return result;
}

#define ABUT_INSTANTIATE(D)                                                                                \
    template std::optional<Hit<D>> sweep(const View<D>&, const Vec<D>&, const View<D>&, const Vec<D>&,     \
                                         const QueryOptions<D>&);                                          \
    template std::optional<Hit<D>> sweep(const Convex<D>&, const Vec<D>&, const Convex<D>&, const Vec<D>&, \
                                         const QueryOptions<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
