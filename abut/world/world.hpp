#pragma once

// A world for games: it keeps shapes by id, tells from update to update who touches whom, and answers questions about
// them all. It moves nothing by itself.

#include <abut/broad_phase/choose_broad_phase.hpp>
#include <abut/math/motion.hpp>
#include <abut/query/closest.hpp>
#include <abut/query/contact.hpp>
#include <abut/query/detail/surface/surface_normal_flags.hpp>
#include <abut/query/raycast.hpp>
#include <abut/shape/any_shape.hpp>
#include <abut/world/bounding_ball.hpp>
#include <abut/world/id.hpp>
#include <abut/world/item_boxes.hpp>
#include <abut/world/placed_views.hpp>
#include <abut/world/pretest.hpp>
#include <abut/world/question_count.hpp>
#include <abut/world/slot_lists.hpp>
#include <abut/world/touching_index.hpp>
#include <abut/world/way.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut {

template <int D>
struct MoverAtHit;
template <int D>
struct ClosestPoint;

/// How a shape takes part in a world.
template <int D>
struct ItemOptions {
    Pose<D> pose{};                   ///< on top of the position that the shape carries itself
    std::uint64_t user = 0;           ///< the game's own, such as an index
    std::uint32_t layers = 1;         ///< the layers it is on, one bit each
    std::uint32_t mask = 0xffffffff;  ///< the layers it pairs with; both sides must agree
    bool fixed = false;               ///< hardly ever moves; two fixed items never pair
    bool sensor = false;              ///< has events and no contacts; queries skip it unless they ask
    bool continuous = false;          ///< however fast, what it meets between two updates is in the events: bullets
};

/// No answer depends on them: for tests and measurements.
struct WorldOptions {
    Pretest pretest = Pretest::measured;
    std::optional<BroadPhaseKind> broad_phase = std::nullopt;  ///< by default, whichever suits
};

/// Which items a question is about.
struct Filter {
    std::uint32_t layers = 0xffffffff;  ///< asks as if on these layers
    std::uint32_t mask = 0xffffffff;    ///< only items on one of these layers
    bool sensors = false;               ///< sensors too
    Id ignore{};                        ///< but for this one, such as the one who asks
    /// But for these as well, such as a vehicle's parts. Compared one by one, so for hundreds a layer is faster. The
    /// ids must last as long as the filter is in use.
    std::span<const Id> ignore_ids{};
};

/// What changed with an update; each sorted. Valid until the next update.
///
/// Where one of two items is continuous, they also begin to touch where they met on the way from where they were at the
/// last update to where they are now, though they may be past one another by then: the position straight, the rotation
/// evenly and the short way. Such a pair that doesn't touch now has no contact, and is among those that ended in the
/// next update whatever happens; where it meets anew, it is among those that began there as well. What was added since
/// the last update, or has a new shape, rests where it is now. A pair that touched at the last update isn't asked for
/// what happened since.
struct Events {
    std::span<const IdPair> began;   ///< touch now and did not before
    std::span<const IdPair> stayed;  ///< touch now and did before
    std::span<const IdPair> ended;   ///< touched before and don't now, also because one was removed
    /// When each of `began` first met, as a fraction of the way since the last update: 1 where that is known of now
    /// alone, as where neither is continuous.
    std::span<const float> fractions;
};

template <int D>
struct WorldContact {
    Id a, b;
    Contact<D> contact;
};

/// How two items met between two updates, as abut::sweep reports it of `a`: the normal faces `a`, the point is where
/// they touched at that moment.
template <int D>
struct WorldImpact {
    Id a, b;
    Hit<D> hit;
};

template <int D>
struct WorldHit {
    Id id;
    Hit<D> hit;
};

template <int D>
struct WorldClosest {
    Id id;
    Closest<D> closest;  ///< from the asking point or shape (A) to the item (B)
};

/// What the last update did.
struct UpdateCounts {
    std::size_t near = 0;  ///< pairs whose boxes overlap, or did on the way of a continuous one, and whose layers agree
    std::size_t tested = 0;  ///< those of them that were looked at again because one of the two had moved
    std::size_t balls = 0;   ///< those of them whose bounding balls were asked and settled it: depends on measurements
};

