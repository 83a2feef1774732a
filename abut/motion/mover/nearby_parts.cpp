#include <abut/motion/mover/nearby_parts.hpp>
#include <abut/query/detail/one_sided.hpp>
#include <abut/shape/view/mapped_box.hpp>

namespace abut::detail {

template <int D>
void NearbyParts<D>::clear() {
    box_ = Aabb<D>::empty();
    order_.clear();
    boxes_.clear();
    stored_.clear();
    composites_.clear();
    points_.clear();
    has_one_sided_ = false;
}

template <int D>
void NearbyParts<D>::gather(const World<D>& world, const Aabb<D>& box, const Filter& filter) {
    clear();
    box_ = box;
    world.each_in_box(
        box,
        [&](Id id, const View<D>& shape) {
            detail::with_part(
                shape,
                [&](const Part<D>& part) {
                    has_one_sided_ = has_one_sided_ || is_one_sided(part);
                    const Aabb<D> box_of_part = part.is_half_space() ? everywhere<D>() : bounds(part);
                    order_.push_back({{id, 0}, static_cast<std::uint32_t>(stored_.size()), box_of_part});
                    stored_.push_back({shape});
                },
                [&](const Composite<D>& composite) {
                    // The view is valid only during this call.
                    composites_.push_back(composite);
                    each_part<D>(composite, box, [&](const Convex<D>& part, std::uint32_t index) {
                        add_part({id, index}, part);
                        return true;
                    });
                });
        },
        filter);
    // The point array no longer moves.
    for (StoredPart& stored : stored_)
        if (stored.has_points) std::get<Convex<D>>(stored.part).points = points_.data() + stored.first_point;
    std::sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    // A shape may visit a part twice.
    order_.erase(
        std::unique(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) { return a.name == b.name; }),
        order_.end());
    for (const Entry& entry : order_) boxes_.push_back(entry.box);
}

/// The last composite in `composites_` may create parts on the fly. Data that such a part refers to is copied, or the
/// part is visited again.
template <int D>
void NearbyParts<D>::add_part(const PartName& name, const Convex<D>& part) {
    const Aabb<D> box_of_part = bounds(part);
    if (!overlaps(box_of_part, box_)) return;
    has_one_sided_ = has_one_sided_ || part.one_sided;
    StoredPart stored{part};
    stored.is_transient = part.core == Core::function || part.facets != nullptr;
    stored.composite = static_cast<std::uint32_t>(composites_.size() - 1);
    if (!stored.is_transient && part.core == Core::points && part.points != nullptr) {
        stored.has_points = true;
        stored.first_point = points_.size();
        points_.insert(points_.end(), part.points, part.points + part.count);
        auto& copy = std::get<Convex<D>>(stored.part);
        copy.lanes = nullptr;
        copy.sides = nullptr;
    }
    order_.push_back({name, static_cast<std::uint32_t>(stored_.size()), box_of_part});
    stored_.push_back(stored);
}

template <int D>
void NearbyParts<D>::visit_again(const Composite<D>& composite, const Aabb<D>& box, std::uint32_t part,
                                 FunctionRef<void(const Convex<D>&)> visit) {
    bool found = false;
    each_part<D>(composite, box, [&](const Convex<D>& candidate, std::uint32_t index) {
        if (index != part || found) return !found;
        found = true;
        visit(candidate);
        return false;
    });
}

template class NearbyParts<2>;
template class NearbyParts<3>;

}  // namespace abut::detail
