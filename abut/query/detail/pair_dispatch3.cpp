// The narrow phase in space: balls, segments and boxes, then a box and a triangle, then a ball or a segment and any
// other, all in closed form; GJK and EPA answer the rest, and what a closed form leaves open.

#include <abut/convex/pairs/box_triangle.hpp>
#include <abut/query/detail/closed_form/closed_form.hpp>
#include <abut/query/detail/closed_form/core_pairs3.hpp>
#include <abut/query/detail/pair_dispatch.hpp>

namespace abut::detail {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

bool are_plain_boxes(const Convex<3>& a, const Convex<3>& b) {
    return is_plain_box(a) && is_plain_box(b);
}

/// Records the axes of two boxes. Their closed form has no other steps, so those of the general algorithms follow.
void trace_boxes(const Convex<3>& a, const Convex<3>& b, Trace<3>* trace) {
    if (trace == nullptr || !are_plain_boxes(a, b)) return;
    with_cores(a, b, [&](const auto& x, const auto& y) {
        if constexpr (std::is_same_v<decltype(x), decltype(y)> && std::is_same_v<decltype(x), const PlacedBox&>)
            record_axes(x, y, *trace);
        return true;
    });
}

// A box and a triangle, in either order. With a trace, GJK runs, so that its steps can be shown.

PairAnswer triangle_overlap(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (options.trace != nullptr) return PairAnswer::unknown;
    if (are_box_and_triangle(a, b)) return box_triangle_overlap(a, b);
    return are_box_and_triangle(b, a) ? box_triangle_overlap(b, a) : PairAnswer::unknown;
}

PairAnswer triangle_distance(const Convex<3>& a, const Convex<3>& b, double reach, const SearchOptions<3>& options,
                             SignedDistance<3>& result) {
    if (options.trace != nullptr) return PairAnswer::unknown;
    if (are_box_and_triangle(a, b)) return box_triangle_distance(a, b, reach, result);
    if (!are_box_and_triangle(b, a)) return PairAnswer::unknown;
    const PairAnswer answer = box_triangle_distance(b, a, reach, result);
    if (answer == PairAnswer::yes) flip(result);
    return answer;
}

/// The distance if it is at most `reach`, or any distance; else `no`.
PairAnswer closed_distance(const Convex<3>& a, const Convex<3>& b, double reach, const SearchOptions<3>& options,
                           SignedDistance<3>& result) {
    const PairAnswer answer = closed_form_distance(a, b, reach, options.cache, result);
    return answer == PairAnswer::unknown ? triangle_distance(a, b, reach, options, result) : answer;
}

/// Whether the distance is at most `reach`, and then the distance. Without a limit there is always a distance.
bool distance_up_to(const Convex<3>& a, const Convex<3>& b, double reach, const SearchOptions<3>& options,
                    SignedDistance<3>& result) {
    const PairAnswer answer = closed_distance(a, b, reach, options, result);
    if (answer == PairAnswer::unknown) result = signed_distance(a, b, options);
    return answer != PairAnswer::no && result.distance <= reach;
}

}  // namespace

template <>
bool part_overlaps(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (options.trace != nullptr && are_plain_boxes(a, b)) {
        trace_boxes(a, b, options.trace);
        convex_overlap(a, b, {.trace = options.trace});
    }
    PairAnswer answer = overlap_of_cores(a, b, options.cache);
    if (answer == PairAnswer::unknown) answer = triangle_overlap(a, b, options);
    if (answer != PairAnswer::unknown) return answer == PairAnswer::yes;
    SignedDistance<3> form;
    answer = closed_form_distance(a, b, 0, nullptr, form);
    return answer == PairAnswer::unknown ? convex_overlap(a, b, options)
                                         : answer == PairAnswer::yes && form.distance <= 0;
}

template <>
SignedDistance<3> part_distance(const Convex<3>& a, const Convex<3>& b, const SearchOptions<3>& options) {
    if (options.trace != nullptr && are_plain_boxes(a, b)) {
        trace_boxes(a, b, options.trace);
        signed_distance(a, b, {.trace = options.trace});
    }
    SignedDistance<3> result;
    distance_up_to(a, b, unlimited, options, result);
    return result;
}

template <>
bool part_distance_up_to(const Convex<3>& a, const Convex<3>& b, double reach, SignedDistance<3>& result) {
    return distance_up_to(a, b, reach, {}, result);
}

template <>
bool part_distance_within(const Convex<3>& a, const Convex<3>& b, double reach, double margin,
                          const SearchOptions<3>& options, PartContact<3>& contact) {
    SignedDistance<3>& distance = contact.distance;
    contact.manifold.count = 0;
    if (are_plain_boxes(a, b)) {
        if (options.trace != nullptr) {
            trace_boxes(a, b, options.trace);
            manifold(a, b, signed_distance(a, b, {.trace = options.trace}), margin, options.trace);
        }
        if (a.radius == 0 && b.radius == 0) {
            const PlacedBox box_a(a.place, a.scale, a.own[0], 0), box_b(b.place, b.scale, b.own[0], 0);
            CoresDistance found;
            const PairAnswer answer =
                contact_of_boxes(box_a, box_b, reach, margin, options.cache, found, contact.manifold);
            if (answer == PairAnswer::yes) set_distance(found, distance);
            if (answer != PairAnswer::unknown) return answer == PairAnswer::yes;
            contact.manifold.count = 0;
        }
    }
    return distance_up_to(a, b, reach, options, distance);
}

}  // namespace abut::detail