namespace detail {

/// The arguments of World::sweep without the shape.
template <int D>
struct MotionsInWorld {
    void operator()(const Vec<D>&, const Filter& = {}) const;
    void operator()(const Motion<D>&, const Filter& = {}) const;
    void operator()(const Pose<D>&, const Pose<D>&, const Filter& = {}) const;
};

/// No type for the arguments of World::sweep.
template <int D, class S, class... Motions>
requires(!ShapeIn<S, D> || !std::is_invocable_v<MotionsInWorld<D>, Motions...> ||
         (is_other_point<Motions, D> || ...)) using WhyNoSweepInWorld =
    std::conditional_t<!Shape<S>, this_is_no_shape,
                       std::conditional_t<ShapeIn<S, D>, a_Pose_of_this_dimension_is_needed_here_and_not_a_position,
                                          this_shape_has_another_dimension>>;

}  // namespace detail

/// All lists are sorted by id, and no answer depends on the order in which items were added but for the ids.
/// Questions see every item where it is now, moved since the last update or not; they are const and may run on many
/// threads at once, those that return no list without allocating. The first one after many changes takes them into the
/// broad phases, while others wait for it. A stale id trips ABUT_ASSERT; in release it is
/// ignored.
template <int D>
class World {
public:
    World() = default;
    explicit World(const WorldOptions& options)
        : fixed_(options.broad_phase), moving_(options.broad_phase), pretests_(options.pretest) {}
    World(World&&) noexcept = default;
    World& operator=(World&&) noexcept = default;

    /// Takes a copy of the shape, and of what it refers to. A view, such as `shape` returns, is refused: any_shape
    /// gives one that can be added.
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
    void move(Id id, const Pose<D>& pose) {
        detail::clear_upper_halves();
        move_to(id, pose);
    }
    template <class P, class Why = detail::WhyNoPose<D, P>>
    auto move(Id id, const P& position);
    void set_filter(Id id, std::uint32_t layers, std::uint32_t mask);
    void remove(Id id);

    bool contains(Id id) const;
    std::uint64_t user(Id id) const;
    Pose<D> pose(Id id) const;
    /// The item's shape where it is; valid until it is moved, changed or removed.
    View<D> shape(Id id) const;
    /// The item's shape in its own frame, without the pose, to be kept, stretched or added again: shared, not copied.
    AnyShape<D> any_shape(Id id) const;
    std::size_t size() const { return count_; }

    // What an item was added with, as it is now.
    ItemOptions<D> options(Id id) const;
    std::uint32_t layers(Id id) const;
    std::uint32_t mask(Id id) const;
    bool is_fixed(Id id) const;
    bool is_sensor(Id id) const;
    bool is_continuous(Id id) const;

    // Queries see a change at once. The next update treats a pair as if the item had always been so, so that what still
    // touches has stayed, whatever became of its contact.
    void set_user(Id id, std::uint64_t user);
    /// A pair of two items that are now both fixed ends.
    void set_fixed(Id id, bool fixed);
    /// A pair that touches goes on touching: it loses its contact, or gets one.
    void set_sensor(Id id, bool sensor);
    /// From the last update on: its way since then counts.
    void set_continuous(Id id, bool continuous);

    /// visit(id) for all items, by index; returns nothing, or false to stop. It may change and remove items; those that
    /// it adds may be visited or not.
    template <Visitor<Id> F>
    void each_item(F&& visit) const {
        visit_items(bool_visitor(visit));
    }

    /// Finds who touches whom. Allocates nothing once it has seen a scene of this size. A pair of which neither moved
    /// since the last update isn't looked at again. Now and then looks at a clock, to learn for which types of shapes
    /// it pays to ask their bounding balls first; the events and contacts are the same whatever it finds. Counts how
    /// much moves and how often it is asked, and may change to another broad phase (broad_phase() tells which): that
    /// update takes about twice as long and allocates, and no answer depends on it.
    ///
    /// While any item is continuous, the ways of all that have moved are looked at: what is only put elsewhere then
    /// costs less if it is removed and added.
    Events update() {
        detail::clear_upper_halves();
        return find_events();
    }
    /// As of the last update, of pairs without a sensor, with normals as felt by who touches several: docs/ghosts.md.
    std::span<const WorldContact<D>> contacts() const { return contacts_; }
    /// As of the last update, sorted: how the pairs met that are among those that began and met on their way, because
    /// one of them is continuous. They have one whether they are sensors or not.
    std::span<const WorldImpact<D>> impacts() const { return met_; }
    UpdateCounts counts() const { return counts_; }
    /// Brings the broad phases up to date with all that was added, moved or removed, so that queries cost what they
    /// cost after an update. Queries do not need it; the events and contacts of the next update are the same without
    /// it.
    void refresh() {
        detail::clear_upper_halves();
        refresh_now();
    }
    /// Over the items that move.
    BroadPhaseKind broad_phase() const { return moving_.phase().kind(); }

