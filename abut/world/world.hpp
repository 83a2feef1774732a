#pragma once

// A collision world for games: it stores shapes by id, reports the pairs that touch with each update, and answers
// queries about all items. It moves nothing by itself.

#include <abut/math/executor.hpp>
#include <abut/math/motion.hpp>
#include <abut/math/result.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/shape/detail/changed_box.hpp>
#include <abut/world/batch.hpp>
#include <abut/world/detail/double_positions.hpp>
#include <abut/world/detail/item_boxes.hpp>
#include <abut/world/detail/pair_index.hpp>
#include <abut/world/detail/pair_results.hpp>
#include <abut/world/detail/query_count.hpp>
#include <abut/world/detail/released_shapes.hpp>
#include <abut/world/detail/swept_box.hpp>
#include <abut/world/detail/update_memory.hpp>
#include <abut/world/detail/why_no_sweep.hpp>
#include <abut/world/detail/world_item.hpp>
#include <abut/world/options.hpp>
#include <abut/world/results.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace abut::detail {

template <int D>
struct MoverAtHit;
template <int D>
struct ClosestPoint;
template <int D>
struct DeepestParts;
template <int D>
struct SurfaceContact;

}  // namespace abut::detail

namespace abut {

template <int D>
class History;
template <int D>
class LargeWorld;

/// A collision world. All lists are sorted by id, and no answer depends on the order in which items were added except
/// through the ids.
///
/// Queries see every item at its present pose, also before the next update. They are const, may run on many threads at
/// once, and do not allocate unless they return a list. The first query after many changes brings the broad phases up
/// to date while the others wait. A stale id trips ABUT_ASSERT; in release it is ignored.
template <int D>
class World : public detail::WorldBatches<D> {
public:
    // Many at once, by spans: abut/world/batch.hpp.
    using Many = detail::WorldBatches<D>;
    using Many::add, Many::move, Many::remove, Many::raycast, Many::sweep, Many::closest, Many::overlapping;

    World() : World(WorldOptions()) {}
    explicit World(const WorldOptions& options)
        : fixed_(options.broad_phase),
          moving_(options.broad_phase),
          filters_edges_(options.filter_edges),
          released_shapes_(options.max_released_shapes),
          ball_early_outs_(options.ball_early_out) {}
    /// A copy shares the shapes, has the same ids, and answers as the original does, bit by bit.
    World(const World&) = default;
    World& operator=(const World&) = default;
    World(World&&) noexcept = default;
    World& operator=(World&&) noexcept = default;

    /// Adds a copy of the shape and of all data it refers to. A view, such as the result of `shape`, does not compile;
    /// `any_shape` returns a shape that can be added.
    template <Ownable S>
    requires(dimension<S> == D) Id add(const S& shape, const ItemOptions<D>& options = {}) {
        const AnyShape<D> stored(shape);
        detail::clear_upper_halves();
        return add_shape(stored, options);
    }
    template <class S, class Why = detail::WhyNotOwnable<D, S>>
    auto add(const S& shape, const ItemOptions<D>& options = {});
    template <Ownable S>
    requires(dimension<S> == D) void set_shape(Id id, const S& shape) {
        const AnyShape<D> stored(shape);
        detail::clear_upper_halves();
        set_any_shape(id, stored);
    }
    template <class S, class Why = detail::WhyNotOwnable<D, S>>
    auto set_shape(Id id, const S& shape);
    /// Calls edit(shape) on the item's own shape if it is an S, and returns whether it is. So a level changes without
    /// being copied or built anew: `edit_shape<TileMap>(id, [](TileMap& map) { map.set(tile, Tile::empty); })`. Queries
    /// and the next update see the change, as after `set_shape`.
    template <Ownable S, class F>
    bool edit_shape(Id id, F&& edit) {
        return edit_any_shape(id, [&](AnyShape<D>& shape, Aabb<D>& changed) {
            return shape.template edit<S>([&](S& own) { changed = detail::edit_and_take_changed<D>(own, edit); });
        });
    }
    void move(Id id, const Pose<D>& pose) {
        detail::clear_upper_halves();
        move_to(id, pose);
    }
    template <class P, class Why = detail::WhyNoPose<D, P>>
    auto move(Id id, const P& position);
    void set_filter(Id id, std::uint64_t layers, std::uint64_t mask);
    void remove(Id id);

