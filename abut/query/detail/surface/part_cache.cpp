#include <abut/query/detail/surface/part_cache.hpp>

namespace abut::detail {
namespace {

/// Whether the part refers to no memory of its shape, so that a copy may outlive the visit.
template <int D>
bool is_self_contained(const Convex<D>& part) {
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
bool PartCache<D>::fill(const Composite<D>& shape, const Aabb<D>& box) {
    box_ = box;
    count_ = 0;
    bool all = true;
    each_part<D>(shape, box, [&](const Convex<D>& part, std::uint32_t index) -> bool {
        all = count_ < capacity && is_self_contained(part);
        if (!all) return false;
        const Aabb<D> bounds_of_part = bounds(part);
        if (!overlaps(bounds_of_part, box)) return true;
        for (int axis = 0; axis < D; ++axis) {
            min_[axis][count_] = bounds_of_part.min[axis];
            max_[axis][count_] = bounds_of_part.max[axis];
        }
        entries_[count_].part = part;
        entries_[count_++].index = index;
        return true;
    });
    if (!all) {
        box_ = Aabb<D>::empty();
        count_ = 0;
    }
    return all;
}

template <int D>
bool PartCache<D>::each_closest_point(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const {
    const Aabb<D> around = box_around(point, within);
    if (!contains(box_, around)) return false;
    each_overlapping(around, [&](std::uint32_t i) {
        ClosestPoint<D> closest;
        if (find_closest_point(part(i), point, within, closest)) within = visit(closest);
        return within != stop_visiting;
    });
    return true;
}

template <int D>
void Surface<D>::operator()(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const {
    double reach_left = within;
    const auto visit_part = [&](const ClosestPoint<D>& closest) { return reach_left = visit(closest); };
    if (is_composite() && (cache == nullptr || !cache->each_closest_point(point, within, visit_part)))
        each_closest_point_on<D>(shape, point, within, visit_part);
    if (neighbours != nullptr && reach_left > stop_visiting) (*neighbours)(point, reach_left, visit);
}

template struct Surface<2>;
template struct Surface<3>;
template class PartCache<2>;
template class PartCache<3>;

}  // namespace abut::detail
