#pragma once

// A world that writes every change and question to a file, which `abut replay` runs again. A bug report is a file.

#include <abut/math/detail/mutex.hpp>
#include <abut/world/world.hpp>

#include <algorithm>
#include <functional>
#include <unordered_set>
#include <vector>

namespace abut::detail {

template <int D>
struct Entry;

}  // namespace abut::detail

namespace abut {

/// A World<D> with the same calls, which records them: a game declares a RecordedWorld<D> in its place. The answers are
/// those of the world.
///
/// `write` receives the recording piece by piece, each whole, so that a file that a crash cuts short can be replayed up
/// to there. Questions may come from many threads; `write` is called by one at a time.
///
/// Not recorded are `each_in_box`, the getters and other calls through `world()`, and questions about a distance
/// function or a shape of your own. Such a shape of an item ends the recording: `problem()` says so. A pair filter or
/// Filter::accepts is recorded by the pairs and items that it refused.
template <int D>
class RecordedWorld {
public:
    using Write = std::function<void(std::span<const std::byte>)>;
    using Hits = std::span<std::optional<WorldHit<D>>>;
    using ClosestItems = std::span<std::optional<WorldClosest<D>>>;

    explicit RecordedWorld(Write write, const WorldOptions& options = {})
        : RecordedWorld(std::move(write), World<D>(options), options) {}
    /// Records from this state on. `options` are those that the world was made with.
    RecordedWorld(Write write, World<D> world, const WorldOptions& options = {});

    /// The world, for what is not recorded.
    const World<D>& world() const { return world_; }
    /// Why the recording ended before the game did, if it has.
    std::optional<Problem> problem() const;

    template <Ownable S>
    requires(dimension<S> == D) Id add(const S& shape, const ItemOptions<D>& options = {}) {
        const Id id = world_.add(shape, options);
        record_add(id);
        return id;
    }
    template <Ownable S>
    requires(dimension<S> == D) void add(const S& shape, std::span<const ItemOptions<D>> options, std::span<Id> ids) {
        world_.add(shape, options, ids);
        for (const Id id : ids) record_add(id);
    }
    template <Ownable S>
    requires(dimension<S> == D) void set_shape(Id id, const S& shape) {
        world_.set_shape(id, shape);
        record_shape(id);
    }
    template <Ownable S, class F>
    bool edit_shape(Id id, F&& edit) {
        const bool is_edited = world_.template edit_shape<S>(id, std::forward<F>(edit));
        if (is_edited) record_shape(id);
        return is_edited;
    }
    void move(Id id, const Pose<D>& pose);
    void move(std::span<const Id> ids, std::span<const Pose<D>> poses);
    void remove(Id id);
    void remove(std::span<const Id> ids);
    void set_filter(Id id, std::uint64_t layers, std::uint64_t mask);
    void set_user(Id id, std::uint64_t user);
    void set_fixed(Id id, bool fixed);
    void set_sensor(Id id, bool sensor);
    void set_continuous(Id id, bool continuous);
    void set_group(Id id, std::int32_t group);
    void set_enabled(Id id, bool enabled);
    void set_pair_filter(std::function<bool(Id a, Id b)> accepts);

    std::vector<std::byte> save();
    std::optional<Problem> restore(std::span<const std::byte> bytes);
    void refresh() { world_.refresh(); }
    Events update();
    Events update(Executor& executor);

    bool contains(Id id) const { return world_.contains(id); }
    std::uint64_t user(Id id) const { return world_.user(id); }
    Pose<D> pose(Id id) const { return world_.pose(id); }
    View<D> shape(Id id) const { return world_.shape(id); }
    AnyShape<D> any_shape(Id id) const { return world_.any_shape(id); }
    ItemOptions<D> options(Id id) const { return world_.options(id); }
    std::size_t size() const { return world_.size(); }
    std::span<const WorldContact<D>> contacts() const { return world_.contacts(); }
    std::span<const WorldImpact<D>> impacts() const { return world_.impacts(); }
    UpdateCounts counts() const { return world_.counts(); }

