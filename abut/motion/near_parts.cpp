#include <abut/motion/near_parts.hpp>

namespace abut {
namespace {

template <int D>
constexpr Aabb<D> everywhere() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Vec<D>(-infinity), Vec<D>(infinity)};
}

}  // namespace

template <int D>
void NearParts<D>::forget() {
    box_ = Aabb<D>::empty();
    order_.clear();
    boxes_.clear();
    kept_.clear();
    composites_.clear();
    points_.clear();
    has_one_sided_ = false;
}

template <int D>
void NearParts<D>::gather(const World<D>& world, const Aabb<D>& box, const Filter& filter) {
    forget();
    box_ = box;
    world.each_in_box(
        box,
        [&](Id id, const View<D>& shape) {
            const auto place = static_cast<std::uint32_t>(kept_.size());
            if (const auto* convex = std::get_if<Convex<D>>(&shape)) {
                has_one_sided_ = has_one_sided_ || convex->one_sided;
                kept_.push_back({*convex});
                order_.push_back({{id, 0}, place, bounds(*convex)});
            } else if (const auto* solid = std::get_if<Solid<D>>(&shape)) {
                kept_.push_back({*solid});
                order_.push_back({{id, 0}, place, everywhere<D>()});
            } else if (const auto* function = std::get_if<DistanceFunction<D>>(&shape)) {
                kept_.push_back({*function});
                order_.push_back({{id, 0}, place, bounds(*function)});
            } else {
                // The world makes the view for this call alone.
                const auto& composite = composites_.emplace_back(std::get<Composite<D>>(shape));
                each_part<D>(composite, box, [&](const Convex<D>& part, std::uint32_t index) {
                    take({id, index}, part);
                    return true;
                });
            }
        },
        filter);
    // Only now the points stay where they are.
    for (Kept& kept : kept_)
        if (kept.has_points) std::get<Convex<D>>(kept.part).points = points_.data() + kept.first_point;
    std::sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    // A shape may tell the same part twice.
    order_.erase(
        std::unique(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) { return a.name == b.name; }),
        order_.end());
    for (const Entry& entry : order_) boxes_.push_back(entry.box);
}

/// A composite shape, the last of `composites_`, may make up its parts as it goes: what they refer to is copied, or the
/// part is visited again.
template <int D>
void NearParts<D>::take(const PartName& name, const Convex<D>& part) {
    const Aabb<D> box_of_part = bounds(part);
    if (!overlaps(box_of_part, box_)) return;
    has_one_sided_ = has_one_sided_ || part.one_sided;
    Kept kept{part};
    kept.made_up = part.core == Core::function || part.facets != nullptr;
    kept.composite = static_cast<std::uint32_t>(composites_.size() - 1);
    if (!kept.made_up && part.core == Core::points && part.points != nullptr) {
        kept.has_points = true;
        kept.first_point = points_.size();
        points_.insert(points_.end(), part.points, part.points + part.count);
        auto& own = std::get<Convex<D>>(kept.part);
        own.lanes = nullptr;
        own.sides = nullptr;
    }
    order_.push_back({name, static_cast<std::uint32_t>(kept_.size()), box_of_part});
    kept_.push_back(kept);
}

template <int D>
void NearParts<D>::look_again(const Composite<D>& composite, const Aabb<D>& box, std::uint32_t part,
                              FunctionRef<void(const Convex<D>&)> visit) {
    bool found = false;
    each_part<D>(composite, box, [&](const Convex<D>& again, std::uint32_t index) {
        if (index != part || found) return !found;
        found = true;
        visit(again);
        return false;
    });
}

template class NearParts<2>;
template class NearParts<3>;

}  // namespace abut