    bool contains(Id id) const;
    std::uint64_t user(Id id) const;
    Pose<D> pose(Id id) const;
    /// The item's shape at its present pose; valid until the item is moved, changed or removed.
    View<D> shape(Id id) const;
    /// The item's shape in its own frame, without the pose, to be stored, stretched or added again. It is shared, not
    /// copied.
    AnyShape<D> any_shape(Id id) const;
    std::size_t size() const { return count_; }

    // The present values of an item's options.
    ItemOptions<D> options(Id id) const;
    std::uint64_t layers(Id id) const;
    std::uint64_t mask(Id id) const;
    std::int32_t group(Id id) const;
    bool is_fixed(Id id) const;
    bool is_sensor(Id id) const;
    bool is_continuous(Id id) const;
    bool is_enabled(Id id) const;

    // Queries see a change at once. The next update treats a pair as if the item had always had the new option: a pair
    // that still touches has stayed, even if it gained or lost its contact.
    void set_user(Id id, std::uint64_t user);
    /// A pair ends if both items are fixed now.
    void set_fixed(Id id, bool fixed);
    /// A touching pair stays: it loses its contact, or gains one.
    void set_sensor(Id id, bool sensor);
    /// The change applies to the motion since the last update as well.
    void set_continuous(Id id, bool continuous);
    void set_group(Id id, std::int32_t group);
    /// The pairs of an item that is no longer enabled end. One that is enabled again begins at its present pose.
    void set_enabled(Id id, bool enabled);

    /// From the next update on, two items pair only if `accepts(a, b)` returns true, a < b, besides all other
    /// conditions. It is called for near pairs in an unspecified order, may be called several times in one update, and
    /// must then give one answer and not change the world. Its answers may change from update to update. Empty: all
    /// pairs. A snapshot doesn't contain it.
    void set_pair_filter(std::function<bool(Id a, Id b)> accepts) {
        pair_filter_ = std::move(accepts);
        filters_pairs_ = true;
    }

    /// A snapshot for `restore`: ids, poses, options, user data, the touching pairs and the motion since the last
    /// update. Shapes are named by their hashes. Equal worlds have equal snapshots, on every machine. In 3D 60 bytes an
    /// item, 48 in 2D; 8 for a touching pair; 32 (20 in 2D) for an item that moved since the last update; 16 for one
    /// in a group, or with layers, or some of the mask, above the first 32.
    ///
    /// The first save after a shape was added takes time linear in the number of the shape's parts.
    std::vector<std::byte> save();
    /// The same into a buffer, which allocates nothing if the capacity suffices.
    void save(std::vector<std::byte>& bytes);
    /// Returns to the state of a snapshot. All answers, events and later ids are those that the saved world would have
    /// given; ids of items that were added since are stale, ids of those removed since are valid again. The lists of
    /// the last update, such as `contacts`, are empty until the next one, which tests all near pairs.
    ///
    /// The shapes must be in this world, or be among those it had at a `save`, see WorldOptions::max_released_shapes.
    /// So a snapshot of another world with the same shapes is possible. A Problem if the bytes are damaged, of another
    /// version or dimension (`bad_format`), or if a shape is missing (`not_found`, with the index of the item's id);
    /// the world is then unchanged.
    std::optional<Problem> restore(std::span<const std::byte> bytes);

    /// Calls visit(id) for all items, sorted by index; it returns nothing, or false to stop. It may change and remove
    /// items. Items that it adds may be visited or not.
    template <detail::Visitor<Id> F>
    void each_item(F&& visit) const {
        visit_items(detail::bool_visitor(visit));
    }

