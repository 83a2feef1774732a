#pragma once

// What every broad phase can do. They know boxes and indices, and differ in speed alone.

#include <abut/broad_phase/visit.hpp>
#include <abut/math/aabb.hpp>
#include <abut/math/executor.hpp>
#include <abut/math/ray.hpp>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace abut {

/// A broad phase over n boxes, the items 0 .. n - 1 in the order of the span.
///
/// - `build(boxes, executor = nullptr)`: from nothing. `update(boxes, executor = nullptr)`: the same count, some moved;
///   allocates nothing once warm.
/// - `each_pair(visit, executor = nullptr)`: every pair of overlapping boxes once, as `visit(i, j)` with i < j;
/// exactly:
///   touching counts. In the structure's own order, which depends on its history of boxes and on nothing else. With an
///   executor the visitor is called on several threads at once, in no order, and where it has had enough, threads that
///   are on their way may tell it of some more.
/// - `sorted_pairs(out)`: replaces what is in `out` by the same pairs sorted by (i, j).
/// - `each_overlapping(box, visit)`: every item whose box overlaps this one, exactly.
/// - `each_overlapping_pair(other, visit)`: every `visit(i, j)` where item i of this overlaps item j of the other.
/// - `raycast(ray, visit)`: the items whose box the ray touches, each once, roughly front to back; the reach is a
///   distance along the ray, at first its length.
/// - `sweep(moving_box, visit)`: the same for a box on its way; the reach is in lengths of its direction.
/// - `closest(point, visit, reach = infinity)`: the items whose box is no farther than the reach, each once, roughly
///   nearest first, from a point or from a box. The visitor works out the distance to its own item and may return it as
///   the new reach.
///
/// `raycast`, `sweep` and `closest` may visit an item that they miss by rounding (one part in a million of the reach),
/// and never leave out one that they touch: equal distances all come, so that an answer need not depend on the order.
/// What visitors may return is told at Visitor and ReachVisitor.
///
/// A box may be without bound on any side. An empty box (min > max on some axis) is an item that is never visited. So
/// is one with a NaN, which trips ABUT_ASSERT in debug builds. A query with a NaN visits nothing, nor does one from a
/// point at infinity, or along a direction that isn't finite.
///
/// Queries are const, allocate nothing (but for what `out` needs to grow) and may run on many threads at once. With one
/// thread or many, and whatever the vector unit, the pairs are the same.
template <class T, int D>
concept BroadPhase = std::semiregular<T> &&
    requires(T& changing, const T& phase, std::span<const Aabb<D>> boxes, const Aabb<D>& box, const Ray<D>& ray,
             const MovingBox<D>& moving, const Vec<D>& point, float reach, void (*each)(std::uint32_t),
             bool (*until)(std::uint32_t), float (*within)(std::uint32_t),
             void (*each_pair)(std::uint32_t, std::uint32_t), bool (*until_pair)(std::uint32_t, std::uint32_t),
             std::vector<ItemPair>& out, Executor* executor) {
    changing.build(boxes);
    changing.build(boxes, executor);
    changing.update(boxes);
    changing.update(boxes, executor);
    phase.each_pair(each_pair);
    phase.each_pair(until_pair);
    phase.each_pair(until_pair, executor);
    phase.sorted_pairs(out);
    phase.each_overlapping(box, each);
    phase.each_overlapping(box, until);
    phase.each_overlapping_pair(phase, each_pair);
    phase.each_overlapping_pair(phase, until_pair);
    phase.raycast(ray, each);
    phase.raycast(ray, until);
    phase.raycast(ray, within);
    phase.sweep(moving, each);
    phase.sweep(moving, until);
    phase.sweep(moving, within);
    phase.closest(point, each);
    phase.closest(point, until, reach);
    phase.closest(box, within, reach);
    { phase.size() } -> std::same_as<std::size_t>;
    { phase.empty() } -> std::same_as<bool>;
    { phase.bounds() } -> std::same_as<Aabb<D>>;
};

}  // namespace abut