    /// The items that an item touches as of the last update, sorted, but for those that have been removed since. Pairs
    /// that only met on their way don't touch. Takes time for what it touches, and for finding that among all pairs as
    /// much as a binary search.
    std::vector<Id> touching(Id id) const;
    /// visit(other) in the same order, without allocating; returns nothing, or false to stop.
    template <Visitor<Id> F>
    void each_touching(Id id, F&& visit) const {
        visit_touching(id, bool_visitor(visit));
    }
    /// The contact of a pair as of the last update, from the lower id to the higher; false where it has none: it
    /// doesn't touch, one of the two is a sensor, it only met on its way, or other contacts tell of the same surface
    /// (docs/ghosts.md).
    Contact<D> contact(const IdPair& pair) const;
    /// How a pair met that is among those that began; none where it isn't among `impacts`.
    std::optional<Hit<D>> impact(const IdPair& pair) const;

    /// The first hit, as told at abut::raycast; of equally near ones, the one with the lowest id.
    std::optional<WorldHit<D>> raycast(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return first_hit(ray, filter);
    }
    /// Whether the ray hits anything: stops at what it finds first, such as for a line of sight.
    bool raycast_any(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return any_hit(ray, filter);
    }
    /// The first hit on each item, near to far.
    std::vector<WorldHit<D>> raycast_all(const Ray<D>& ray, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return all_hits(ray, filter);
    }

    /// The first hit of a shape that moves straight, as told at abut::sweep; of equally early ones, the one with the
    /// lowest id. What it touches at the start is hit only if it goes further in.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Vec<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return sweep_straight(seen, motion, filter); });
    }
    /// The same of a shape that turns on the way; it is as it is in the frame that the motion moves.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Motion<D>& motion, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return sweep_turning(seen, motion, filter); });
    }
    /// The same from pose to pose, turning the short way.
    template <detail::ShapeIn<D> S>
    std::optional<WorldHit<D>> sweep(const S& shape, const Pose<D>& from, const Pose<D>& to,
                                     const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return sweep_between(seen, from, to, filter); });
    }
    template <class S, class... Motions, class Why = detail::WhyNoSweepInWorld<D, S, Motions...>>
    auto sweep(const S& shape, const Motions&... motions) const;

    template <detail::ShapeIn<D> S>
    std::optional<WorldClosest<D>> closest(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return closest_to(seen, filter); });
    }
    template <class S, class Why = detail::WhyNotIn<D, S>>
    requires(!detail::PointIn<S, D>) auto closest(const S& shape, const Filter& filter = {}) const;
    std::optional<WorldClosest<D>> closest(const Vec<D>& point, const Filter& filter = {}) const {
        return closest_to(point_view(point), filter);
    }

    /// The items that are closest, up to `out.size()` of them, sorted by distance and then by id; their number.
    /// Distances are signed: of those that overlap the deepest comes first.
    template <detail::ShapeIn<D> S>
    std::size_t k_nearest(const S& shape, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return nearest_to(seen, out, filter); });
    }
    std::size_t k_nearest(const Vec<D>& point, std::span<WorldClosest<D>> out, const Filter& filter = {}) const {
        return nearest_to(point_view(point), out, filter);
    }
    /// Up to k of them, as a list.
    template <detail::ShapeIn<D> S>
    std::vector<WorldClosest<D>> k_nearest(const S& shape, std::size_t k, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return list_of_nearest(seen, k, filter); });
    }
    std::vector<WorldClosest<D>> k_nearest(const Vec<D>& point, std::size_t k, const Filter& filter = {}) const {
        return list_of_nearest(point_view(point), k, filter);
    }

    template <detail::ShapeIn<D> S>
    std::vector<Id> overlapping(const S& shape, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& seen) { return all_overlapping(seen, filter); });
    }
    template <class S, class Why = detail::WhyNotIn<D, S>>
    auto overlapping(const S& shape, const Filter& filter = {}) const;
    /// visit(id), in no order that is promised; returns nothing, or false to stop.
    template <detail::ShapeIn<D> S, Visitor<Id> F>
    void each_overlapping(const S& shape, F&& visit, const Filter& filter = {}) const {
        detail::with_view(shape, [&](const View<D>& seen) { visit_overlapping(seen, filter, bool_visitor(visit)); });
    }
    template <class S, class F, class Why = detail::WhyNotIn<D, S>>
    auto each_overlapping(const S& shape, F&& visit, const Filter& filter = {}) const;
    std::vector<Id> containing(const Vec<D>& point, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        return all_containing(point, filter);
    }

    /// visit(id, shape) for the items whose boxes overlap a box, each shape where it is, in no order that is promised;
    /// returns nothing, or false to stop. For questions that aren't asked here.
    template <Visitor<Id, const View<D>&> F>
    void each_in_box(const Aabb<D>& box, F&& visit, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        visit_in_box(box, filter, bool_visitor(visit));
    }

