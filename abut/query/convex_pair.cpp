#include <abut/convex/box_pair.hpp>
#include <abut/query/closed_form.hpp>
#include <abut/query/convex_pair.hpp>

namespace abut {

template <int D>
bool part_overlaps(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b)) return boxes_overlap(a, b, options);
    if (const auto form = closed_form(a, b)) return form->distance <= 0;
    return convex_overlap(a, b, options);
}

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b)) return distance_of_boxes(a, b, options);
    if (const auto form = closed_form(a, b)) return *form;
    return signed_distance(a, b, options);
}

template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact) {
    if constexpr (D == 3)
        if (are_plain_boxes(a, b))
            return contact_of_boxes(a, b, reach, margin, options, contact.distance, contact.manifold);
    contact.distance = part_distance(a, b, options);
    if (contact.distance.distance > reach) return false;
    contact.manifold = manifold(a, b, contact.distance, margin, options.trace);
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