    std::vector<Id> touching(Id id) const;
    Contact<D> contact(const IdPair& pair) const;
    std::optional<Hit<D>> impact(const IdPair& pair) const;

    std::optional<WorldHit<D>> raycast(const Ray<D>& ray, const Filter& filter = {}) const;
    bool raycast_any(const Ray<D>& ray, const Filter& filter = {}) const;
    std::vector<WorldHit<D>> raycast_all(const Ray<D>& ray, const Filter& filter = {}) const;
    std::optional<WorldClosest<D>> closest(const Vec<D>& point, const Filter& filter = {}) const;
    std::vector<WorldClosest<D>> k_nearest(const Vec<D>& point, std::size_t k, const Filter& filter = {}) const;
    std::vector<Id> containing(const Vec<D>& point, const Filter& filter = {}) const;

    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Vec<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_view(own, motion, filter); });
    }
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Motion<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_view(own, motion, filter); });
    }
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Pose<D>& from, const Pose<D>& to,
                                     const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_view(own, from, to, filter); });
    }
    template <detail::ShapeIn<D> S>
    std::optional<WorldClosest<D>> closest(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return closest_to(own, filter); });
    }
    template <detail::ShapeIn<D> S>
    std::vector<WorldClosest<D>> k_nearest(const S& shape, std::size_t k, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return nearest_to(own, k, filter); });
    }
    template <detail::ShapeIn<D> S>
    std::vector<Id> overlapping(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return all_overlapping(own, filter); });
    }
    /// The items in order of their ids.
    template <detail::ShapeIn<D> S, detail::Visitor<Id> F>
    void each_overlapping(const S& shape, F&& visit, const Filter& filter = {}) const {
        const auto go_on = detail::bool_visitor(visit);
        for (const Id id : overlapping(shape, filter))
            if (!go_on(id)) return;
    }
    /// The contacts in order of the items' ids.
    template <detail::ShapeIn<D> S, detail::Visitor<Id, const Contact<D>&> F>
    void each_contact(const S& shape, F&& visit, const Filter& filter = {}, const QueryOptions<D>& options = {}) const {
        const auto go_on = detail::bool_visitor(visit);
        const auto found =
            detail::with_view(shape, [&](const View<D>& own) { return all_contacts(own, filter, options); });
        for (const WorldContact<D>& each : found)
            if (!go_on(each.b, each.contact)) return;
    }

    std::size_t k_nearest(const Vec<D>& point, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return copied(k_nearest(point, out.size(), filter), out);
    }
    template <detail::ShapeIn<D> S>
    std::size_t k_nearest(const S& shape, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return copied(k_nearest(shape, out.size(), filter), out);
    }

    // Many at once: each question is asked and recorded alone, also with an executor.
    void raycast(std::span<const Ray<D>> rays, Hits hits, const Filter& filter = {}) const;
    void closest(std::span<const Vec<D>> points, ClosestItems items, const Filter& filter = {}) const;
    template <detail::ShapeIn<D> S>
    void sweep(const S& shape, std::span<const Motion<D>> motions, Hits hits, const Filter& filter = {}) const {
        for (std::size_t i = 0; i < motions.size(); ++i) hits[i] = sweep(shape, motions[i], filter);
    }
    template <detail::ShapeIn<D> S>
    void closest(const S& shape, std::span<const Pose<D>> poses, ClosestItems items, const Filter& filter = {}) const {
        detail::with_view(shape, [&](const View<D>& own) {
            for (std::size_t i = 0; i < poses.size(); ++i) items[i] = closest_at(own, poses[i], filter);
        });
    }
    template <detail::ShapeIn<D> S>
    void overlapping(const S& shape, std::span<const Pose<D>> poses, IdLists& lists, const Filter& filter = {}) const {
        detail::with_view(shape, [&](const View<D>& own) { overlapping_at(own, poses, lists, filter); });
    }
    void raycast(std::span<const Ray<D>> rays, Hits hits, Executor&, const Filter& filter = {}) const {
        raycast(rays, hits, filter);
    }
    void closest(std::span<const Vec<D>> points, ClosestItems items, Executor&, const Filter& filter = {}) const {
        closest(points, items, filter);
    }
    template <detail::ShapeIn<D> S>
    void sweep(const S& shape, std::span<const Motion<D>> motions, Hits hits, Executor&,
               const Filter& filter = {}) const {
        sweep(shape, motions, hits, filter);
    }
    template <detail::ShapeIn<D> S>
    void closest(const S& shape, std::span<const Pose<D>> poses, ClosestItems items, Executor&,
                 const Filter& filter = {}) const {
        closest(shape, poses, items, filter);
    }
    template <detail::ShapeIn<D> S>
    void overlapping(const S& shape, std::span<const Pose<D>> poses, IdLists& lists, Executor&,
                     const Filter& filter = {}) const {
        overlapping(shape, poses, lists, filter);
    }