private:
    static constexpr std::uint32_t no_way = 0xFFFFFFFF;
    /// 88 bytes in space and 72 in the plane: what is asked together lies together.
    struct Item {
        AnyShape<D> stored;  // moved away from a free slot
        std::uint64_t user = 0;
        Pose<D> pose{};
        SmallBall<D> own_ball{};  // in the shape's own frame
        std::uint32_t layers = 1, mask = 0xffffffff;
        std::uint32_t generation = 0;
        std::uint32_t place = 0;        // in fixed_ or moving_
        std::uint32_t course = no_way;  // in courses_; of one that has not moved since the last update, none
        ShapeType type{};
        bool in_use = false;  // else the slot is free
        bool fixed = false, sensor = false, continuous = false;
        bool pending = false;  // changed since the last update
        bool settled = false;  // was there at the last update, with this shape
    };

    /// The contact of a pair that touches.
    struct Found {
        WorldContact<D> told;
        SurfaceNormalFlags felt;  // not, where the contact stands in for a normal that isn't felt
        bool kept = false;        // it is among those that are told
    };

    static View<D> point_view(const Vec<D>& point) {
        detail::clear_upper_halves();
        return View<D>(round_points<D>({point}, 0));
    }

    // The public functions, behind the border to the caller's code.
    Id add_shape(const AnyShape<D>& shape, const ItemOptions<D>& options);
    void move_to(Id id, const Pose<D>& pose);
    Events find_events();
    void refresh_now();
    std::optional<WorldHit<D>> first_hit(const Ray<D>& ray, const Filter& filter) const;
    bool any_hit(const Ray<D>& ray, const Filter& filter) const;
    std::vector<WorldHit<D>> all_hits(const Ray<D>& ray, const Filter& filter) const;
    std::vector<Id> all_containing(const Vec<D>& point, const Filter& filter) const;

    void take(std::uint32_t slot);
    void set_any_shape(Id id, const AnyShape<D>& shape);
    const Item* find(Id id) const;
    Item* find(Id id);
    Id id_of(std::uint32_t slot) const { return {slot + 1, items_[slot].generation}; }
    ItemBoxes<D>& boxes_of(const Item& item) { return item.fixed ? fixed_ : moving_; }
    /// Empty for a free slot, and for an item that is not finite or has no parts.
    const Aabb<D>& box(std::uint32_t slot) const {
        const Item& item = items_[slot];
        return (item.fixed ? fixed_ : moving_).box(item.place);
    }
    View<D> placed(const Item& item) const { return item.stored.moved(affine(item.pose)); }
    Aabb<D> box_at(const Item& item, const Pose<D>& pose) const;
    BoundingBall<D> ball(const Item& item) const;
    const View<D>& first_placed(std::uint32_t slot);
    void visit_items(FunctionRef<bool(Id)> visit) const;
    void visit_touching(Id id, FunctionRef<bool(Id)> visit) const;
    void place(std::uint32_t slot);
    void mark_pending(std::uint32_t slot);
    bool asked(std::uint32_t slot, const Filter& filter) const;

    void refresh_boxes();
    bool has_way(std::uint32_t slot) const;
    void widen_boxes();
    Way<D> way_of(std::uint32_t slot) const;
    bool come_near(std::uint32_t slot, std::uint32_t other) const;
    void consider(std::uint32_t slot, std::uint32_t other);
    void look_at(const IdPair& pair);
    bool touch_now(const IdPair& pair);
    void look_between(const IdPair& pair, bool touch);
    std::optional<Hit<D>> sweep_pair(std::uint32_t slot, std::uint32_t other) const;
    void repeat_last(const IdPair& pair);
    bool balls_apart(const IdPair& pair) const;
    bool shapes_touch(const IdPair& pair);
    bool measure(const IdPair& pair, Pretests::Entry& entry);
    bool feels(std::uint32_t slot) const;
    bool are_solid(std::uint32_t slot, std::uint32_t other) const;
    void find_partners();
    bool is_disturbed(const IdPair& pair) const;
    void each_foot_beside(std::uint32_t slot, std::uint32_t other, const DVec<D>& point, double within,
                          FunctionRef<double(const ClosestPoint<D>&)> visit);
    bool find_contact(const IdPair& pair);
    static Found* find_found(std::vector<Found>& list, const IdPair& pair);
    bool is_told(const Found& ghost, const Id& feeler) const;
    void tell_contacts();
    void compare_with_last();
    void tell_fractions();

    template <class F>
    void each_near(const Aabb<D>& box, const Filter& filter, F&& visit) const;
    template <class F>
    void each_near_ray(const Ray<D>& ray, const Filter& filter, F&& visit) const;
    template <class F>
    std::optional<WorldHit<D>> first_on_way(const View<D>& shape, const Way<D>& way, const Filter& filter,
                                            F&& sweep_at) const;
    void feel(const MoverAtHit<D>& mover, const Filter& filter, WorldHit<D>& hit) const;
    std::optional<WorldHit<D>> sweep_straight(const View<D>& shape, const Vec<D>& motion, const Filter& filter) const;
    std::optional<WorldHit<D>> sweep_turning(const View<D>& shape, const Motion<D>& motion, const Filter& filter) const;
    std::optional<WorldHit<D>> sweep_between(const View<D>& shape, const Pose<D>& from, const Pose<D>& to,
                                             const Filter& filter) const;
    std::optional<WorldClosest<D>> closest_to(const View<D>& shape, const Filter& filter) const;
    std::size_t nearest_to(const View<D>& shape, std::span<WorldClosest<D>> out, const Filter& filter) const;
    std::vector<WorldClosest<D>> list_of_nearest(const View<D>& shape, std::size_t k, const Filter& filter) const;
    std::vector<Id> all_overlapping(const View<D>& shape, const Filter& filter) const;
    void visit_overlapping(const View<D>& shape, const Filter& filter, FunctionRef<bool(Id)> visit) const;
    void visit_in_box(const Aabb<D>& box, const Filter& filter, FunctionRef<bool(Id, const View<D>&)> visit) const;

    std::vector<Item> items_;
    std::vector<Pose<D>> courses_;  // where items that have moved were at the last update
    std::vector<Way<D>> ways_;      // the same in boxes, which hold what turns; in an update with continuous items
    std::vector<std::uint32_t> free_;
    std::vector<std::uint32_t> pending_;
    bool widened_ = false;  // the broad phases have boxes around the ways of what has moved
    std::size_t count_ = 0, continuous_ = 0;

    ItemBoxes<D> fixed_, moving_;
    mutable QuestionCount asked_;  // since the last update
    double often_asked_ = 0;       // from update to update of late, for each item that moves

    std::vector<IdPair> near_, last_near_;
    /// An item that pairs with another, and whose box overlaps that one's.
    struct Partner {
        Aabb<D> box;
        std::uint32_t slot;
    };
    SlotLists<Partner> partners_;             // of the items that have surface normals of others
    SlotLists<std::uint32_t> found_of_;       // places in found_, in an update with contacts that stand in for others
    PlacedViews<D> views_;                    // in an update
    std::vector<char> disturbed_;             // by slot: something near it isn't as it was at the last update
    std::vector<IdPair> touching_, touched_;  // now and at the last update
    std::vector<Found> found_, last_found_;
    std::vector<WorldContact<D>> contacts_;
    std::vector<WorldImpact<D>> met_;           // of continuous ones that didn't touch at the last update
    std::vector<IdPair> passed_, last_passed_;  // those of them that don't touch now; the same at the last update
    std::vector<IdPair> began_, stayed_, ended_;
    std::vector<float> fractions_;  // by place in began_
    TouchingIndex touching_index_;  // of touching_
    UpdateCounts counts_;
    Pretests pretests_;
    /// The first shape of the pair that was looked at last: pairs are sorted.
    struct {
        std::uint32_t slot = no_way;
        View<D> view;
    } first_;
};

using World2 = World<2>;
using World3 = World<3>;

extern template class World<2>;
extern template class World<3>;

}  // namespace abut
