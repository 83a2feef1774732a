#pragma once

// Parts that are met from their front alone: a chain's segments, one-way platforms. For .cpp files.

#include <abut/shape/view/view.hpp>

namespace abut {

/// Whether something may go that way at a part, as seen by the part.
template <int D>
bool goes_at_front(const Convex<D>& part, const DVec<D>& way) {
    return !part.one_sided || dot(front(part), way) < 0;
}
template <int D>
bool goes_at_front(const HalfSpaceView<D>&, const DVec<D>&) {
    return true;
}
template <int D>
bool goes_at_front(const DistanceFunction<D>&, const DVec<D>&) {
    return true;
}

/// Whether the way out of a part is one that it has.
template <int D>
bool leaves_by_front(const Convex<D>& part, const DVec<D>& way_out) {
    return !part.one_sided || dot(front(part), way_out) > 0;
}
template <int D>
bool leaves_by_front(const HalfSpaceView<D>&, const DVec<D>&) {
    return true;
}
template <int D>
bool leaves_by_front(const DistanceFunction<D>&, const DVec<D>&) {
    return true;
}

template <class PartA, class PartB>
bool is_one_sided(const PartA& a, const PartB& b) {
    bool result = false;
    if constexpr (requires { a.one_sided; }) result = a.one_sided;
    if constexpr (requires { b.one_sided; }) result = result || b.one_sided;
    return result;
}

/// Whether two parts meet at their fronts; the normal is from A to B.
template <int D, class PartA, class PartB>
bool meet_at_fronts(const PartA& a, const PartB& b, const DVec<D>& normal) {
    return leaves_by_front(a, normal) && leaves_by_front(b, -normal);
}

}  // namespace abut
