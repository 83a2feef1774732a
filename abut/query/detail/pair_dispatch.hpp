#pragma once

// The dispatch of pairs of convex parts. It alone chooses the path for a pair: a closed form, or GJK and
// EPA, which take any pair. All paths give the same answers. For .cpp files.

#include <abut/convex/gjk/signed_distance.hpp>
#include <abut/convex/manifold/manifold.hpp>

namespace abut::detail {

/// Whether the parts share a point.
template <int D>
bool part_overlaps(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options);

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options);

/// Whether the parts are at most `reach` apart, and then their distance, of the same bits as part_distance. Otherwise
/// `result`, which must be newly constructed, is unspecified.
template <int D>
bool part_distance_up_to(const Convex<D>& a, const Convex<D>& b, double reach, SignedDistance<D>& result);

/// The contact of two parts.
template <int D>
struct PartContact {
    SignedDistance<D> distance;
    Manifold<D> manifold;
};

template <int D>
void flip(PartContact<D>& contact) {
    flip(contact.distance);
}

/// Whether the parts are at most `reach` apart, and then their distance. add_points() adds the manifold, unless it is
/// found at once. Otherwise `contact` is unspecified.
template <int D>
bool part_distance_within(const Convex<D>& a, const Convex<D>& b, double reach, double margin,
                          const SearchOptions<D>& options, PartContact<D>& contact);

/// Adds the contact points of two touching parts that are at most `margin` apart.
template <int D>
void add_points(const Convex<D>& a, const Convex<D>& b, double margin, const SearchOptions<D>& options,
                PartContact<D>& contact);

/// part_distance_within() and add_points() in one.
template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact);

// Each dimension has its own.
template <>
bool part_overlaps(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&);
template <>
SignedDistance<2> part_distance(const Convex<2>&, const Convex<2>&, const SearchOptions<2>&);
template <>
bool part_distance_up_to(const Convex<2>&, const Convex<2>&, double, SignedDistance<2>&);
template <>
bool part_distance_within(const Convex<2>&, const Convex<2>&, double, double, const SearchOptions<2>&, PartContact<2>&);
template <>
bool part_overlaps(const Convex<3>&, const Convex<3>&, const SearchOptions<3>&);
template <>
SignedDistance<3> part_distance(const Convex<3>&, const Convex<3>&, const SearchOptions<3>&);
template <>
bool part_distance_up_to(const Convex<3>&, const Convex<3>&, double, SignedDistance<3>&);
template <>
bool part_distance_within(const Convex<3>&, const Convex<3>&, double, double, const SearchOptions<3>&, PartContact<3>&);

}  // namespace abut::detail
