#include <abut/query/closed_form.hpp>
#include <abut/query/convex_pair.hpp>

namespace abut {

template <int D>
bool part_overlaps(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if (const auto form = closed_form(a, b)) return form->distance <= 0;
    return convex_overlap(a, b, options);
}

template <int D>
SignedDistance<D> part_distance(const Convex<D>& a, const Convex<D>& b, const SearchOptions<D>& options) {
    if (const auto form = closed_form(a, b)) return *form;
    return signed_distance(a, b, options);
}

template <int D>
bool part_contact(const Convex<D>& a, const Convex<D>& b, double reach, double margin, const SearchOptions<D>& options,
                  PartContact<D>& contact) {
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
