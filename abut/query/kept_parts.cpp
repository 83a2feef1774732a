#include <abut/query/kept_parts.hpp>

namespace abut {
namespace {

/// Whether a copy of it is all that there is of it.
template <int D>
bool holds_itself(const Convex<D>& part) {
    switch (part.core) {
        case Core::points:
            return part.points == nullptr;
        case Core::box:
        case Core::discs:
            return true;
        case Core::function:
            break;
    }
    return false;
}

}  // namespace

template <int D>
bool KeptParts<D>::keep(const Composite<D>& shape, const Aabb<D>& box) {
    box_ = box;
    count_ = 0;
    bool all = true;
    each_part<D>(shape, box, [&](const Convex<D>& part, std::uint32_t index) -> bool {
        all = count_ < capacity && holds_itself(part);
        if (!all) return false;
        const Aabb<D> bounds_of_part = bounds(part);
        if (!overlaps(bounds_of_part, box)) return true;
        boxes_[count_] = bounds_of_part;
        ::new (static_cast<void*>(room_ + count_ * sizeof(Kept))) Kept{part, index};
        ++count_;
        return true;
    });
    if (!all) {
        box_ = Aabb<D>::empty();
        count_ = 0;
    }
    return all;
}

template <int D>
bool KeptParts<D>::each_foot(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const {
    const Aabb<D> around = box_around(point, within);
    if (!contains(box_, around)) return false;
    for (std::uint32_t i = 0; i < count_; ++i) {
        if (!meet(boxes_[i], around)) continue;
        Foot<D> foot;
        if (find_foot(part(i), point, within, foot)) within = visit(foot);
        if (within == no_others) break;
    }
    return true;
}

template class KeptParts<2>;
template class KeptParts<3>;

}  // namespace abut
