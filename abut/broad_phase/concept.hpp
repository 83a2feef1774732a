#pragma once

// The interface of all broad phases. They know boxes and indices only, and differ in speed alone.

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
/// - `build(boxes, executor = nullptr)` builds from nothing. `update(boxes, executor = nullptr)` takes the same number
/// of
///   boxes, some of them moved. It allocates nothing once warm.
/// - `each_pair(visit, executor = nullptr)` calls `visit(i, j)` with i < j once for every pair of overlapping boxes. It
///   is exact, and touching counts. The order is the structure's own and depends only on the history of its boxes. With
///   an executor, several threads call the visitor at once, in no order. After the visitor returns false, threads that
///   are still running may report further pairs.
/// - `sorted_pairs(out)` replaces the contents of `out` by the same pairs sorted by (i, j).
/// - `each_overlapping(box, visit)` visits every item whose box overlaps this box. It is exact.
/// - `each_overlapping_pair(other, visit)` calls `visit(i, j)` if item i of this overlaps item j of the other.
/// - `raycast(ray, visit)` visits the items whose boxes the ray touches, each once, roughly front to back. The reach is
/// a
///   distance along the ray, at first its length.
/// - `sweep(moving_box, visit)` does so for a moving box. The reach is in lengths of its direction.
/// - `closest(point, visit, reach = infinity)` visits the items whose boxes are within reach of a point or of a box,
/// each
///   once, roughly nearest first. The visitor computes the distance to its own item and may return it as the new reach.
///
/// `raycast`, `sweep` and `closest` may visit an item that is out of reach by rounding (one part in a million of the
/// reach). They never omit an item that they touch. All items at equal distances are visited, so an answer need not
/// depend on the order. Visitor and ReachVisitor document the values that visitors may return.
///
/// A box may be unbounded on any side. An empty box (min > max on some axis) is an item that is never visited. An item
/// with a NaN is never visited either, and trips ABUT_ASSERT in debug builds. A query visits nothing if it has a NaN,
/// starts at a point at infinity, or has a direction that isn't finite.
///
/// Queries are const, allocate nothing except to grow `out`, and may run on many threads at once. The pairs don't
/// depend on the number of threads or on the SIMD target.
template <class T, int D>
concept BroadPhase = std::semiregular<T> &&
    requires(T& changing, const T& phase, std::span<const Aabb<D>> boxes, const Aabb<D>& box, const Ray<D>& ray,
             const MovingBox<D>& moving, const Vec<D>& point, float reach, void (*each)(std::uint32_t),
             bool (*until)(std::uint32_t), float (*within)(std::uint32_t),
             void (*each_pair)(std::uint32_t, std::uint32_t), bool (*until_pair)(std::uint32_t, std::uint32_t),
             std::vector<detail::ItemPair>& out, Executor* executor) {
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
