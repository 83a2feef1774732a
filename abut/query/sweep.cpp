#include <abut/math/assert.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/surface/hit_normal.hpp>
#include <abut/query/detail/sweep/front_time_of_impact.hpp>
#include <abut/query/sweep.hpp>

namespace abut {

using namespace detail;

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

/// The swept box of a part along the path.
template <int D>
MovingBox<D> moving_box(const Aabb<D>& box, const DVec<D>& direction, double length) {
    const DVec<D> low(box.min), high(box.max);
    return {(low + high) * 0.5, (high - low) * 0.5, direction, length};
}

/// The first impact over all pairs of parts.
template <int D>
class FirstImpact {
public:
    FirstImpact(const Path<D>& path, const SweepOptions<D>& options) : path_(path), options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        if (const auto* convex = std::get_if<Convex<D>>(&a))
            search_part(*convex, 0, b);
        else if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&a))
            search_part(*half_space, 0, b);
        else if (const auto* function = std::get_if<DistanceFunction<D>>(&a))
            search_part(*function, 0, b);
        else
            each_part_on_path(std::get<Composite<D>>(a), b, -path_.direction,
                              [&](const Convex<D>& part, std::uint32_t index) { search_part(part, index, b); });
    }

    bool found() const { return any_; }
    const LinearImpact<D>& first() const { return first_; }

private:
    /// Tests one part of A against all of B.
    template <class Part>
    void search_part(const Part& part, std::uint32_t index, const View<D>& b) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        if (const auto* convex = std::get_if<Convex<D>>(&b))
            test_pair(part, index, *convex, 0);
        else if (const auto* function = std::get_if<DistanceFunction<D>>(&b))
            test_pair(part, index, *function, 0);
        else if (const auto* composite = std::get_if<Composite<D>>(&b))
            each_part_on_path(
                *composite, part, path_.direction,
                [&](const Convex<D>& other, std::uint32_t other_index) { test_pair(part, index, other, other_index); });
        else if constexpr (std::is_same_v<Part, HalfSpaceView<D>>)
            ABUT_ASSERT(two_half_spaces_pair);
        else
            test_pair(part, index, std::get<HalfSpaceView<D>>(b), 0);
    }

    /// Calls visit(part, index) for the parts of a composite shape that another shape, moving along `direction`, may
    /// touch no later than the first known impact.
    template <class Other, class Visit>
    void each_part_on_path(const Composite<D>& composite, const Other& other, const DVec<D>& direction, Visit&& visit) {
        const Aabb<D> box = bounds(other);
        const auto visit_and_reach = [&](const Convex<D>& part, std::uint32_t index) -> float {
            visit(part, index);
            return std::nextafter(static_cast<float>(reach()), std::numeric_limits<float>::infinity());
        };
        const MovingBox<D> moving = moving_box(box, direction, reach());
        if (std::isfinite(length_squared(moving.half)))
            each_part_along<D>(composite, moving, visit_and_reach);
        else
            each_part<D>(composite, bounds(composite), [&](const Convex<D>& part, std::uint32_t index) -> bool {
                return visit_and_reach(part, index) >= 0;
            });
    }

    double reach() const { return any_ ? first_.along : path_.length; }

    template <class PartA, class PartB>
    void test_pair(const PartA& part_a, std::uint32_t index_a, const PartB& part_b, std::uint32_t index_b) {
        LinearImpact<D> impact;
        if (!front_time_of_impact(part_a, path_, part_b, index_b, options_, impact)) return;
        // Of several parts hit at one distance the lowest wins, whatever the order of the visits.
        if (any_ &&
            (impact.along > first_.along ||
             (impact.along == first_.along && std::pair(index_b, index_a) >= std::pair(first_.feature.part, index_a_))))
            return;
        any_ = true;
        first_ = impact;
        index_a_ = index_a;
    }

    Path<D> path_;
    SweepOptions<D> options_;
    bool any_ = false;
    LinearImpact<D> first_;
    std::uint32_t index_a_ = 0;  ///< of the part of A
};

/// Calls find(path, first) for the first impact along a path.
template <int D, class Shapes, class Find>
void find_first_impact(const Shapes& a, const Vec<D>& motion_a, const Shapes& b, const Vec<D>& motion_b,
                       const Find& find, std::optional<Hit<D>>& result) {
    const bool finite = is_finite(a) && is_finite(b) && is_finite(motion_a) && is_finite(motion_b);
    ABUT_ASSERT(finite);
    if (!finite) return;
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
        return front_time_of_impact(a, path, b, 0, SweepOptions<D>{options.cache, options.trace}, first);
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
        FirstImpact<D> search(path, {options_of_pair.cache, options_of_pair.trace});
        search.search(a, b);
        first = search.first();
        return search.found();
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
