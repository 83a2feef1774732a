#include <abut/convex/box_pair.hpp>
#include <abut/convex/round_manifold.hpp>
#include <abut/query/closed_form.hpp>
#include <abut/query/convex_pair.hpp>

namespace abut {

template <int D>
bool part_overlaps(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b)) return boxes_overlap(a, b, options);
    SignedDistance<D> form;
    if (closed_form(a, b, form)) return form.distance <= 0;
    return convex_overlap(a, b, options);
}

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b)) return distance_of_boxes(a, b, options);
    SignedDistance<D> result;
    if (!closed_form(a, b, result)) result = signed_distance(a, b, options);
    return result;
}

template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b))
            return contact_of_boxes(a, b, reach, margin, options, contact.distance, contact.manifold);
    if (!closed_form(a, b, contact.distance)) contact.distance = signed_distance(a, b, options);
    if (contact.distance.distance > reach) return false;
    if constexpr (D == 3) {
        // The clipping that it saves is told where somebody watches.
        if (options.trace != nullptr) manifold(a, b, contact.distance, margin, options.trace);
        if (round_manifold(a, b, contact.distance, margin, contact.manifold)) return true;
        contact.manifold = manifold(a, b, contact.distance, margin);
    } else {
        contact.manifold = manifold(a, b, contact.distance, margin, options.trace);
    }
    return true;
}

#define ABUT_INSTANTIATE(D)                                                                                 \
    template bool part_overlaps(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&);               \
    template SignedDistance<D> part_distance(const Convex<D>&, const Convex<D>&, const SearchOptions<D>&);  \
    template bool part_contact(const Convex<D>&, const Convex<D>&, double, double, const SearchOptions<D>&, \
                               PartContact<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
