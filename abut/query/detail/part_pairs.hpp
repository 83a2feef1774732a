#pragma once

// The pairs of convex parts of two shapes of any kind. For .cpp files.

#include <abut/math/assert.hpp>
#include <abut/query/detail/pair_dispatch.hpp>
#include <abut/query/detail/sdf/function_pairs.hpp>
#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// Calls visit(part, index) for a convex shape, half-space or distance function itself, or for the parts of a composite
/// shape that are at most `reach` from `other`. The visitor returns false to stop.
template <int D, class Other, class Visit>
void each_part_near(const View<D>& shape, const Other& other, float reach, Visit&& visit) {
    if (const auto* convex = std::get_if<Convex<D>>(&shape))
        visit(*convex, 0u);
    else if (const auto* half_space = std::get_if<HalfSpaceView<D>>(&shape))
        visit(*half_space, 0u);
    else if (const auto* function = std::get_if<DistanceFunction<D>>(&shape))
        visit(*function, 0u);
    else
        each_part<D>(std::get<Composite<D>>(shape), grown(bounds(other), reach),
                     [&](const Convex<D>& part, std::uint32_t index) -> bool { return visit(part, index); });
}

/// Calls visit(part_a, index_a, part_b, index_b) for at least all pairs of parts that are at most `reach` apart; each
/// part is a Convex, a HalfSpaceView or a DistanceFunction, never both a HalfSpaceView. The visitor returns false to
/// stop.
template <int D, class Visit>
void each_part_pair(const View<D>& a, const View<D>& b, float reach, Visit&& visit) {
    each_part_near(a, b, reach, [&]<class PartA>(const PartA& part_a, std::uint32_t index_a) {
        [[maybe_unused]] constexpr bool two_half_spaces_pair = false;
        bool go_on = true;
        each_part_near(b, part_a, reach, [&]<class PartB>(const PartB& part_b, std::uint32_t index_b) {
            if constexpr (std::is_same_v<PartA, HalfSpaceView<D>> && std::is_same_v<PartB, HalfSpaceView<D>>)
                ABUT_ASSERT(two_half_spaces_pair);
            else
                go_on = visit(part_a, index_a, part_b, index_b);
            return go_on;
        });
        return go_on;
    });
}

/// The signed distance of a convex set and a half-space, in either order, in closed form.
template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const HalfSpaceView<D>& b, const SearchOptions<D>& options = {});
template <int D>
SignedDistance<D> part_distance(const HalfSpaceView<D>& a, const Convex<D>& b, const SearchOptions<D>& options = {});

/// The contact of a convex set and a half-space, like that of two convex parts.
template <int D>
bool part_contact(const Convex<D>& a, const HalfSpaceView<D>& b, double reach, double margin,
                  const SearchOptions<D>& options, PartContact<D>& contact);
template <int D>
bool part_contact(const HalfSpaceView<D>& a, const Convex<D>& b, double reach, double margin,
                  const SearchOptions<D>& options, PartContact<D>& contact);

/// For a half-space the distance comes with the contact points in one step.
template <int D>
bool part_distance_within(const Convex<D>& a, const HalfSpaceView<D>& b, double reach, double margin,
                          const SearchOptions<D>& options, PartContact<D>& contact) {
    return part_contact(a, b, reach, margin, options, contact);
}
template <int D>
bool part_distance_within(const HalfSpaceView<D>& a, const Convex<D>& b, double reach, double margin,
                          const SearchOptions<D>& options, PartContact<D>& contact) {
    return part_contact(a, b, reach, margin, options, contact);
}
template <int D>
void add_points(const Convex<D>&, const HalfSpaceView<D>&, double, const SearchOptions<D>&, PartContact<D>&) {}
template <int D>
void add_points(const HalfSpaceView<D>&, const Convex<D>&, double, const SearchOptions<D>&, PartContact<D>&) {}

/// The options of the engines for each pair of parts. A cache belongs to one pair of parts, so composite shapes have
/// none.
template <int D>
SearchOptions<D> search_options(const View<D>& a, const View<D>& b, const QueryOptions<D>& options) {
    const bool composite = std::holds_alternative<Composite<D>>(a) || std::holds_alternative<Composite<D>>(b);
    return {composite ? nullptr : options.cache, options.trace};
}

/// Names the feature of a part on which its witness point lies, by the corners of the feature; `out` is the normal out
/// of the part. The result is written in place: a copy would read it before all its members have reached memory.
template <int D>
void name_feature(const Convex<D>& part, const CornerIndices<D>& corners, std::size_t count, const DVec<D>& out,
                  std::uint32_t number, Feature& feature);
/// Names the vertex (the same corner twice) or the edge of a part without faces.
template <int D>
void name_end_or_edge(const CornerIndices<D>& corners, std::uint32_t number, Feature& feature) {
    // Branchless: which case holds is unpredictable, and compilers turn a conditional into a branch.
    const std::uint32_t differ = corners[0] != corners[1] ? 1 : 0;
    const std::uint32_t edge = edge_index(corners[0], corners[1]);
    feature.part = number;
    feature.index = corners[0] ^ ((corners[0] ^ edge) & (0u - differ));
    feature.kind = static_cast<FeatureKind>(static_cast<std::uint32_t>(FeatureKind::vertex) + differ);
    static_assert(static_cast<int>(FeatureKind::edge) == static_cast<int>(FeatureKind::vertex) + 1);
}
template <int D>
void name_feature(const HalfSpaceView<D>& part, const CornerIndices<D>& corners, std::size_t count, const DVec<D>& out,
                  std::uint32_t number, Feature& feature);

template <int D>
void name_feature(const DistanceFunction<D>&, const CornerIndices<D>&, std::size_t, const DVec<D>&,
                  std::uint32_t number, Feature& feature) {
    feature = {number, 0, FeatureKind::none};
}

/// Names the features of both parts.
template <int D, class PartA, class PartB, class Answer>
void name_features(const PartA& part_a, const PartB& part_b, const SignedDistance<D>& distance, std::uint32_t number_a,
                   std::uint32_t number_b, Answer& answer) {
    const ClosestCorners<D>& corners = distance.corners;
    name_feature(part_a, corners.a, corners.count, distance.normal, number_a, answer.feature_a);
    name_feature(part_b, corners.b, corners.count, -distance.normal, number_b, answer.feature_b);
}

}  // namespace abut::detail
