#pragma once

// One-sided parts, which collide with their front only: a chain's segments, one-way platforms. For .cpp files.

#include <abut/query/detail/part_pairs.hpp>

namespace abut::detail {

template <int D>
bool is_one_sided(const Part<D>& part) {
    return part.is_convex() && part.convex().one_sided;
}

/// Whether a motion in this direction, seen by the part, goes against its front.
template <int D>
bool approaches_front(const AnyPart<D>& part, const DVec<D>& direction) {
    return !is_one_sided(part) || dot(front(part.convex()), direction) < 0;
}

/// Whether a normal that points out of a part leaves it by its front.
template <int D>
bool exits_by_front(const AnyPart<D>& part, const DVec<D>& normal) {
    return !is_one_sided(part) || dot(front(part.convex()), normal) > 0;
}

/// Whether two parts touch at their fronts; the normal is from A to B.
template <int D>
bool touch_at_fronts(const AnyPart<D>& a, const AnyPart<D>& b, const DVec<D>& normal) {
    return exits_by_front(a, normal) && exits_by_front(b, -normal);
}

}  // namespace abut::detail
