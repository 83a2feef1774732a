#pragma once

// A broad phase that tests a pair only once anything can have changed: for items that are slow against their spacing.

#include <abut/broad_phase/bvh.hpp>
#include <abut/broad_phase/concept.hpp>
#include <abut/broad_phase/temporal/core.hpp>
#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// The pairs of a scene over time, over any other broad phase. Each item has a top speed: no face of its box moves
/// farther in a unit of time, turning and growing included. Two boxes a gap g apart cannot touch before g / (v + w),
/// nor separate before that when they overlap by a depth g: until then the pair is not tested.
///
/// The inner structure searches for the pairs, in boxes grown by how far each may move until the next search: v T.
/// Counts decide how long T is. Items so fast that they cross the spacing of the items within T are searched for in
/// each update, among themselves and among the grown boxes.
///
/// Exact as long as the boxes given to `update` stay within their speeds, up to two ulp of the coordinate. (A box that
/// is moved by adding floats rounds in each update: at 1000 from the origin by 3e-5.) A box that is faster is detected
/// when one of its pairs is next tested: that trips ABUT_ASSERT in debug builds, and its pairs are searched for anew.
///
/// Boxes may be empty or without bound as in any BroadPhase. But an item that comes or goes, loses or gets its bounds,
/// or is put elsewhere has no speed: call `jumped` for it. There are no region, ray and nearest queries: they need all
/// boxes as they are now, and a Temporal does not read those.
///
/// Memory: the inner structures, 60 to 64 bytes an item in 3D (44 to 48 in 2D), and 12.3 a pair that is held: 2 to 8 an
/// item, where each overlaps two others. `update` allocates only where more pairs are held than ever before.
template <int D, BroadPhase<D> Inner = Bvh<D>>
class Temporal {
public:
    /// From nothing. Top speeds are per unit of time, 0 or more; infinity is for what may go anywhere.
    void build(std::span<const Aabb<D>> boxes, std::span<const float> top_speeds, Executor* executor = nullptr) {
        core_.build(boxes, top_speeds);
        search(boxes, executor);
    }
    /// The same count, where they are now: `time` after the last update. Reads the boxes of those items that are due.
    void update(std::span<const Aabb<D>> boxes, double time, Executor* executor = nullptr) {
        core_.update(boxes, time);
        search(boxes, executor);
    }
    /// From the last update on. A raised one makes the next update search for the item anew, a lowered one counts from
    /// the next search on.
    void set_top_speed(std::uint32_t item, float speed) { core_.set_top_speed(item, speed); }
    float top_speed(std::uint32_t item) const { return core_.top_speed(item); }
    /// Since the last update the item has come, gone, or been put anywhere: the next one searches for it anew.
    void jumped(std::uint32_t item) { core_.leave(item); }

    /// Every pair of boxes that overlapped at the last update, once, with i < j; see BroadPhase.
    template <detail::Visitor<std::uint32_t, std::uint32_t> F>
    void each_pair(F&& visit, Executor* executor = nullptr) const {
        core_.visit_pairs(detail::batch_visitor(visit), executor);
    }
    void sorted_pairs(std::vector<detail::ItemPair>& out) const {
        out.clear();
        each_pair([&](std::uint32_t i, std::uint32_t j) { out.emplace_back(i, j); });
        std::sort(out.begin(), out.end());
    }

    std::size_t size() const { return core_.size(); }
    bool empty() const { return size() == 0; }
    /// Since `build`.
    const TemporalCounts& counts() const { return core_.counts(); }

private:
    static void place(Inner& inner, std::span<const Aabb<D>> boxes, Executor* executor) {
        if (boxes.size() == inner.size())
            inner.update(boxes, executor);
        else
            inner.build(boxes, executor);
    }

    void search(std::span<const Aabb<D>> boxes, Executor* executor) {
        if (core_.slow_due()) {
            place(slow_, core_.grown_boxes(), executor);
            slow_.each_pair([&](std::uint32_t i, std::uint32_t j) { core_.add_slow(i, j); });
        }
        core_.test_due(boxes);
        const std::span<const Aabb<D>> fast_boxes = core_.fast_boxes(boxes);
        if (fast_boxes.empty()) return;
        place(fast_, fast_boxes, executor);
        fast_.each_pair([&](std::uint32_t i, std::uint32_t j) { core_.add_fast(i, j); });
        if (fast_boxes.size() < size())
            slow_.each_overlapping_pair(fast_, [&](std::uint32_t i, std::uint32_t j) { core_.add_mixed(boxes, i, j); });
    }

    Inner slow_, fast_;
    detail::TemporalCore<D> core_;
};

}  // namespace abut
