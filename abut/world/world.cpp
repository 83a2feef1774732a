#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/reserve_one_more.hpp>
#include <abut/math/assert.hpp>
#include <abut/shape/view/mapped_box.hpp>
#include <abut/world/world.hpp>

#include <utility>

namespace abut {

using namespace detail;

template <int D>
const typename World<D>::Item* World<D>::find(Id id) const {
    if (id.index == 0 || id.index > items_.size()) return nullptr;
    const Item& item = items_[id.index - 1];
    return item.in_use && item.generation == id.generation ? &item : nullptr;
}

/// The item of an id that should not be stale; null if it is.
template <int D>
const typename World<D>::Item* World<D>::expected(Id id) const {
    const Item* const item = find(id);
    ABUT_ASSERT(item != nullptr);
    return item;
}

template <int D>
typename World<D>::Item* World<D>::expected(Id id) {
    return const_cast<Item*>(std::as_const(*this).expected(id));
}

template <int D>
Id World<D>::add_shape(const AnyShape<D>& shape, const ItemOptions<D>& options) {
    Item item{.stored = shape};
    set_shape_data(item);
    return add_item(item, options);
}

/// Adds a copy of an item, which has a shape and its data, with these options.
template <int D>
Id World<D>::add_item(const Item& with_shape, const ItemOptions<D>& options) {
    std::uint32_t slot = static_cast<std::uint32_t>(items_.size());
    if (free_.empty()) {
        detail::reserve_one_more(items_);
        items_.push_back(with_shape);
    } else {
        slot = free_.back();
        free_.pop_back();
        items_[slot].stored = with_shape.stored;
        items_[slot].type = with_shape.type;
        items_[slot].local_ball = with_shape.local_ball;
        items_[slot].ball_is_centered = with_shape.ball_is_centered;
    }
    Item& item = items_[slot];
    item.set(options);
    item.in_use = true;
    ++item.generation;
    ++count_;
    continuous_ += options.continuous ? 1 : 0;
    add_to_boxes(slot);
    begin_anew(slot);
    return id_of(slot);
}

/// Gives an item a place in fixed_ or moving_, with an empty box.
template <int D>
void World<D>::add_to_boxes(std::uint32_t slot) {
    Item& item = items_[slot];
    item.place = boxes_of(item).add(slot, item.fixed ? queries_per_fixed_item : recent_queries_per_item());
    query_count_.set_limit(query_limit());
}

/// The running mean, or the queries since the last update if they are more already.
template <int D>
double World<D>::recent_queries_per_item() const {
    return std::max(queries_per_item_, queries_per_item(query_count_.sum()));
}
template <int D>
double World<D>::queries_per_item(std::uint32_t sum) const {
    return static_cast<double>(sum) / (ray_weight * std::max<double>(static_cast<double>(moving_.size()), 1));
}

/// It is high enough to count the queries of several updates in one.
template <int D>
std::uint32_t World<D>::query_limit() const {
    return static_cast<std::uint32_t>(ray_weight * (moving_.size() + 64));
}

template <int D>
void World<D>::reset_item(std::uint32_t slot) {
    set_shape_data(items_[slot]);
    begin_anew(slot);
}

/// Begins anew with an item whose shape is new, or that was not enabled.
template <int D>
void World<D>::begin_anew(std::uint32_t slot) {
    Item& item = items_[slot];
    item.settled = false;
    item.previous = none;
    update_box(slot);
}

template <int D>
void World<D>::set_shape_data(Item& item) {
    const View<D> own = item.stored.view();
    item.type = shape_type(own);
    item.local_ball = detail::SmallBall<D>::around(detail::bounding_ball(own));
    item.ball_is_centered = item.local_ball.center == Vec<D>(0.0f);
}

template <int D>
void World<D>::set_any_shape(Id id, const AnyShape<D>& shape) {
    Item* item = expected(id);
    if (item == nullptr) return;
    release_shape(id.index - 1);
    item->stored = shape;
    reset_item(id.index - 1);
}

template <int D>
bool World<D>::edit_any_shape(Id id, FunctionRef<bool(AnyShape<D>&, Aabb<D>&)> edit) {
    Item* item = expected(id);
    if (item == nullptr) return false;
    const std::uint32_t slot = id.index - 1;
    const Aabb<D> before = bounds(item->stored);
    // A copy, if a snapshot may need the shape as it was.
    release_shape(slot);
    Aabb<D> changed;
    const bool is_edited = edit(item->stored, changed);
    detail::clear_upper_halves();
    if (!is_edited) return false;
    const bool in_box = (!item->pending || item->pending_in_box) && bounds(item->stored) == before &&
                        changed != detail::everywhere<D>();
    reset_item(slot);
    if (in_box) mark_changed_in(slot, changed);
    return true;
}

/// Restricts the change of an item to a box in its own frame. Its size must not have changed, by which the filter of
/// internal edges measures.
template <int D>
void World<D>::mark_changed_in(std::uint32_t slot, const Aabb<D>& box) {
    Item& item = items_[slot];
    item.pending_in_box = true;
    const Aabb<D> placed = is_empty(box) ? box : detail::mapped_box(box, affine(item.pose));
    for (auto& [other, changed] : changed_boxes_)
        if (other == slot) {
            changed = merged(changed, placed);
            return;
        }
    changed_boxes_.emplace_back(slot, placed);
}

template <int D>
void World<D>::move_to(Id id, const Pose<D>& pose) {
    Item* item = expected(id);
    if (item == nullptr || item->pose == pose) return;
    keep_previous_pose(id.index - 1);
    item->pose = pose;
    update_box(id.index - 1);
}

/// Keeps the pose of the last update, if the item was there and hasn't moved since.
template <int D>
inline void World<D>::keep_previous_pose(std::uint32_t slot) {
    Item& item = items_[slot];
    if (!item.settled || item.previous != none) return;
    item.previous = static_cast<std::uint32_t>(previous_poses_.size());
    detail::reserve_one_more(previous_poses_);
    previous_poses_.push_back(item.pose);
    if (positions_.are_used()) positions_.keep_previous(slot);
}

template <int D>
void World<D>::set_filter(Id id, std::uint64_t layers, std::uint64_t mask) {
    Item* item = expected(id);
    if (item == nullptr) return;
    item->layers = layers;
    item->mask = mask;
    mark_pending(id.index - 1);
}

template <int D>
void World<D>::remove(Id id) {
    const bool is_valid = contains(id);
    ABUT_ASSERT(is_valid);
    if (!is_valid) return;
    free_slot(id.index - 1);
    mark_pending(id.index - 1);
    free_.push_back(id.index - 1);
}

template <int D>
void World<D>::free_slot(std::uint32_t slot) {
    Item& item = items_[slot];
    release_shape(slot);
    const AnyShape<D> released = std::move(item.stored);
    item.in_use = false;
    boxes_of(item).remove(item.place);
    continuous_ -= item.continuous ? 1 : 0;
    item.previous = none;
    --count_;
}

template <int D>
void World<D>::update_box(std::uint32_t slot) {
    Item& item = items_[slot];
    // Returned by one call, the box stays in registers.
    if (item.enabled && !positions_.are_used())
        boxes_of(item).set(item.place, item.stored.bounds_for_queries(item.pose));
    else
        boxes_of(item).set(item.place, bounds_in_broad_phase(slot));
    ABUT_ASSERT(!is_empty(box(slot)) || is_finite(placed(slot)));
    mark_pending(slot);
}

template <int D>
Aabb<D> World<D>::bounds_in_broad_phase(std::uint32_t slot) {
    const Aabb<D> bounds = items_[slot].bounds();
    return positions_.are_used() ? positions_.item_box(slot, bounds) : bounds;
}

/// Sets the boxes of all items, about an origin that is near to most of them. No answer depends on it.
template <int D>
void World<D>::set_boxes() {
    const auto is_in_use = [this](std::uint32_t slot) { return slot < items_.size() && items_[slot].in_use; };
    if (positions_.are_far()) positions_.move_origin(is_in_use);
    for (std::uint32_t slot = 0; slot < items_.size(); ++slot)
        if (items_[slot].in_use) boxes_of(items_[slot]).set(items_[slot].place, bounds_in_broad_phase(slot));
}

template <int D>
View<D> World<D>::placed(std::uint32_t slot, const DVec<D>& about) const {
    View<D> result = items_[slot].stored.placed(items_[slot].pose);
    if (positions_.are_used()) set_offset<D>(result, offset_of(result), positions_.of(slot) - about);
    return result;
}

template <int D>
Pose<D> World<D>::pose_about(std::uint32_t slot, const DVec<D>& position) const {
    Pose<D> pose = items_[slot].pose;
    if (positions_.are_used()) pose.position = to_float(positions_.of(slot) - position);
    return pose;
}

/// It depends on the difference of the two positions alone.
template <int D>
Aabb<D> World<D>::box_about(std::uint32_t slot, const DVec<D>& position) const {
    if (!positions_.are_used()) return box(slot);
    return DoublePositions<D>::moved_outwards(items_[slot].bounds(), positions_.of(slot) - position);
}

/// Of two slots in either order the answer is one.
template <int D>
bool World<D>::are_boxes_near(std::uint32_t slot, std::uint32_t other) const {
    if (!overlaps(box(slot), box(other))) return false;
    if (!positions_.are_used() || DoublePositions<D>::surely_overlap(box(slot), box(other))) return true;
    const auto [first, second] = std::minmax(slot, other);
    return overlaps(items_[first].bounds(), box_about(second, positions_.of(first)));
}

template <int D>
BoundingBall<D> World<D>::ball(std::uint32_t slot, const DVec<D>& about) const {
    const Item& item = items_[slot];
    const Pose<D>& pose = item.pose;
    Affine<D> place;
    if (item.ball_is_centered)
        place.offset = DVec<D>(pose.position);
    else
        place = affine(pose);
    if (positions_.are_used()) place.offset += positions_.of(slot) - about;
    return detail::moved(item.local_ball.ball(), place);
}

template <int D>
inline void World<D>::mark_pending(std::uint32_t slot) {
    items_[slot].pending_in_box = false;
    if (items_[slot].pending) return;
    items_[slot].pending = true;
    detail::reserve_one_more(pending_);
    pending_.push_back(slot);
}

template <int D>
bool World<D>::contains(Id id) const {
    return find(id) != nullptr;
}

template <int D>
std::uint64_t World<D>::user(Id id) const {
    const Item* item = expected(id);
    return item != nullptr ? item->user : 0;
}

template <int D>
Pose<D> World<D>::pose(Id id) const {
    const Item* item = expected(id);
    return item != nullptr ? item->pose : Pose<D>{};
}

template <int D>
View<D> World<D>::shape(Id id) const {
    const Item* item = expected(id);
    return item != nullptr ? placed(id.index - 1) : View<D>();
}

template <int D>
AnyShape<D> World<D>::any_shape(Id id) const {
    const Item* item = expected(id);
    return item != nullptr ? item->stored : AnyShape<D>(Ball<D>{});
}

template class World<2>;
template class World<3>;

}  // namespace abut
