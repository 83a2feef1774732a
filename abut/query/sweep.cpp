#include <abut/math/assert.hpp>
#include <abut/query/direct_sweep.hpp>
#include <abut/query/felt_hit.hpp>
#include <abut/query/front_touch.hpp>
#include <abut/query/sweep.hpp>

namespace abut {
namespace {

/// Two motions as they are asked about.
template <int D>
struct Motions {
    Path<D> path;      ///< of A, as B sees it
    DVec<D> motion_b;  ///< of B in the world

    Motions(const Vec<D>& a, const Vec<D>& b) : motion_b(b) {
        const DVec<D> way = DVec<D>(a) - motion_b;
        path.length = length(way);
        path.direction = normalized(way);
    }
};

template <int D>
void tell(const Motions<D>& motions, const PartTouch<D>& first, Hit<D>& hit) {
    const double fraction = std::min(first.along / motions.path.length, 1.0);
    hit.fraction = static_cast<float>(fraction);
    hit.distance = static_cast<float>(first.along);
    hit.point = to_float(first.point + motions.motion_b * fraction);
    hit.normal = to_float(-first.normal);
    hit.started_inside = first.started_inside;
    hit.feature = first.feature;
}

/// The box around a part on its way along the path.
template <int D>
MovingBox<D> moving_box(const Aabb<D>& box, const DVec<D>& direction, double length) {
    const DVec<D> low(box.min), high(box.max);
    return {(low + high) * 0.5, (high - low) * 0.5, direction, length};
}

/// The first touch over all pairs of parts.
template <int D>
class FirstTouch {
public:
    FirstTouch(const Path<D>& path, const SweepOptions<D>& options) : path_(path), options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        if (const auto* convex = std::get_if<Convex<D>>(&a))
            meet(*convex, 0, b);
        else if (const auto* solid = std::get_if<HalfSpaceView<D>>(&a))
            meet(*solid, 0, b);
        else if (const auto* function = std::get_if<DistanceFunction<D>>(&a))
            meet(*function, 0, b);
        else
            each_part_met(std::get<Composite<D>>(a), b, -path_.direction,
                          [&](const Convex<D>& part, std::uint32_t index) { meet(part, index, b); });
    }

    bool found() const { return any_; }
    const PartTouch<D>& first() const { return first_; }

private:
    /// One part of A and all of B.
    template <class Part>
    void meet(const Part& part, std::uint32_t index, const View<D>& b) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        if (const auto* convex = std::get_if<Convex<D>>(&b))
            look_at(part, index, *convex, 0);
        else if (const auto* function = std::get_if<DistanceFunction<D>>(&b))
            look_at(part, index, *function, 0);
        else if (const auto* composite = std::get_if<Composite<D>>(&b))
            each_part_met(*composite, part, path_.direction, [&](const Convex<D>& other, std::uint32_t other_index) {
                look_at(part, index, other, other_index);
            });
        else if constexpr (std::is_same_v<Part, HalfSpaceView<D>>)
            ABUT_ASSERT(two_half_spaces_pair);
        else
            look_at(part, index, std::get<HalfSpaceView<D>>(b), 0);
    }

    /// Calls visit(part, index) for the parts of a composite shape that another one, moving along `direction`, may
    /// touch no later than what is known.
    template <class Other, class Visit>
    void each_part_met(const Composite<D>& composite, const Other& other, const DVec<D>& direction, Visit&& visit) {
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
    void look_at(const PartA& part_a, std::uint32_t index_a, const PartB& part_b, std::uint32_t index_b) {
        PartTouch<D> touch;
        if (!front_touch(part_a, path_, part_b, index_b, options_, touch)) return;
        // The lowest of several at one place, so that it isn't up to the order of the visits.
        if (any_ &&
            (touch.along > first_.along ||
             (touch.along == first_.along && std::pair(index_b, index_a) >= std::pair(first_.feature.part, index_a_))))
            return;
        any_ = true;
        first_ = touch;
        index_a_ = index_a;
    }

    Path<D> path_;
    SweepOptions<D> options_;
    bool any_ = false;
    PartTouch<D> first_;
    std::uint32_t index_a_ = 0;  ///< of the part of A
};

/// `find` is asked for the first touch along a path.
template <int D, class Shapes, class Find>
void find_first_touch(const Shapes& a, const Vec<D>& motion_a, const Shapes& b, const Vec<D>& motion_b,
                      const Find& find, std::optional<Hit<D>>& result) {
    const bool finite = is_finite(a) && is_finite(b) && is_finite(motion_a) && is_finite(motion_b);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const Motions<D> motions(motion_a, motion_b);
    if (!(motions.path.length > 0)) return;
    PartTouch<D> first;
    if (find(motions.path, first)) tell(motions, first, result.emplace());
}

/// Kept out of what is hot, where it would take up room.
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
    const auto find = [&](const Path<D>& path, PartTouch<D>& first) {
        return front_touch(a, path, b, 0, SweepOptions<D>{options.cache, options.trace}, first);
    };
    find_first_touch(a, motion_a, b, motion_b, find, result);
    return result;
}

template <>
std::optional<Hit<2>> sweep(const ShapeRef<2>& a, const Vec2& motion_a, const ShapeRef<2>& b, const Vec2& motion_b,
                            const QueryOptions<2>& options) {
    std::optional<Hit<2>> result;
    if (options.trace != nullptr || direct_sweep(a, motion_a, b, motion_b, result) == DirectAnswer::unknown)
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
    const auto find = [&](const Path<D>& path, PartTouch<D>& first) {
        const SearchOptions<D> search = search_options(a, b, options);
        FirstTouch<D> touches(path, {search.cache, search.trace});
        touches.search(a, b);
        first = touches.first();
        return touches.found();
    };
    find_first_touch(a, motion_a, b, motion_b, find, result);
    if (result && std::holds_alternative<Composite<D>>(b)) {
        // As it is where B began.
        const DVec<D> moved_b = DVec<D>(motion_b) * static_cast<double>(result->fraction);
        const DVec<D> moved_a = DVec<D>(motion_a) * static_cast<double>(result->fraction);
        const Vec<D> point = result->point;
        result->point = to_float(DVec<D>(point) - moved_b);
        const auto feet = [&](const DVec<D>& from, double within, ClosestPointVisitor<D> visit) {
            each_foot_on(b, from, within, visit);
        };
        feel_hit<D>(straight_arrival<D>(a, moved_a - moved_b), b, feet, *result);
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
