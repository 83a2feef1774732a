#include <abut/broad_phase/boxes.hpp>
#include <abut/broad_phase/detail/reserve_one_more.hpp>
#include <abut/broad_phase/reach.hpp>
#include <abut/world/detail/item_boxes.hpp>

#include <algorithm>

namespace abut::detail {
namespace {

/// If more than this fraction of the boxes is stale (1 / 8), a refit costs no more than setting them one by one.
constexpr std::size_t refit_divisor = 8;

}  // namespace

template <int D>
ItemBoxes<D>::ItemBoxes(std::optional<BroadPhaseKind> kind)
    : phase_(kind ? ChosenBroadPhase<D>(*kind) : ChosenBroadPhase<D>()) {}

template <int D>
void ItemBoxes<D>::expect(std::size_t count, double queries) {
    const std::size_t places = boxes_.size() + count - std::min(count, free_.size());
    if ((places - boxes_.size()) * refit_divisor <= boxes_.size()) return;
    boxes_.reserve(places);
    slots_.reserve(places);
    is_stale_.reserve(places);
    stale_.reserve(stale_.size() + count);
    expected_ = planned_ = places;
    phase_.set_history({.queries = queries});
}

template <int D>
std::uint32_t ItemBoxes<D>::add(std::uint32_t slot, double queries) {
    if (free_.empty()) {
        reserve_one_more(boxes_);
        reserve_one_more(slots_);
        reserve_one_more(is_stale_);
        boxes_.push_back(Aabb<D>::empty());
        slots_.push_back(slot);
        is_stale_.push_back(false);
        if (boxes_.size() <= expected_) return static_cast<std::uint32_t>(boxes_.size() - 1);
        // Another kind of broad phase may suit twice as many boxes.
        if (boxes_.size() > 2 * planned_) {
            planned_ = boxes_.size();
            phase_.set_history({.queries = queries});
            phase_.build(boxes_);
            mark_current();
        } else if (phase_.size() + 1 == boxes_.size()) {
            phase_.grow();
        }
        return static_cast<std::uint32_t>(boxes_.size() - 1);
    }
    const std::uint32_t place = free_.back();
    free_.pop_back();
    slots_[place] = slot;
    return place;
}

/// Records that the broad phase holds the present boxes.
template <int D>
void ItemBoxes<D>::mark_current() {
    for (const std::uint32_t place : stale_) is_stale_[place] = false;
    stale_.clear();
    pending_work_.cancel();
}

template <int D>
void ItemBoxes<D>::widen(std::uint32_t place, const Aabb<D>& box) {
    if (wide_.empty()) wide_ = boxes_;
    wide_[place] = box;
}

template <int D>
void ItemBoxes<D>::remove(std::uint32_t place) {
    set(place, Aabb<D>::empty());
    free_.push_back(place);
}

template <int D>
void ItemBoxes<D>::refresh(double queries, Executor* executor) {
    const double moved = static_cast<double>(changed_) / static_cast<double>(std::max<std::size_t>(size(), 1));
    phase_.set_history({.moved = std::min(moved, 1.0), .queries = queries});
    is_wide_ = !wide_.empty();
    const std::span<const Aabb<D>> boxes = is_wide_ ? wide_ : boxes_;
    if (refreshed_ == boxes.size())
        phase_.update(boxes, executor);
    else
        phase_.build(boxes, executor);
    wide_.clear();
    changed_ = 0;
    refreshed_ = planned_ = boxes_.size();
    mark_current();
}

template <int D>
void ItemBoxes<D>::prepare() const {
    pending_work_.run([this] {
        // A structure that cannot grow has fewer boxes, and any one after many items were added at once.
        if (phase_.size() != boxes_.size()) phase_.build(boxes_);
        bool is_set = stale_.size() * refit_divisor <= boxes_.size() + max_stale * refit_divisor;
        for (std::size_t i = 0; i < stale_.size() && is_set; ++i) is_set = phase_.set(stale_[i], boxes_[stale_[i]]);
        if (!is_set) phase_.refit(boxes_);
        for (const std::uint32_t place : stale_) is_stale_[place] = false;
        stale_.clear();
    });
}

template <int D>
void ItemBoxes<D>::each_overlapping(const Aabb<D>& box, ItemCall visit) const {
    prepare();
    for (const std::uint32_t place : stale_)
        if (overlaps(boxes_[place], box) && !visit(slots_[place])) return;
    phase_.each_overlapping(box, [&](std::uint32_t place) { return is_stale_[place] != 0 || visit(slots_[place]); });
}

/// Visits the places within reach by the broad phase's `search(visit)`, and then the stale ones. The reach is short by
/// then, so that most of these need no visit.
template <int D>
template <class MakeReach, class Search>
void ItemBoxes<D>::each_within_reach(const MakeReach& make_reach, ReachCall visit, const Search& search) const {
    prepare();
    float rest = std::numeric_limits<float>::infinity();
    const auto visit_slot = [&](std::uint32_t place) -> float { return rest = std::min(rest, visit(slots_[place])); };
    search([&](std::uint32_t place) -> float { return is_stale_[place] != 0 ? rest : visit_slot(place); });
    if (stale_.empty()) return;
    auto reach = make_reach();
    reach.shrink(rest);
    for (std::size_t i = 0; i < stale_.size() && !reach.is_exhausted(); ++i) {
        double measure = 0;
        const Aabb<D>& box = boxes_[stale_[i]];
        if (!is_empty(box) && reach.measure(box, measure)) reach.shrink(visit_slot(stale_[i]));
    }
}

template <int D>
void ItemBoxes<D>::raycast(const Ray<D>& ray, ReachCall visit) const {
    each_within_reach([&] { return RayReach<D>(ray); }, visit,
                      [&](auto visit_place) { phase_.raycast(ray, visit_place); });
}

template <int D>
void ItemBoxes<D>::sweep(const MovingBox<D>& box, ReachCall visit) const {
    each_within_reach([&] { return RayReach<D>::of_box(box); }, visit,
                      [&](auto visit_place) { phase_.sweep(box, visit_place); });
}

template <int D>
void ItemBoxes<D>::closest(const Aabb<D>& box, ReachCall visit, float max_distance) const {
    each_within_reach([&] { return BoxReach<D>(box, max_distance); }, visit,
                      [&](auto visit_place) { phase_.closest(box, visit_place, max_distance); });
}

template class ItemBoxes<2>;
template class ItemBoxes<3>;

}  // namespace abut::detail
