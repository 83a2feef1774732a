#include <abut/convex/box_pair.hpp>
#include <abut/convex/plane_pair.hpp>
#include <abut/convex/round_manifold.hpp>
#include <abut/query/closed_form.hpp>
#include <abut/query/convex_pair.hpp>

namespace abut {
namespace {

// The ways for any dimension.

template <int D>
bool any_overlap(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    SignedDistance<D> form;
    if (closed_form(a, b, form)) return form.distance <= 0;
    return convex_overlap(a, b, options);
}

template <int D>
void any_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options, SignedDistance<D>& result) {
    if (!closed_form(a, b, result)) result = signed_distance(a, b, options);
}

template <int D>
bool any_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                 PartContact<D>& contact) {
    any_distance(a, b, options, contact.distance);
    if (contact.distance.distance > reach) return false;
    if constexpr (D == 3) {
        // The clipping that it saves is told where somebody watches.
        if (options.trace != nullptr) manifold(a, b, contact.distance, margin, options.trace);
        if (round_manifold(a, b, contact.distance, margin, contact.manifold)) return true;
    }
    contact.manifold = manifold(a, b, contact.distance, margin, D == 3 ? nullptr : options.trace);
    return true;
}

}  // namespace

// The quick ways of the plane have no steps to tell of. A trace is told those of the search, and changes no answer.

namespace {

/// What both must have for a quick way.
struct Outlines {
    Outline a, b;
    bool known;

    Outlines(const Convex<2>& first, const Convex<2>& second)
        : known(set_outline(first, a) && set_outline(second, b)) {}
};

}  // namespace

template <>
bool part_overlaps(const Convex<2>& a, const Convex<2>& b, const SearchOptions<2>& options) {
    const Outlines outlines(a, b);
    const PlaneAnswer answer =
        outlines.known ? plane_near(outlines.a, outlines.b, 0, options.cache) : PlaneAnswer::unknown;
    if (answer == PlaneAnswer::unknown) return any_overlap(a, b, options);
    if (options.trace != nullptr) any_overlap<2>(a, b, {nullptr, options.trace});
    return answer == PlaneAnswer::within;
}
template <>
bool part_overlaps(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    return are_plain_boxes(a, b) ? boxes_overlap(a, b, options) : any_overlap(a, b, options);
}

template <>
SignedDistance<2> part_distance(const Convex<2>& a, const Convex<2>& b, const SearchOptions<2>& options) {
    SignedDistance<2> result;
    const Outlines outlines(a, b);
    if (!outlines.known || plane_distance(outlines.a, outlines.b, options.cache, result) == PlaneAnswer::unknown) {
        any_distance(a, b, options, result);
    } else if (options.trace != nullptr) {
        SignedDistance<2> searched;
        any_distance<2>(a, b, {nullptr, options.trace}, searched);
    }
    return result;
}
template <>
SignedDistance<3> part_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (are_plain_boxes(a, b)) return distance_of_boxes(a, b, options);
    SignedDistance<3> result;
    any_distance(a, b, options, result);
    return result;
}

template <>
bool part_contact(const Convex<2>& a, const Convex<2>& b, double reach, double margin, const SearchOptions<2>& options,
                  PartContact<2>& contact) {
    const Outlines outlines(a, b);
    const PlaneAnswer answer = outlines.known ? plane_contact(outlines.a, outlines.b, reach, margin, options.cache,
                                                              contact.distance, contact.manifold)
                                              : PlaneAnswer::unknown;
    if (answer == PlaneAnswer::unknown) return any_contact(a, b, reach, margin, options, contact);
    if (options.trace != nullptr) {
        PartContact<2> searched;
        any_contact<2>(a, b, reach, margin, {nullptr, options.trace}, searched);
    }
    return answer == PlaneAnswer::within;
}
template <>
bool part_contact(const Convex<3>& a, const Convex<3>& b, double reach, double margin, const SearchOptions<3>& options,
                  PartContact<3>& contact) {
    if (are_plain_boxes(a, b))
        return contact_of_boxes(a, b, reach, margin, options, contact.distance, contact.manifold);
    return any_contact(a, b, reach, margin, options, contact);
}

}  // namespace abut
