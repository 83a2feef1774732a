#pragma once

// One-sided parts, which collide with their front only: a chain's segments, one-way platforms. For .cpp files.

#include <abut/shape/view/view.hpp>

namespace abut::detail {

/// Whether a motion in this direction, seen by the part, goes against its front.
template <int D>
bool approaches_front(const Convex<D>& part, const DVec<D>& direction) {
    return !part.one_sided || dot(front(part), direction) < 0;
}
template <int D>
bool approaches_front(const HalfSpaceView<D>&, const DVec<D>&) {
    return true;
}
template <int D>
bool approaches_front(const DistanceFunction<D>&, const DVec<D>&) {
    return true;
}

/// Whether a normal that points out of a part leaves it by its front.
template <int D>
bool exits_by_front(const Convex<D>& part, const DVec<D>& normal) {
    return !part.one_sided || dot(front(part), normal) > 0;
}
template <int D>
bool exits_by_front(const HalfSpaceView<D>&, const DVec<D>&) {
    return true;
}
template <int D>
bool exits_by_front(const DistanceFunction<D>&, const DVec<D>&) {
    return true;
}

template <class PartA, class PartB>
bool is_one_sided(const PartA& a, const PartB& b) {
    bool result = false;
    if constexpr (requires { a.one_sided; }) result = a.one_sided;
    if constexpr (requires { b.one_sided; }) result = result || b.one_sided;
    return result;
}

/// Whether two parts touch at their fronts; the normal is from A to B.
template <int D, class PartA, class PartB>
bool touch_at_fronts(const PartA& a, const PartB& b, const DVec<D>& normal) {
    return exits_by_front(a, normal) && exits_by_front(b, -normal);
}

}  // namespace abut::detail