    /// Finds all touching pairs. It allocates nothing once it has seen a scene of this size, and skips pairs of which
    /// neither item moved since the last update.
    ///
    /// For a sample of pairs, it reads a clock to learn for which types of shapes an early out by bounding balls pays.
    /// It counts moved items and queries, and may change to another broad phase (`broad_phase()` returns the present
    /// one); such an update takes about twice as long and allocates. Events and contacts depend on neither.
    ///
    /// While any item is continuous, the swept AABBs of all moved items are tested. An item that is teleported then
    /// costs less if it is removed and added.
    Events update() {
        detail::clear_upper_halves();
        return find_events(nullptr);
    }
    /// The same events, contacts and bits, by the threads of an executor, such as a ThreadPool. They call a pair filter
    /// at the same time.
    Events update(Executor& executor) {
        detail::clear_upper_halves();
        return find_events(&executor);
    }
    /// The contacts of the last update, for pairs without a sensor, sorted by pairs. A pair that touches with several
    /// surfaces, such as a crate with the floor and a wall of one mesh, has an entry for each, the deepest first. An
    /// item that touches several others gets surface normals of their union, without ghost collisions: docs/ghosts.md.
    std::span<const WorldContact<D>> contacts() const { return contacts_; }
    /// The impacts of the last update, sorted: one for each pair with a continuous item, sensor or not, that began and
    /// touched during its motion.
    std::span<const WorldImpact<D>> impacts() const { return results_.impacts; }
    UpdateCounts counts() const { return counts_; }
    /// Brings the broad phases up to date with all changes, so that queries are as fast as after an update. It is
    /// optional: no answer of a query or of the next update depends on it.
    void refresh() {
        detail::clear_upper_halves();
        refresh_now();
    }
    /// The present broad phase of the items that are not fixed.
    BroadPhaseKind broad_phase() const { return moving_.phase().kind(); }

    /// The items that an item touched at the last update, sorted, without those removed since. Pairs that touched only
    /// during their motion are not included. The cost is a binary search among all pairs, and the size of the result.
    std::vector<Id> touching(Id id) const;
    /// Calls visit(other) for the items of `touching`, sorted, without allocating; it returns nothing, or false to
    /// stop.
    template <detail::Visitor<Id> F>
    void each_touching(Id id, F&& visit) const {
        visit_touching(id, detail::bool_visitor(visit));
    }
    /// Calls visit(contact) for the entries of `contacts` that the item is part of, sorted by the other item's id; it
    /// returns nothing, or false to stop. The cost is that of `each_touching`, and a binary search for each pair.
    template <detail::Visitor<const WorldContact<D>&> F>
    void each_contact_of(Id id, F&& visit) const {
        visit_contacts_of(id, detail::bool_visitor(visit));
    }
    /// The deepest contact of a pair at the last update, from the lower id to the higher. It is false if the pair
    /// doesn't touch, has a sensor, touched only during its motion, or if other contacts cover the same surface
    /// (docs/ghosts.md).
    Contact<D> contact(const IdPair& pair) const;
    /// The impact of a pair at the last update; none if the pair isn't among `impacts`.
    std::optional<Hit<D>> impact(const IdPair& pair) const;

    /// The first hit, as abut::raycast defines it; among equally near hits, the one with the lowest id.
    std::optional<WorldHit<D>> raycast(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return first_hit(ray, filter);
    }
    /// Whether the ray hits anything, such as for a line of sight. The search stops at the first item that it finds.
    bool raycast_any(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return any_hit(ray, filter);
    }
    /// The first hit on each item, front to back.
    std::vector<WorldHit<D>> raycast_all(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return all_hits(ray, filter);
    }

