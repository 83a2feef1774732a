#include <abut/query/closest.hpp>
#include <abut/query/direct.hpp>
#include <abut/query/part_pairs.hpp>
#include <abut/query/vicinity.hpp>
#include <abut/query/write_answer.hpp>

#include <optional>
#include <utility>

namespace abut {
namespace {

/// Calls visit(part, index) for a convex shape, half-space or distance function itself, and for the parts of a
/// composite one that are within reach of `other`, as long as visit() returns it.
template <int D, class Other, class Visit>
void each_part_within_reach(const View<D>& shape, const Other& other, Visit&& visit) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape))
        visit(*convex, 0u);
    else if (const auto* solid = std::get_if<HalfSpaceView<D>>(&shape))
        visit(*solid, 0u);
    else if (const auto* function = std::get_if<DistanceFunction<D>>(&shape))
        visit(*function, 0u);
    else
        each_part_near<D>(std::get<Composite<D>>(shape), bounds(other),
                          [&](const Convex<D>& part, std::uint32_t index) -> float { return visit(part, index); });
}

/// The least distance over all pairs of parts.
template <int D>
class Nearest {
public:
    explicit Nearest(const SearchOptions<D>& options) : options_(options) {}

    void search(const View<D>& a, const View<D>& b) {
        if (const auto* convex = std::get_if<Convex<D>>(&b))
            look_around<false>(a, *convex, 0);
        else if (const auto* solid = std::get_if<HalfSpaceView<D>>(&b))
            look_around<false>(a, *solid, 0);
        else if (const auto* function = std::get_if<DistanceFunction<D>>(&b))
            look_around<false>(a, *function, 0);
        else
            each_part_within_reach(a, b, [&](const auto& part, std::uint32_t index) {
                look_around<true>(b, part, index);
                return reach();
            });
    }

    Closest<D> found() const {
        Closest<D> result = found_;
        if (any_) write(least_, result);
        return result;
    }

private:
    /// What is farther off can't be nearer. Of what overlaps all must be looked at.
    float reach() const {
        return any_ ? static_cast<float>(std::max(least_.distance, 0.0)) : std::numeric_limits<float>::infinity();
    }

    /// At all parts of a shape near a part of the other one, which is of A or of B.
    template <bool of_a, class Part>
    void look_around(const View<D>& shape, const Part& part, std::uint32_t index) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        constexpr bool is_convex = std::is_same_v<Part, Convex<D>>;
        std::optional<Vicinity<D>> vicinity;
        if constexpr (is_convex)
            if (std::holds_alternative<Composite<D>>(shape)) vicinity.emplace(part);
        each_part_within_reach(shape, part, [&]<class Other>(const Other& other, std::uint32_t other_index) {
            if constexpr (is_convex && std::is_same_v<Other, Convex<D>>)
                if (any_ && vicinity && least_.distance > 0 && vicinity->is_beyond(other, least_.distance))
                    return reach();
            if constexpr (std::is_same_v<Part, HalfSpaceView<D>> && std::is_same_v<Part, Other>)
                ABUT_ASSERT(two_half_spaces_pair);
            else if constexpr (of_a)
                look_at(part, index, other, other_index);
            else
                look_at(other, other_index, part, index);
            return reach();
        });
    }

    template <class PartA, class PartB>
    void look_at(const PartA& part_a, std::uint32_t index_a, const PartB& part_b, std::uint32_t index_b) {
        const SignedDistance<D> distance = part_distance(part_a, part_b, options_);
        // A function without bounds, or of no place, is nowhere near.
        if (!(distance.distance < std::numeric_limits<double>::infinity())) return;
        // The lowest of several as near, so that it isn't up to the order of the visits.
        if (any_ && !(distance.distance < least_.distance) &&
            !(distance.distance == least_.distance &&
              std::pair(index_a, index_b) < std::pair(found_.feature_a.part, found_.feature_b.part)))
            return;
        any_ = true;
        least_ = distance;
        // Now, while the parts are there: a composite shape may make them up as it goes.
        name_features(part_a, part_b, distance, index_a, index_b, found_);
    }

    SearchOptions<D> options_;
    bool any_ = false;
    SignedDistance<D> least_{};
    Closest<D> found_;  ///< its features
};

template <int D>
void answer(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options, Closest<D>& result) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return;
    const SignedDistance<D> distance = part_distance(a, b, {options.cache, options.trace});
    write(distance, result);
    name_features(a, b, distance, 0, 0, result);
}

/// Kept out of what is hot, where it would take up room.
template <int D>
[[gnu::noinline]] void by_views(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options,
                                Closest<D>& result) {
    answer(convex_of(a), convex_of(b), options, result);
}

}  // namespace

template <int D>
Closest<D> closest(const Convex<D>& a, const Convex<D>& b, const QueryOptions<D>& options) {
    Closest<D> result;
    answer(a, b, options, result);
    return result;
}

template <int D>
Closest<D> closest(const ShapeRef<D>& a, const ShapeRef<D>& b, const QueryOptions<D>& options) {
    Closest<D> result;
    if (options.trace != nullptr || !direct_closest(a, b, options.cache, result)) by_views(a, b, options, result);
    return result;
}

template <int D>
Closest<D> closest(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const bool finite = is_finite(a) && is_finite(b);
    ABUT_ASSERT(finite);
    if (!finite) return {};
    Nearest<D> nearest(search_options(a, b, options));
    nearest.search(a, b);
    return nearest.found();
}

template Closest<2> closest(const View<2>&, const View<2>&, const QueryOptions<2>&);
template Closest<3> closest(const View<3>&, const View<3>&, const QueryOptions<3>&);
template Closest<2> closest(const Convex<2>&, const Convex<2>&, const QueryOptions<2>&);
template Closest<3> closest(const Convex<3>&, const Convex<3>&, const QueryOptions<3>&);
template Closest<3> closest(const ShapeRef<3>&, const ShapeRef<3>&, const QueryOptions<3>&);

}  // namespace abut
