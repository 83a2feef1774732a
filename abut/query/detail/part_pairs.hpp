#pragma once

// Pairs of parts of any kind. A pair of convex parts goes to pair_dispatch.hpp at once; other pairs are dispatched here
// by the two kinds, so that callers are compiled once for all pairs. For .cpp files.

#include <abut/query/detail/pair_dispatch.hpp>
#include <abut/query/feature.hpp>
#include <abut/query/options.hpp>
#include <abut/shape/view/part.hpp>

#include <type_traits>

namespace abut::detail {

using detail::Part;

/// For arguments of any part's type; other arguments give the dimension.
template <int D>
using AnyPart = std::type_identity_t<Part<D>>;

// The pairs that aren't both convex, nor both half-spaces.

template <int D>
bool mixed_overlaps(const Part<D>& a, const Part<D>& b);
template <int D>
SignedDistance<D> mixed_distance(const Part<D>& a, const Part<D>& b);
template <int D>
bool mixed_contact(const Part<D>& a, const Part<D>& b, double reach, double margin, PartContact<D>& contact);

template <int D>
bool are_convex(const Part<D>& a, const Part<D>& b) {
    return a.is_convex() && b.is_convex();
}

/// Whether the parts share a point.
template <int D>
bool part_overlaps(const AnyPart<D>& a, const AnyPart<D>& b, const SearchOptions<D>& options) {
    return are_convex<D>(a, b) ? part_overlaps(a.convex(), b.convex(), options) : mixed_overlaps<D>(a, b);
}

/// The distance of a distance function that is empty or without bounds is infinite.
template <int D>
SignedDistance<D> part_distance(const AnyPart<D>& a, const AnyPart<D>& b, const SearchOptions<D>& options = {}) {
    return are_convex<D>(a, b) ? part_distance(a.convex(), b.convex(), options) : mixed_distance<D>(a, b);
}

template <int D>
bool part_distance_up_to(const AnyPart<D>& a, const AnyPart<D>& b, double reach, SignedDistance<D>& result) {
    if (are_convex<D>(a, b)) return part_distance_up_to(a.convex(), b.convex(), reach, result);
    result = mixed_distance<D>(a, b);
    return result.distance <= reach;
}

/// Like that of two convex parts. For other parts the distance comes with the contact points in one step.
template <int D>
bool part_distance_within(const AnyPart<D>& a, const AnyPart<D>& b, double reach, double margin,
                          const SearchOptions<D>& options, PartContact<D>& contact) {
    return are_convex<D>(a, b) ? part_distance_within(a.convex(), b.convex(), reach, margin, options, contact)
                               : mixed_contact<D>(a, b, reach, margin, contact);
}
template <int D>
void add_points(const AnyPart<D>& a, const AnyPart<D>& b, double margin, const SearchOptions<D>& options,
                PartContact<D>& contact) {
    if (are_convex<D>(a, b)) add_points(a.convex(), b.convex(), margin, options, contact);
}
template <int D>
bool part_contact(const AnyPart<D>& a, const AnyPart<D>& b, double reach, double margin,
                  const SearchOptions<D>& options, PartContact<D>& contact) {
    return are_convex<D>(a, b) ? part_contact(a.convex(), b.convex(), reach, margin, options, contact)
                               : mixed_contact<D>(a, b, reach, margin, contact);
}

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
template <int D>
void name_feature(const AnyPart<D>& part, const CornerIndices<D>& corners, std::size_t count, const DVec<D>& out,
                  std::uint32_t number, Feature& feature);
/// Names the vertex (the same corner twice) or the edge of a part without faces. The corners are numbers and not an
/// array: loading two of them at once right after they were written one by one stalls.
inline void name_end_or_edge(std::uint32_t first, std::uint32_t second, std::uint32_t number, Feature& feature) {
    // Branchless: which case holds is unpredictable, and compilers turn a conditional into a branch.
    const std::uint32_t swap = (first ^ second) & (0u - (first > second ? 1u : 0u));
    const std::uint32_t low = first ^ swap, high = second ^ swap, differ = low < high ? 1 : 0;
    feature.part = number;
    feature.index = low ^ ((low ^ ((low & 0xffffu) | high << 16)) & (0u - differ));
    feature.kind = static_cast<FeatureKind>(static_cast<std::uint32_t>(FeatureKind::vertex) + differ);
    static_assert(static_cast<int>(FeatureKind::edge) == static_cast<int>(FeatureKind::vertex) + 1);
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
