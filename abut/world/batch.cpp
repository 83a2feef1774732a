// Many changes and questions in one call.

#include <abut/broad_phase/detail/parallel.hpp>
#include <abut/broad_phase/detail/sort_pairs.hpp>
#include <abut/math/assert.hpp>
#include <abut/math/simd/library_entry.hpp>
#include <abut/world/world.hpp>

#include <algorithm>

#include <hwy/cache_control.h>

namespace abut::detail {
namespace {

/// A world of this many items exceeds the second-level cache of most processors (about 200 bytes an item), so that
/// questions in spatial order find more of it there. Sorting costs about 0.1 us a question.
constexpr std::size_t min_items_to_sort = 1 << 15, min_questions_to_sort = 1 << 10;

/// How far ahead of the present item the next ones are fetched into the cache.
constexpr std::size_t ids_ahead = 8;

/// Spreads the lowest bits of a number, with D - 1 zeros between two of them.
template <int D>
std::uint32_t spread(std::uint32_t bits) {
    std::uint32_t result = 0;
    for (int i = 0; i < 32 / D; ++i) result |= (bits >> i & 1) << (i * D);
    return result;
}

/// The place of a point on a Z-order curve through a box.
template <int D>
std::uint32_t z_order(const Vec<D>& point, const Aabb<D>& box) {
    constexpr float cells = static_cast<float>(1 << 32 / D) - 1;
    std::uint32_t result = 0;
    for (int i = 0; i < D; ++i) {
        const float width = box.max[i] - box.min[i], share = (point[i] - box.min[i]) / width;
        // A share of 0 stands for those that are no number.
        if (share > 0) result |= spread<D>(static_cast<std::uint32_t>(std::min(share, 1.0f) * cells)) << i;
    }
    return result;
}

/// The order in which questions are answered: by their indices, or in spatial order.
class Order {
public:
    template <int D, class PositionOf>
    static Order spatial(std::size_t count, std::size_t items, const PositionOf& position_of) {
        Order result;
        if (items < min_items_to_sort || count < min_questions_to_sort) return result;
        Aabb<D> box = Aabb<D>::empty();
        for (std::size_t i = 0; i < count; ++i) box = merged(box, Aabb<D>{position_of(i), position_of(i)});
        result.sorted_.reserve(2 * count);
        for (std::size_t i = 0; i < count; ++i)
            result.sorted_.push_back({z_order<D>(position_of(i), box), static_cast<std::uint32_t>(i)});
        sort_pairs(result.sorted_);
        return result;
    }
    bool is_by_index() const { return sorted_.empty(); }
    std::size_t operator[](std::size_t i) const { return is_by_index() ? i : sorted_[i].second; }

private:
    std::vector<ItemPair> sorted_;  // places on the curve, and indices
};

/// Calls answer(i) for each question i; the threads of an executor share the questions.
template <class Answer>
void answer_all(std::size_t count, Executor* executor, const Order& order, const Answer& answer) {
    constexpr std::size_t part_size = 64;
    const auto answer_part = [&](std::uint32_t part) {
        const std::size_t begin = part * part_size, end = std::min(count, begin + part_size);
        for (std::size_t i = begin; i < end; ++i) answer(order[i]);
    };
    run_parallel(executor, static_cast<std::uint32_t>((count + part_size - 1) / part_size), answer_part);
}

template <class A, class B>
std::size_t common_size(std::span<A> a, std::span<B> b) {
    ABUT_ASSERT(a.size() == b.size());
    return std::min(a.size(), b.size());
}

template <int D>
View<D> placed_by(const View<D>& shape, const Pose<D>& pose) {
    return moved(shape, affine(pose));
}

}  // namespace

/// Each item takes the shape and its data from one that is not in the world.
template <int D>
void WorldBatches<D>::add_all(const AnyShape<D>& shape, std::span<const ItemOptions<D>> options, std::span<Id> ids) {
    const std::size_t count = common_size(options, ids);
    World<D>& w = world();
    const std::size_t fixed = static_cast<std::size_t>(std::count_if(
        options.begin(), options.begin() + static_cast<std::ptrdiff_t>(count), [](const auto& o) { return o.fixed; }));
    w.fixed_.expect(fixed, World<D>::queries_per_fixed_item);
    w.moving_.expect(count - fixed, w.recent_queries_per_item());
    const std::size_t slots = w.items_.size() + count - std::min(count, w.free_.size());
    // Small batches, one after another, would reserve each time.
    if (slots > 2 * w.items_.capacity()) w.items_.reserve(slots);
    WorldItem<D> item{.stored = shape};
    w.set_shape_data(item);
    for (std::size_t i = 0; i < count; ++i) ids[i] = w.add_item(item, options[i]);
}

/// Calls change(i) for each id, and fetches the items after it.
template <int D>
template <class Change>
void WorldBatches<D>::change_all(std::span<const Id> ids, const Change& change) {
    World<D>& w = world();
    for (std::size_t i = 0; i < ids.size(); ++i) {
        if (i + ids_ahead < ids.size()) {
            const std::size_t slot = std::size_t{ids[i + ids_ahead].index} - 1;
            if (slot < w.items_.size()) hwy::Prefetch(&w.items_[slot]);
        }
        change(i);
    }
}

template <int D>
void WorldBatches<D>::move(std::span<const Id> ids, std::span<const Pose<D>> poses) {
    enter_library();
    const std::size_t count = common_size(ids, poses);
    change_all(ids.first(count), [&](std::size_t i) { world().move_to(ids[i], poses[i]); });
}

template <int D>
void WorldBatches<D>::remove(std::span<const Id> ids) {
    enter_library();
    change_all(ids, [&](std::size_t i) { world().remove(ids[i]); });
}

template <int D>
void WorldBatches<D>::raycast_all(std::span<const Ray<D>> rays, Hits hits, Executor* executor,
                                  const Filter& filter) const {
    answer_all(common_size(rays, hits), executor, {},
               [&](std::size_t i) { hits[i] = world().first_hit(rays[i], filter); });
}
template <int D>
void WorldBatches<D>::raycast(std::span<const Ray<D>> rays, Hits hits, const Filter& filter) const {
    enter_library();
    raycast_all(rays, hits, nullptr, filter);
}
template <int D>
void WorldBatches<D>::raycast(std::span<const Ray<D>> rays, Hits hits, Executor& executor, const Filter& filter) const {
    enter_library();
    raycast_all(rays, hits, &executor, filter);
}

template <int D>
void WorldBatches<D>::sweep_all(const View<D>& shape, std::span<const Motion<D>> motions, Hits hits, Executor* executor,
                                const Filter& filter) const {
    const std::size_t count = common_size(motions, hits);
    const auto start = [&](std::size_t i) { return motions[i].from.position; };
    answer_all(count, executor, Order::spatial<D>(count, world().size(), start),
               [&](std::size_t i) { hits[i] = world().sweep_rotating(shape, motions[i], filter); });
}

template <int D>
void WorldBatches<D>::closest_to_points(std::span<const Vec<D>> points, ClosestItems items, Executor* executor,
                                        const Filter& filter) const {
    const std::size_t count = common_size(points, items);
    const auto place = [&](std::size_t i) { return points[i]; };
    answer_all(count, executor, Order::spatial<D>(count, world().size(), place),
               [&](std::size_t i) { items[i] = world().closest_to(World<D>::point_view(points[i]), filter); });
}
template <int D>
void WorldBatches<D>::closest(std::span<const Vec<D>> points, ClosestItems items, const Filter& filter) const {
    enter_library();
    closest_to_points(points, items, nullptr, filter);
}
template <int D>
void WorldBatches<D>::closest(std::span<const Vec<D>> points, ClosestItems items, Executor& executor,
                              const Filter& filter) const {
    enter_library();
    closest_to_points(points, items, &executor, filter);
}

template <int D>
void WorldBatches<D>::closest_to_all(const View<D>& shape, std::span<const Pose<D>> poses, ClosestItems items,
                                     Executor* executor, const Filter& filter) const {
    const std::size_t count = common_size(poses, items);
    const auto place = [&](std::size_t i) { return poses[i].position; };
    answer_all(count, executor, Order::spatial<D>(count, world().size(), place),
               [&](std::size_t i) { items[i] = world().closest_to(placed_by(shape, poses[i]), filter); });
}

/// A part of the questions, in the order of answering, has a list of its own: `append` fills it. The lists are then
/// joined in the order of the questions.
template <int D>
void WorldBatches<D>::overlapping_all(const View<D>& shape, std::span<const Pose<D>> poses, IdLists& lists,
                                      Executor* executor, const Filter& filter) const {
    constexpr std::size_t min_part_size = 64, parts_per_worker = 16;
    const std::size_t count = poses.size();
    const auto place = [&](std::size_t i) { return poses[i].position; };
    const Order order = Order::spatial<D>(count, world().size(), place);
    /// Adds the answer of a question to a list, and returns its size.
    const auto append = [&](std::size_t question, std::vector<Id>& ids) {
        const std::ptrdiff_t begin = std::ssize(ids);
        world().visit_overlapping(placed_by(shape, poses[question]), filter, [&](Id id) {
            ids.push_back(id);
            return true;
        });
        std::sort(ids.begin() + begin, ids.end());
        return static_cast<std::size_t>(std::ssize(ids) - begin);
    };
    lists.ids_.clear();
    lists.ends_.resize(count);
    if (executor == nullptr && order.is_by_index()) {
        for (std::size_t i = 0; i < count; ++i) {
            append(i, lists.ids_);
            lists.ends_[i] = lists.ids_.size();
        }
        return;
    }

    const std::size_t max_parts = executor == nullptr ? 1 : parts_per_worker * executor->workers(),
                      parts = std::clamp<std::size_t>(count / min_part_size, 1, max_parts);
    if (lists.part_ids_.size() < parts) lists.part_ids_.resize(parts);
    const auto each_of_part = [&](std::size_t part, const auto& visit) {
        for (std::size_t i = count * part / parts; i < count * (part + 1) / parts; ++i) visit(order[i]);
    };
    run_parallel(executor, static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
        std::vector<Id>& ids = lists.part_ids_[part];
        ids.clear();
        each_of_part(part, [&](std::size_t question) { lists.ends_[question] = append(question, ids); });
    });
    std::size_t end = 0;
    for (std::size_t& size : lists.ends_) size = end += size;
    lists.ids_.resize(end);
    run_parallel(executor, static_cast<std::uint32_t>(parts), [&](std::uint32_t part) {
        const Id* from = lists.part_ids_[part].data();
        each_of_part(part, [&](std::size_t question) {
            const std::size_t begin = lists.begin(question), size = lists.ends_[question] - begin;
            std::copy_n(from, size, lists.ids_.data() + begin);
            from += size;
        });
    });
}

template class WorldBatches<2>;
template class WorldBatches<3>;

}  // namespace abut::detail
