// The narrow phase: the path of each pair of convex parts, by the kinds of their cores. A path that can't prove its
// answer returns none, and GJK and EPA answer.

#include <abut/convex/manifold/round_manifold.hpp>
#include <abut/convex/pairs/pair2.hpp>
#include <abut/query/detail/pair_dispatch.hpp>

namespace abut::detail {
namespace {

/// Both shapes as polygons, for the fast paths.
struct PlacedPolygons {
    PlacedPolygon a, b;
    bool known;

    PlacedPolygons(const Convex<2>& first, const Convex<2>& second)
        : known(set_placed_polygon(first, a) && set_placed_polygon(second, b)) {}
};

bool searched_distance_within(const Convex<2>& a, const Convex<2>& b, double reach, const SearchOptions<2>& options,
                              PartContact<2>& contact) {
    contact.distance = signed_distance(a, b, options);
    contact.manifold.count = 0;
    return contact.distance.distance <= reach;
}

}  // namespace

// Fast paths of the plane have no steps to record. A trace receives the steps of GJK and EPA, and changes no answer.

template <>
bool part_overlaps(const Convex<2>& a, const Convex<2>& b, const SearchOptions<2>& options) {
    PlacedPolygons polygons(a, b);
    const PairAnswer answer =
        polygons.known ? pair2_within(polygons.a, polygons.b, 0, options.cache) : PairAnswer::unknown;
    if (answer == PairAnswer::unknown) return convex_overlap(a, b, options);
    if (options.trace != nullptr) convex_overlap(a, b, {.trace = options.trace});
    return answer == PairAnswer::yes;
}

template <>
SignedDistance<2> part_distance(const Convex<2>& a, const Convex<2>& b, const SearchOptions<2>& options) {
    PlacedPolygons polygons(a, b);
    ClosestFeatures2 closest;
    if (!polygons.known || pair2_closest(polygons.a, polygons.b, options.cache, closest) == PairAnswer::unknown)
        return signed_distance(a, b, options);
    if (options.trace != nullptr) signed_distance(a, b, {.trace = options.trace});
    SignedDistance<2> result;
    write(closest, polygons.a, polygons.b, result);
    return result;
}

template <>
bool part_distance_up_to(const Convex<2>& a, const Convex<2>& b, double reach, SignedDistance<2>& result) {
    result = part_distance(a, b, SearchOptions<2>{});
    return result.distance <= reach;
}

template <>
bool part_distance_within(const Convex<2>& a, const Convex<2>& b, double reach, double margin,
                          const SearchOptions<2>& options, PartContact<2>& contact) {
    PlacedPolygons polygons(a, b);
    ClosestFeatures2 closest;
    ContactLanes points;
    const PairAnswer answer = polygons.known
                                  ? pair2_contact(polygons.a, polygons.b, reach, margin, options.cache, closest, points)
                                  : PairAnswer::unknown;
    if (answer == PairAnswer::unknown) return searched_distance_within(a, b, reach, options, contact);
    if (answer == PairAnswer::yes) {
        write(closest, polygons.a, polygons.b, contact.distance);
        write(points, contact.manifold);
    }
    if (options.trace != nullptr) {
        PartContact<2> searched;
        if (searched_distance_within(a, b, reach, {.trace = options.trace}, searched))
            add_points<2>(a, b, margin, {.trace = options.trace}, searched);
    }
    return answer == PairAnswer::yes;
}

template <int D>
void add_points(const Convex<D>& a, const Convex<D>& b, double margin, const SearchOptions<D>& options,
                PartContact<D>& contact) {
    if (contact.manifold.count > 0) return;
    if constexpr (D == 3) {
        // A trace receives the clipping steps, which the closed form saves.
        if (options.trace != nullptr) manifold(a, b, contact.distance, margin, options.trace);
        if (round_manifold(a, b, contact.distance, margin, contact.manifold)) return;
    }
    contact.manifold = manifold(a, b, contact.distance, margin, D == 3 ? nullptr : options.trace);
}

template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact) {
    if (!part_distance_within(a, b, reach, margin, options, contact)) return false;
    add_points(a, b, margin, options, contact);
    return true;
}

template void add_points(const Convex<2>&, const Convex<2>&, double, const SearchOptions<2>&, PartContact<2>&);
template void add_points(const Convex<3>&, const Convex<3>&, double, const SearchOptions<3>&, PartContact<3>&);
template bool part_contact(const Convex<2>&, const Convex<2>&, double, double, const SearchOptions<2>&,
                           PartContact<2>&);
template bool part_contact(const Convex<3>&, const Convex<3>&, double, double, const SearchOptions<3>&,
                           PartContact<3>&);

}  // namespace abut::detail
