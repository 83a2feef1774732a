#pragma once

// A collision world whose positions are doubles, for planets and long journeys.

#include <abut/world/world.hpp>

#include <optional>
#include <span>
#include <vector>

namespace abut {

/// An answer of a LargeWorld. Its points are relative to `origin`.
template <class Answer, int D>
struct Relative : Answer {
    detail::DVec<D> origin{0.0};

    /// The position in the world of a point of the answer.
    detail::DVec<D> in_world(const Vec<D>& point) const { return origin + detail::DVec<D>(point); }
};
/// Relative to the origin of the ray, or to the position of the shape or point, at the start of its motion.
template <int D>
using LargeHit = Relative<WorldHit<D>, D>;
template <int D>
using LargeClosest = Relative<WorldClosest<D>, D>;

/// A World whose items and queries have positions in double. What it answers at any distance from the origin is, bit by
/// bit, what it answers at the origin if all positions differ by one offset that is added to them without rounding.
/// Only `counts` may differ, by the rounding of boxes. Points of answers are relative to a position nearby, in float;
/// `in_world` returns them in double.
///
/// Shapes are floats in their own frames. Two items are placed relative to each other in double; in a motion with
/// rotation, and in that of a continuous item, in float. An item takes 8 * D bytes more than in a World, and as many if
/// it moved. There is no History of this world and no recording, and it takes queries one at a time.
template <int D>
class LargeWorld : private World<D> {
    using Floats = World<D>;
    using DVec = detail::DVec<D>;

public:
    using Floats::any_shape, Floats::broad_phase, Floats::contact, Floats::contacts, Floats::contains, Floats::counts,
        Floats::each_contact_of, Floats::each_item, Floats::each_touching, Floats::edit_shape, Floats::group,
        Floats::impact, Floats::impacts, Floats::is_continuous, Floats::is_enabled, Floats::is_fixed, Floats::is_sensor,
        Floats::layers, Floats::mask, Floats::refresh, Floats::remove, Floats::set_continuous, Floats::set_enabled,
        Floats::set_filter, Floats::set_fixed, Floats::set_group, Floats::set_pair_filter, Floats::set_sensor,
        Floats::set_shape, Floats::set_user, Floats::size, Floats::touching, Floats::update, Floats::user;

    explicit LargeWorld(const WorldOptions& options = {}) : Floats(options) {}

    /// As World::add, at a pose, which takes the place of `options.pose`.
    template <Ownable S>
    requires(dimension<S> == D) Id add(const S& shape, const PoseD<D>& pose, const ItemOptions<D>& options = {}) {
        const AnyShape<D> stored(shape);
        detail::clear_upper_halves();
        return add_at(stored, pose, options);
    }
    void move(Id id, const PoseD<D>& pose);
    void move(std::span<const Id> ids, std::span<const PoseD<D>> poses);
    PoseD<D> pose(Id id) const;

    /// The position in the world of a point of a contact or impact of the last update, which is relative to the
    /// position that its item `a` had then. The item must still be there.
    DVec in_world(Id a, const Vec<D>& point) const;

    /// As World::save and World::restore, with 8 * D bytes more for an item and for a motion. A snapshot of a World is
    /// a Problem.
    std::vector<std::byte> save();
    std::optional<Problem> restore(std::span<const std::byte> bytes);

    // The queries of a World. A shape is moved from its own frame to a pose.

    std::optional<LargeHit<D>> raycast(const RayD<D>& ray, const Filter& filter = {}) const;
    bool raycast_any(const RayD<D>& ray, const Filter& filter = {}) const;
    std::vector<LargeHit<D>> raycast_all(const RayD<D>& ray, const Filter& filter = {}) const;

    template <detail::ShapeIn<D> S>
    std::optional<LargeHit<D>> sweep(const S& shape, const PoseD<D>& from, const Vec<D>& motion,
                                     const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_by(own, from, motion, filter); });
    }
    /// With rotation along the shorter arc.
    template <detail::ShapeIn<D> S>
    std::optional<LargeHit<D>> sweep(const S& shape, const PoseD<D>& from, const PoseD<D>& to,
                                     const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return sweep_to(own, from, to, filter); });
    }

    std::optional<LargeClosest<D>> closest(const DVec& point, const Filter& filter = {}) const;
    template <detail::ShapeIn<D> S>
    std::optional<LargeClosest<D>> closest(const S& shape, const PoseD<D>& pose, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return closest_at(own, pose, filter); });
    }

    template <detail::ShapeIn<D> S>
    std::vector<Id> overlapping(const S& shape, const PoseD<D>& pose, const Filter& filter = {}) const {
        return detail::with_view(shape, [&](const View<D>& own) { return overlapping_at(own, pose, filter); });
    }
    std::vector<Id> containing(const DVec& point, const Filter& filter = {}) const;
    /// Calls visit(id, contact), with points relative to the position of the pose.
    template <detail::ShapeIn<D> S, detail::Visitor<Id, const Contact<D>&> F>
    void each_contact(const S& shape, const PoseD<D>& pose, F&& visit, const Filter& filter = {},
                      const QueryOptions<D>& options = {}) const {
        detail::with_view(shape, [&](const View<D>& own) {
            each_contact_at(own, pose, filter, options, detail::bool_visitor(visit));
        });
    }
    /// Calls visit(id, shape) for the items whose AABBs overlap a box about a position; the shapes are about it too.
    template <detail::Visitor<Id, const View<D>&> F>
    void each_in_box(const DVec& position, const Aabb<D>& box, F&& visit, const Filter& filter = {}) const {
        detail::clear_upper_halves();
        each_in_box_at(position, box, filter, detail::bool_visitor(visit));
    }

private:
    Id add_at(const AnyShape<D>& shape, const PoseD<D>& pose, const ItemOptions<D>& options);
    void set_pose(Id id, const PoseD<D>& pose);
    std::optional<LargeHit<D>> sweep_by(const View<D>& shape, const PoseD<D>& from, const Vec<D>& motion,
                                        const Filter& filter) const;
    std::optional<LargeHit<D>> sweep_to(const View<D>& shape, const PoseD<D>& from, const PoseD<D>& to,
                                        const Filter& filter) const;
    std::optional<LargeClosest<D>> closest_at(const View<D>& shape, const PoseD<D>& pose, const Filter& filter) const;
    std::vector<Id> overlapping_at(const View<D>& shape, const PoseD<D>& pose, const Filter& filter) const;
    void each_contact_at(const View<D>& shape, const PoseD<D>& pose, const Filter& filter,
                         const QueryOptions<D>& options, FunctionRef<bool(Id, const Contact<D>&)> visit) const;
    void each_in_box_at(const DVec& position, const Aabb<D>& box, const Filter& filter,
                        FunctionRef<bool(Id, const View<D>&)> visit) const;
};
using LargeWorld2 = LargeWorld<2>;
using LargeWorld3 = LargeWorld<3>;

extern template class LargeWorld<2>;
extern template class LargeWorld<3>;

}  // namespace abut
