#include "tool/check/piles.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace abut::tool {
namespace {

// The search ends after this many distances of objects from points, for each object.
constexpr std::size_t max_tests_per_object = 64;

}  // namespace

template <int D>
Pile<D> Piles<D>::pile_at(const Vec<D>& point, std::span<const std::uint32_t> nearby) {
    Pile<D> pile;
    pile.point = point;
    pile.depth = std::numeric_limits<float>::infinity();
    for (const std::uint32_t i : nearby) {
        const Object<D>& object = objects_[i];
        const float depth = -closest(object.placed, point).distance;
        if (!(depth > allowed_depth(object, object, limits_))) continue;
        pile.objects.push_back(i);
        pile.depth = std::min(pile.depth, depth);
    }
    return pile;
}

template <int D>
void Piles<D>::add(Pile<D>&& pile, std::size_t frame) {
    pile.first = pile.last = frame;
    // The same objects as at the frame before are the same pile.
    for (std::size_t i = piles_.size(); i-- > 0;) {
        Pile<D>& old = piles_[i];
        if (frame == 0 || old.last + 1 != frame || old.objects != pile.objects) continue;
        old.last = frame;
        for (const std::uint32_t object : old.objects) pile_of_[object] = static_cast<std::uint32_t>(i);
        return;
    }
    for (const std::uint32_t object : pile.objects) pile_of_[object] = static_cast<std::uint32_t>(piles_.size());
    piles_.push_back(std::move(pile));
}

template <int D>
void Piles<D>::find(std::span<const Aabb<D>> boxes, std::size_t frame) {
    pile_of_.assign(objects_.size(), none);
    Bvh<D> tree;
    tree.build(boxes);
    const bool has_all_pairs = filter_.has_all_pairs();
    std::size_t tests_left = max_tests_per_object * objects_.size();
    std::vector<std::uint32_t> nearby;
    for (std::uint32_t i = 0; i < objects_.size(); ++i) {
        const Object<D>& object = objects_[i];
        const bool has_inside = object.present && (object.solid || object.filled) && object.inside.depth > 0;
        if (!has_inside || pile_of_[i] != none) continue;
        const Vec<D> point = object.pose * object.inside.point;
        nearby.clear();
        tree.each_overlapping(Aabb<D>{point, point}, [&](std::uint32_t other) {
            const bool is_candidate = objects_[other].present && pile_of_[other] == none &&
                                      (objects_[other].solid || objects_[other].filled) &&
                                      (other == i || filter_.has(i, other));
            if (is_candidate) nearby.push_back(other);
        });
        if (nearby.size() < min_pile) continue;
        if (tests_left < nearby.size()) return;
        tests_left -= nearby.size();
        std::sort(nearby.begin(), nearby.end());
        Pile<D> pile = pile_at(point, nearby);
        // Two objects of one body, or that no pattern selects, are no pair: only one of them is in the pile.
        std::vector<std::uint32_t> selected;
        for (const std::uint32_t member : pile.objects)
            if (has_all_pairs || std::all_of(selected.begin(), selected.end(),
                                             [&](std::uint32_t other) { return filter_.has(member, other); }))
                selected.push_back(member);
        pile.objects = std::move(selected);
        if (pile.objects.size() >= min_pile) add(std::move(pile), frame);
    }
}

template class Piles<2>;
template class Piles<3>;

}  // namespace abut::tool
