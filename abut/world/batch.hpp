#pragma once

// Many changes and questions of a world in one call.

#include <abut/math/executor.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/ray.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/world/options.hpp>
#include <abut/world/results.hpp>

#include <optional>
#include <span>

namespace abut {

template <int D>
class World;

}  // namespace abut

namespace abut::detail {

/// The functions of World<D> that take spans. Two spans of a call have the same size.
///
/// Each answer is that of the question alone, and has a place in the second span or list. The threads of an executor,
/// such as a ThreadPool, share the questions.
///
/// A question allocates nothing; `overlapping` none once its list has seen answers of this size. In a world of 32768
/// items or more, 1024 questions or more but rays are answered in spatial order, which allocates 16 bytes a question.
template <int D>
class WorldBatches {
public:
    using Hits = std::span<std::optional<WorldHit<D>>>;
    using ClosestItems = std::span<std::optional<WorldClosest<D>>>;

    /// Adds an item for each entry of `options`, with one shape that they share; `ids` receives their ids. The ids are
    /// those of one call for each.
    template <Ownable S>
    requires(dimension<S> == D) void add(const S& shape, std::span<const ItemOptions<D>> options, std::span<Id> ids) {
        const AnyShape<D> stored(shape);
        clear_upper_halves();
        add_all(stored, options, ids);
    }
    void move(std::span<const Id> ids, std::span<const Pose<D>> poses);
    void remove(std::span<const Id> ids);

    void raycast(std::span<const Ray<D>> rays, Hits hits, const Filter& filter = {}) const;
    void raycast(std::span<const Ray<D>> rays, Hits hits, Executor& executor, const Filter& filter = {}) const;

    /// One shape in many motions, each of which has its own start.
    template <ShapeIn<D> S>
    void sweep(const S& shape, std::span<const Motion<D>> motions, Hits hits, const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { sweep_all(own, motions, hits, nullptr, filter); });
    }
    template <ShapeIn<D> S>
    void sweep(const S& shape, std::span<const Motion<D>> motions, Hits hits, Executor& executor,
               const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { sweep_all(own, motions, hits, &executor, filter); });
    }

    void closest(std::span<const Vec<D>> points, ClosestItems items, const Filter& filter = {}) const;
    void closest(std::span<const Vec<D>> points, ClosestItems items, Executor& executor,
                 const Filter& filter = {}) const;
    /// The question at index i is that of `at(shape, poses[i])`.
    template <ShapeIn<D> S>
    void closest(const S& shape, std::span<const Pose<D>> poses, ClosestItems items, const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { closest_to_all(own, poses, items, nullptr, filter); });
    }
    template <ShapeIn<D> S>
    void closest(const S& shape, std::span<const Pose<D>> poses, ClosestItems items, Executor& executor,
                 const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { closest_to_all(own, poses, items, &executor, filter); });
    }

    /// The items that overlap `at(shape, poses[i])`, sorted, in `lists[i]`.
    template <ShapeIn<D> S>
    void overlapping(const S& shape, std::span<const Pose<D>> poses, IdLists& lists, const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { overlapping_all(own, poses, lists, nullptr, filter); });
    }
    template <ShapeIn<D> S>
    void overlapping(const S& shape, std::span<const Pose<D>> poses, IdLists& lists, Executor& executor,
                     const Filter& filter = {}) const {
        with_view(shape, [&](const View<D>& own) { overlapping_all(own, poses, lists, &executor, filter); });
    }

protected:
    WorldBatches() = default;
    WorldBatches(const WorldBatches&) = default;
    WorldBatches& operator=(const WorldBatches&) = default;
    ~WorldBatches() = default;

private:
    World<D>& world() { return static_cast<World<D>&>(*this); }
    const World<D>& world() const { return static_cast<const World<D>&>(*this); }

    template <class Change>
    void change_all(std::span<const Id> ids, const Change& change);
    void raycast_all(std::span<const Ray<D>> rays, Hits hits, Executor* executor, const Filter& filter) const;
    void closest_to_points(std::span<const Vec<D>> points, ClosestItems items, Executor* executor,
                           const Filter& filter) const;
    void add_all(const AnyShape<D>& shape, std::span<const ItemOptions<D>> options, std::span<Id> ids);
    void sweep_all(const View<D>& shape, std::span<const Motion<D>> motions, Hits hits, Executor* executor,
                   const Filter& filter) const;
    void closest_to_all(const View<D>& shape, std::span<const Pose<D>> poses, ClosestItems items, Executor* executor,
                        const Filter& filter) const;
    void overlapping_all(const View<D>& shape, std::span<const Pose<D>> poses, IdLists& lists, Executor* executor,
                         const Filter& filter) const;
};

extern template class WorldBatches<2>;
extern template class WorldBatches<3>;

}  // namespace abut::detail