    /// The first hit of a linear motion, as abut::sweep defines it; among equally early hits, the one with the lowest
    /// id. An item that the shape touches at the start is hit only if the motion goes further in.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Vec<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_linear(own, motion, filter); });
    }
    /// The first hit of a motion with rotation. The shape is given in the frame that the motion moves.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Motion<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_rotating(own, motion, filter); });
    }
    /// The first hit of a motion from pose to pose, with rotation along the shorter arc.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Pose<D>& from, const Pose<D>& to,
                                     const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_between(own, from, to, filter); });
    }
    template <class S, class... Motions, class Why = detail::WhyNoSweepInWorld<D, S, Motions...>>
    auto sweep(const S& shape, const Motions&... motions) const;

    template <detail::ShapeIn<D> S>
    std::optional<WorldClosest<D>> closest(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return closest_to(own, filter); });
    }
    template <class S, class Why = detail::WhyNotIn<D, S>>
    requires(!detail::PointIn<S, D>) auto closest(const S& shape, const Filter& filter = {}) const;
    std::optional<WorldClosest<D>> closest(const Vec<D>& point, const Filter& filter = {}) const {
        return closest_to(point_view(point), filter);
    }

    /// Writes the closest items, up to `out.size()` of them, sorted by distance and then by id; returns their number.
    /// Distances are signed: the deepest overlap comes first.
    template <detail::ShapeIn<D> S>
    std::size_t k_nearest(const S& shape, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return nearest_to(own, out, filter); });
    }
    std::size_t k_nearest(const Vec<D>& point, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return nearest_to(point_view(point), out, filter);
    }
    /// Returns the k closest items, or all if there are fewer.
    template <detail::ShapeIn<D> S>
    std::vector<WorldClosest<D>> k_nearest(const S& shape, std::size_t k, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return list_of_nearest(own, k, filter); });
    }
    std::vector<WorldClosest<D>> k_nearest(const Vec<D>& point, std::size_t k, const Filter& filter = {}) const {
        return list_of_nearest(point_view(point), k, filter);
    }

    template <detail::ShapeIn<D> S>
    std::vector<Id> overlapping(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return all_overlapping(own, filter); });
    }
    template <class S, class Why = detail::WhyNotIn<D, S>>
    auto overlapping(const S& shape, const Filter& filter = {}) const;
    /// Calls visit(id) for the overlapping items, in an unspecified order; it returns nothing, or false to stop.
    template <detail::ShapeIn<D> S, detail::Visitor<Id> F>
    void each_overlapping(const S& shape, F&& visit, const Filter& filter = {}) const {
        detail::with_view(shape,
                          [&](const View<D>& own) { visit_overlapping(own, filter, detail::bool_visitor(visit)); });
    }
    template <class S, class F, class Why = detail::WhyNotIn<D, S>>
    auto each_overlapping(const S& shape, F&& visit, const Filter& filter = {}) const;
    /// Calls visit(id, contact) for the contacts of a shape (A) with the items (B), in an unspecified order; it returns
    /// nothing, or false to stop. The items are one surface for the shape, without ghost collisions, as in `contacts`;
    /// an item that the shape touches with several surfaces has a contact for each. With a margin, items up to that far
    /// away count as well.
    template <detail::ShapeIn<D> S, detail::Visitor<Id, const Contact<D>&> F>
    void each_contact(const S& shape, F&& visit, const Filter& filter = {}, const QueryOptions<D>& options = {}) const {
        detail::with_view(
            shape, [&](const View<D>& own) { visit_contacts(own, filter, options, detail::bool_visitor(visit)); });
    }
    template <class S, class F, class Why = detail::WhyNotIn<D, S>>
    auto each_contact(const S& shape, F&& visit, const Filter& filter = {}, const QueryOptions<D>& options = {}) const;
    std::vector<Id> containing(const Vec<D>& point, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return all_containing(point, filter);
    }

    /// Calls visit(id, shape) for the items whose AABBs overlap a box, in an unspecified order; it returns nothing, or
    /// false to stop. Each shape is at its present pose. Users build queries of their own with it.
    template <detail::Visitor<Id, const View<D>&> F>
    void each_in_box(const Aabb<D>& box, F&& visit, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        visit_in_box(box, filter, detail::bool_visitor(visit));
    }

