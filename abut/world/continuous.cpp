// Continuous collision detection between two updates: the broad phases get the swept AABBs of all moved items, and the
// near pairs are swept.

#include <abut/broad_phase/boxes.hpp>
#include <abut/query/sweep.hpp>
#include <abut/world/world.hpp>

namespace abut {

/// Whether the item moved and has a box at both ends of its motion.
template <int D>
bool World<D>::has_swept_box(std::uint32_t slot) const {
    const std::uint32_t previous = items_[slot].previous;
    return previous != none && !swept_boxes_.empty() && !detail::is_empty(swept_boxes_[previous].box);
}

template <int D>
void World<D>::widen_boxes() {
    widened_ = false;
    if (continuous_ == 0) return;
    swept_boxes_.assign(previous_poses_.size(), detail::SweptBox<D>());
    for (const std::uint32_t slot : pending_) {
        const Item& item = items_[slot];
        if (item.previous == none || detail::is_empty(box(slot))) continue;
        const Pose<D>& from = previous_poses_[item.previous];
        const Aabb<D> first = item.stored.bounds_for_queries(from);
        if (detail::is_empty(first)) continue;
        Motion<D> motion = Motion<D>::between(from, item.pose);
        const bool is_large = positions_.are_used();
        if (is_large) motion.move = detail::to_float(positions_.of(slot) - positions_.previous(item.previous));
        detail::SweptBox<D>& path = swept_boxes_[item.previous];
        path = detail::swept_box(item.local_ball.ball(), first, motion);
        if (is_large) path.box = positions_.about_origin(path.box, positions_.previous(item.previous));
        boxes_of(item).widen(item.place, merged(bounds(path), box(slot)));
        widened_ = true;
    }
}

template <int D>
detail::SweptBox<D> World<D>::swept_box_of(std::uint32_t slot) const {
    return has_swept_box(slot) ? swept_boxes_[items_[slot].previous] : detail::swept_box(box(slot), Vec<D>(0.0f));
}

/// Whether the present AABBs of two items overlap, or their swept boxes if one is continuous. Their boxes in the broad
/// phases overlap.
template <int D>
bool World<D>::may_touch(std::uint32_t slot, std::uint32_t other) const {
    const Item &a = items_[slot], &b = items_[other];
    if (are_boxes_near(slot, other)) return true;
    if (!a.continuous && !b.continuous) return false;
    return (has_swept_box(slot) || has_swept_box(other)) &&
           detail::may_overlap(swept_box_of(slot), swept_box_of(other));
}

/// The hit of the motions of two items since the last update; its point is about the same position as a contact.
template <int D>
std::optional<Hit<D>> World<D>::sweep_pair(std::uint32_t slot, std::uint32_t other) const {
    const detail::DVec<D> about = positions_.frame(slot);
    const auto from = [&](std::uint32_t item) {
        if (!has_swept_box(item)) return pose_about(item, about);
        const std::uint32_t previous = items_[item].previous;
        Pose<D> pose = previous_poses_[previous];
        if (positions_.are_used()) pose.position = detail::to_float(positions_.previous(previous) - about);
        return pose;
    };
    const Pose<D> from_a = from(slot), from_b = from(other), to_a = pose_about(slot, about),
                  to_b = pose_about(other, about);
    const View<D> own_a = items_[slot].stored.view(), own_b = items_[other].stored.view();
    if (from_a.rotation == to_a.rotation && from_b.rotation == to_b.rotation)
        return abut::sweep(moved(own_a, detail::affine(from_a)), to_a.position - from_a.position,
                           moved(own_b, detail::affine(from_b)), to_b.position - from_b.position);
    return abut::sweep(own_a, from_a, to_a, own_b, from_b, to_b);
}

/// Writes the fractions of began_. began_ and results_.impacts are both sorted.
template <int D>
void World<D>::set_fractions() {
    fractions_.assign(began_.size(), 1.0f);
    auto impact = results_.impacts.begin();
    for (std::size_t i = 0; i < began_.size() && impact != results_.impacts.end(); ++i) {
        while (impact != results_.impacts.end() && IdPair{impact->a, impact->b} < began_[i]) ++impact;
        if (impact != results_.impacts.end() && IdPair{impact->a, impact->b} == began_[i])
            fractions_[i] = impact->hit.fraction;
    }
}

template class World<2>;
template class World<3>;

}  // namespace abut