private:
    static std::size_t copied(const std::vector<WorldClosest<D>>& from, std::span<WorldClosest<D>> to) {
        std::copy(from.begin(), from.end(), to.begin());
        return from.size();
    }

    using Entry = detail::Entry<D>;
    class Refused;

    void record_add(Id id);
    void record_shape(Id id);
    template <class T>
    void record_option(Id id, std::uint8_t option, T value, std::uint64_t mask = 0);
    bool is_recording() const;
    void record(Entry& entry) const;
    void write_entry(Entry& entry) const;
    bool write_shape(Entry& entry, const View<D>& shape) const;
    void write_item_shape(Entry& entry, Id id);
    void end(const Problem& problem) const;
    Events updated(Executor* executor);
    template <class Query>
    auto query(Entry entry, const View<D>* shape, const Filter& filter, const Query& call) const;

    std::optional<WorldHit<D>> sweep_view(const View<D>& shape, const Vec<D>& motion, const Filter& filter) const;
    std::optional<WorldHit<D>> sweep_view(const View<D>& shape, const Motion<D>& motion, const Filter& filter) const;
    std::optional<WorldHit<D>> sweep_view(const View<D>& shape, const Pose<D>& from, const Pose<D>& to,
                                          const Filter& filter) const;
    std::optional<WorldClosest<D>> closest_to(const View<D>& shape, const Filter& filter) const;
    std::optional<WorldClosest<D>> closest_at(const View<D>& shape, const Pose<D>& pose, const Filter& filter) const;
    std::vector<WorldClosest<D>> nearest_to(const View<D>& shape, std::size_t k, const Filter& filter) const;
    std::vector<Id> all_overlapping(const View<D>& shape, const Filter& filter) const;
    void overlapping_at(const View<D>& shape, std::span<const Pose<D>> poses, IdLists& lists,
                        const Filter& filter) const;
    std::vector<WorldContact<D>> all_contacts(const View<D>& shape, const Filter& filter,
                                              const QueryOptions<D>& options) const;

    World<D> world_;
    Write write_;
    std::function<bool(Id, Id)> pair_filter_;
    std::vector<IdPair> refused_pairs_;  // in the present update
    bool has_events_ = false;            // the lists of the last update are those that a replay has
    mutable detail::Mutex mutex_;        // of what follows, of write_ and of refused_pairs_
    mutable std::unordered_set<std::uint64_t> written_shapes_;
    mutable std::optional<Problem> problem_;
};

using RecordedWorld2 = RecordedWorld<2>;
using RecordedWorld3 = RecordedWorld<3>;

extern template class RecordedWorld<2>;
extern template class RecordedWorld<3>;

}  // namespace abut