private:
    friend Many;
    friend History<D>;
    friend LargeWorld<D>;

    static constexpr std::uint32_t none = 0xFFFFFFFF;
    /// Fixed items change seldom, and each moving item queries them once in an update.
    static constexpr double queries_per_fixed_item = 1;
    using Item = detail::WorldItem<D>;
    using Query = detail::QueryAt<D>;

    static View<D> point_view(const Vec<D>& point) {
        detail::clear_upper_halves();
        return View<D>(detail::round_points<D>({point}, 0));
    }

    // What follows is compiled with the library's flags.
    Id add_shape(const AnyShape<D>& shape, const ItemOptions<D>& options);
    void move_to(Id id, const Pose<D>& pose);
    Events find_events(Executor* executor);
    void refresh_now();
    std::optional<WorldHit<D>> first_hit(const Ray<D>& ray, const Query& query) const;
    bool any_hit(const Ray<D>& ray, const Query& query) const;
    std::vector<WorldHit<D>> all_hits(const Ray<D>& ray, const Query& query) const;
    std::vector<Id> all_containing(const Vec<D>& point, const Query& query) const;

    Id add_item(const Item& with_shape, const ItemOptions<D>& options);
    void add_to_boxes(std::uint32_t slot);
    void reset_item(std::uint32_t slot);
    void begin_anew(std::uint32_t slot);
    void set_shape_data(Item& item);
    void free_slot(std::uint32_t slot);
    struct Snapshot;
    static std::pair<std::uint32_t, std::uint32_t> saved_counts(std::span<const std::byte> bytes);
    void find_shape_hashes();
    std::optional<Problem> find_shapes(const Snapshot& snapshot,
                                       std::vector<std::pair<std::uint32_t, AnyShape<D>>>& changed);
    void release_shape(std::uint32_t slot);
    template <class SavedItem>
    void restore_item(const SavedItem& saved);
    void set_any_shape(Id id, const AnyShape<D>& shape);
    bool edit_any_shape(Id id, FunctionRef<bool(AnyShape<D>&, Aabb<D>&)> edit);
    void mark_changed_in(std::uint32_t slot, const Aabb<D>& box);
    const Item* find(Id id) const;
    const Item* expected(Id id) const;
    Item* expected(Id id);
    Id id_of(std::uint32_t slot) const { return {slot + 1, items_[slot].generation}; }
    detail::ItemBoxes<D>& boxes_of(const Item& item) { return item.fixed ? fixed_ : moving_; }
    /// The item's AABB; empty for a free slot, and for an item that is not finite or has no parts.
    const Aabb<D>& box(std::uint32_t slot) const {
        const Item& item = items_[slot];
        return (item.fixed ? fixed_ : moving_).box(item.place);
    }
    /// The item's shape, pose, box and bounding ball about a position, which is 0 unless positions are doubles.
    View<D> placed(std::uint32_t slot, const detail::DVec<D>& about = detail::DVec<D>(0.0)) const;
    Pose<D> pose_about(std::uint32_t slot, const detail::DVec<D>& position) const;
    Aabb<D> box_about(std::uint32_t slot, const detail::DVec<D>& position) const;
    bool are_boxes_near(std::uint32_t slot, std::uint32_t other) const;
    detail::BoundingBall<D> ball(std::uint32_t slot, const detail::DVec<D>& about) const;
    void visit_items(FunctionRef<bool(Id)> visit) const;
    void visit_touching(Id id, FunctionRef<bool(Id)> visit) const;
    void visit_contacts_of(Id id, FunctionRef<bool(const WorldContact<D>&)> visit) const;
    void update_box(std::uint32_t slot);
    Aabb<D> bounds_in_broad_phase(std::uint32_t slot);
    void keep_previous_pose(std::uint32_t slot);
    void set_boxes();
    void mark_pending(std::uint32_t slot);
    bool passes(std::uint32_t slot, const Filter& filter) const;
    double recent_queries_per_item() const;
    double queries_per_item(std::uint32_t sum) const;
    std::uint32_t query_limit() const;
    void refresh_boxes(Executor* executor);
    bool has_swept_box(std::uint32_t slot) const;
    void widen_boxes();
    detail::SweptBox<D> swept_box_of(std::uint32_t slot) const;
    bool may_touch(std::uint32_t slot, std::uint32_t other) const;
    bool may_pair(std::uint32_t slot, std::uint32_t other) const;
    void find_near(Executor* executor);
    bool has_new_answer(const detail::SlotPair& pair) const;
    bool has_changed_near(std::uint32_t slot, std::uint32_t other) const;
    class PairTests;
    void test_near(Executor* executor);
    void join_results(std::span<detail::PairResults<D>> parts);
    std::optional<Hit<D>> sweep_pair(std::uint32_t slot, std::uint32_t other) const;
    bool filters_edges(std::uint32_t slot) const;
    bool are_neighbours(std::uint32_t slot, std::uint32_t other) const;
    void find_changed_neighbours();
    bool neighbours_changed(const detail::SlotPair& pair);
    bool is_covered(std::size_t ghost, const Id& item) const;
    void link_contacts();
    bool is_reported(std::size_t found);
    void list_results();
    void compare_with_last();
    void set_fractions();

    template <class F>
    void each_near(const Aabb<D>& box, const Query& query, F&& visit) const;
    template <class F>
    void each_near_ray(const Ray<D>& ray, const Query& query, F&& visit) const;
    template <class F>
    std::optional<WorldHit<D>> first_on_path(const View<D>& shape, const detail::SweptBox<D>& path, const Query& query,
                                             F&& sweep_at) const;
    bool has_other_item_near(const detail::MoverAtHit<D>& mover, const Query& query, const WorldHit<D>& hit) const;
    void filter_normal(const detail::MoverAtHit<D>& mover, const Query& query, WorldHit<D>& hit) const;
    std::optional<WorldHit<D>> sweep_linear(const View<D>& shape, const Vec<D>& motion, const Query& query) const;
    std::optional<WorldHit<D>> sweep_rotating(const View<D>& shape, const Motion<D>& motion, const Query& query) const;
    std::optional<WorldHit<D>> sweep_between(const View<D>& shape, const Pose<D>& from, const Pose<D>& to,
                                             const Query& query) const;
    std::optional<WorldClosest<D>> closest_to(const View<D>& shape, const Query& query) const;
    std::size_t nearest_to(const View<D>& shape, std::span<WorldClosest<D>> out, const Query& query) const;
    std::vector<WorldClosest<D>> list_of_nearest(const View<D>& shape, std::size_t k, const Query& query) const;
    std::vector<Id> all_overlapping(const View<D>& shape, const Query& query) const;
    void visit_overlapping(const View<D>& shape, const Query& query, FunctionRef<bool(Id)> visit) const;
    void visit_contacts(const View<D>& shape, const Query& query, const QueryOptions<D>& options,
                        FunctionRef<bool(Id, const Contact<D>&)> visit) const;
    void visit_in_box(const Aabb<D>& box, const Query& query, FunctionRef<bool(Id, const View<D>&)> visit) const;

    std::vector<Item> items_;
    detail::DoublePositions<D> positions_;          // not used unless this is a LargeWorld's
    std::vector<Pose<D>> previous_poses_;           // poses of moved items at the last update
    std::vector<detail::SweptBox<D>> swept_boxes_;  // by index in previous_poses_; in an update with continuous items
    std::vector<std::uint32_t> free_, pending_;
    std::vector<std::pair<std::uint32_t, Aabb<D>>> changed_boxes_;  // of slots that changed in a box alone
    bool widened_ = false;                                          // the broad phases hold swept AABBs of moved items
    std::size_t count_ = 0, continuous_ = 0;

    detail::ItemBoxes<D> fixed_, moving_;
    mutable detail::QueryCount query_count_;  // since the last update
    double queries_per_item_ = 0;             // running mean of queries per update and moving item
    bool filters_edges_ = true;
    std::function<bool(Id, Id)> pair_filter_;
    bool filters_pairs_ = false;               // there is a pair filter, or was at the last update
    std::vector<std::uint64_t> shape_hashes_;  // by slot; 0: not known; the vector may be shorter than items_
    detail::ReleasedShapes<D> released_shapes_;

    std::vector<detail::SlotPair> near_, last_near_;   // sorted if a filter of pairs is in use
    detail::UpdateMemory<D> memory_;                   // made by the first update
    detail::PairResults<D> results_;                   // sorted
    std::vector<IdPair> touching_;                     // the pairs of results_.touching
    std::vector<IdPair> last_touching_, last_passed_;  // of the update before
    std::vector<WorldContact<D>> contacts_;            // of those in results_, the reported ones; sorted
    std::vector<IdPair> began_, stayed_, ended_;
    std::vector<float> fractions_;  // by index in began_
    detail::PairIndex pair_index_;  // over touching_
    UpdateCounts counts_;
    detail::BallEarlyOuts ball_early_outs_;
};

using World2 = World<2>;
using World3 = World<3>;

extern template class World<2>;
extern template class World<3>;

}  // namespace abut
