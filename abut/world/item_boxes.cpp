#include <abut/world/item_boxes.hpp>

#include <algorithm>

namespace abut {

template <int D>
ItemBoxes<D>::ItemBoxes(std::optional<BroadPhaseKind> always)
    : phase_(always ? ChosenBroadPhase<D>(*always) : ChosenBroadPhase<D>()) {}

template <int D>
std::uint32_t ItemBoxes<D>::add(std::uint32_t slot) {
    if (free_.empty()) {
        boxes_.push_back(Aabb<D>::empty());
        slots_.push_back(slot);
        return static_cast<std::uint32_t>(boxes_.size() - 1);
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    slots_[place] = slot;
    return place;
}

template <int D>
void ItemBoxes<D>::set(std::uint32_t place, const Aabb<D>& box) {
    if (box == boxes_[place]) return;
    boxes_[place] = box;
    ++changed_;
}

template <int D>
void ItemBoxes<D>::widen(std::uint32_t place, const Aabb<D>& box) {
    boxes_[place] = box;
    changed_ = std::max<std::size_t>(changed_, 1);
}

template <int D>
void ItemBoxes<D>::remove(std::uint32_t place) {
    set(place, Aabb<D>::empty());
    free_.push_back(place);
}

template <int D>
void ItemBoxes<D>::refresh(double asked) {
    const double moved = static_cast<double>(changed_) / static_cast<double>(std::max<std::size_t>(size(), 1));
    phase_.tell({.moved = std::min(moved, 1.0), .asked = asked});
    if (phase_.size() == boxes_.size())
        phase_.update(boxes_);
    else
        phase_.build(boxes_);
    changed_ = 0;
}

template class ItemBoxes<2>;
template class ItemBoxes<3>;

}  // namespace abut
