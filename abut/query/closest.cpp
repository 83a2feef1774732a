#include <abut/convex/gjk/gjk.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/detail/part_pairs.hpp>
#include <abut/query/detail/solid/solid_queries.hpp>
#include <abut/query/detail/valid_query.hpp>
#include <abut/query/detail/write_answer.hpp>

#include <optional>
#include <utility>

namespace abut {

using namespace detail;

namespace {

/// Calls visit(part, index) for a shape that is one part, or for the parts of a composite shape within reach of
/// `other`; visit returns the new reach.
template <int D, class Other, class Visit>
void each_part_within_reach(const View<D>& shape, const Other& other, Visit&& visit) {
    detail::with_part(
        shape, [&](const Part<D>& part) { visit(part, 0u); },
        [&](const Composite<D>& composite) {
            each_part_near<D>(composite, bounds(other),
                              [&](const Convex<D>& part, std::uint32_t index) -> float { return visit(part, index); });
        });
}

/// A cheap test that rejects parts too far from a shape, to which it refers.
template <int D>
class PartCuller {
public:
    explicit PartCuller(const Convex<D>& shape) : shape_(shape) {
        for (int i = 0; i < D; ++i)
            center_[i] = 0.5 * (core_support(shape, axis<D>(i, 1)).position[i] +
                                core_support(shape, axis<D>(i, -1)).position[i]);
    }

    /// Whether the part is certainly farther than `distance`. A part of up to three points is tested along the
    /// direction from the shape's centre to its closest point; any other part takes a GJK that stops early.
    bool is_beyond(const Convex<D>& part, double distance) const {
        const double sufficient = distance + part.radius + shape_.radius;
        if (part.core != Core::points || part.count > 3 || part.inner_radius > 0)
            return gjk(CoreDifference<D>(shape_, part), sufficient).lower_bound > sufficient;
        Affine<D> local_place = part.place;
        local_place.offset -= center_;
        std::array<DVec<D>, 3> corners;
        Simplex<D> simplex;
        for (; simplex.count < part.count; ++simplex.count) {
            const DVec<D> corner = local_place.point(DVec<D>(part.vertices()[simplex.count]));
            corners[simplex.count] = corner;
            simplex.points[simplex.count] = {corner, corner, DVec<D>(0.0), 0, 0};
        }
        const DVec<D> nearest = reduce_to_closest(simplex);
        const double gap = length(nearest);
        if (!(gap > sufficient)) return false;
        const DVec<D> direction = nearest / gap;
        double from = std::numeric_limits<double>::infinity(), scale = 0;
        for (std::size_t i = 0; i < part.count; ++i) {
            from = std::min(from, dot(direction, corners[i]));
            scale = std::max(scale, largest(corners[i]));
        }
        if (!(from > sufficient)) return false;
        const double to = dot(direction, core_support(shape_, direction).position - center_);
        return from - to > sufficient + 1e-12 * scale + 1e-15 * largest(center_);
    }

private:
    const Convex<D>& shape_;
    DVec<D> center_{0.0};
};

/// The minimum distance over all pairs of parts.
template <int D>
class Nearest {
public:
    explicit Nearest(const SearchOptions<D>& options) : options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        detail::with_part(
            b, [&](const Part<D>& part) { search_around(a, part, 0, false); },
            [&](const Composite<D>&) {
                each_part_within_reach(a, b, [&](const Part<D>& part, std::uint32_t index) {
                    search_around(b, part, index, true);
                    return reach();
                });
            });
    }

    Closest<D> found() const {
        Closest<D> result = found_;
        if (any_) write(nearest_, result);
        return result;
    }

private:
    /// Whether the distance of most parts takes no longer than the cheap test: from balls and capsules.
    static bool has_fast_distance(const Convex<D>& set) {
        return set.core == Core::points && set.count <= 2 && set.inner_radius == 0;
    }
    /// Farther parts can't be nearer. All overlapping parts must be tested, as the deepest may come last.
    float reach() const {
        return any_ ? static_cast<float>(std::max(nearest_.distance, 0.0)) : std::numeric_limits<float>::infinity();
    }

    /// Tests all parts of a shape near one part of the other shape, which is A or B.
    void search_around(const View<D>& shape, const Part<D>& part, std::uint32_t index, bool part_is_of_a) {
        std::optional<PartCuller<D>> culler;
        if (part.is_convex() && std::holds_alternative<Composite<D>>(shape) && !has_fast_distance(part.convex()))
            culler.emplace(part.convex());
        each_part_within_reach(shape, part, [&](const Part<D>& other, std::uint32_t other_index) {
            if (any_ && culler && nearest_.distance > 0 && culler->is_beyond(other.convex(), nearest_.distance))
                return reach();
            if (part_is_of_a)
                test_pair(part, index, other, other_index);
            else
                test_pair(other, other_index, part, index);
            return reach();
        });
    }

    void test_pair(const Part<D>& part_a, std::uint32_t index_a, const Part<D>& part_b, std::uint32_t index_b) {
        const SignedDistance<D> distance = part_distance<D>(part_a, part_b, options_);
        // The distance to a function that is empty or without bounds is infinite.
        if (!(distance.distance < std::numeric_limits<double>::infinity())) return;
        // Among equally near pairs the lowest wins, whatever the order of the visits.
        if (any_ && !(distance.distance < nearest_.distance) &&
            !(distance.distance == nearest_.distance &&
              std::pair(index_a, index_b) < std::pair(found_.feature_a.part, found_.feature_b.part)))
            return;
        any_ = true;
        nearest_ = distance;
        // Written during the visit: a composite shape may create its parts as it goes.
        name_features(part_a, part_b, distance, index_a, index_b, found_);
    }

    SearchOptions<D> options_;
    bool any_ = false;
    SignedDistance<D> nearest_{};
    Closest<D> found_;  ///< only its features are used
};

}  // namespace

template <int D>
Closest<D> closest(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Closest<D> result;
    if (!detail::is_valid_pair(a, b)) return result;
    const SignedDistance<D> distance = part_distance(a, b, {options.cache, options.trace});
    write(distance, result);
    name_features(a, b, distance, 0, 0, result);
    return result;
}

template <int D>
Closest<D> closest(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    if (!detail::is_valid_pair(a, b)) return {};
    if constexpr (D == 3)
        if (has_solid(a, b)) return closest_to_solid(a, b, options, true);
    Nearest<D> nearest(search_options(a, b, options));
    nearest.search(a, b);
    return nearest.found();
}

}  // namespace abut

namespace abut::detail {

Closest<3> closest_to_solid(const View<3>& a, const View<3>& b, const QueryOptions<3>& options, bool names_points) {
    Closest<3> result;
    if (find_depth(a, b, names_points, result)) return result;
    Nearest<3> nearest(search_options(a, b, options));
    nearest.search(a, b);
    result = nearest.found();
    name_touching(a, b, names_points, result);
    return result;
}

}  // namespace abut::detail

namespace abut {

template Closest<2> closest(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Closest<3> closest(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Closest<2> closest(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Closest<3> closest(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);

}  // namespace abut
