#pragma once

// What a world stores of an item.

#include <abut/shape/any_shape.hpp>
#include <abut/world/detail/bounding_ball.hpp>
#include <abut/world/options.hpp>

namespace abut::detail {

/// 96 bytes in 3D and 80 in 2D: members that are read together lie together.
template <int D>
struct WorldItem {
    static constexpr std::uint32_t none = 0xFFFFFFFF;

    AnyShape<D> stored;  ///< empty in a free slot
    std::uint64_t user = 0;
    Pose<D> pose{};
    SmallBall<D> local_ball{};  ///< in the shape's own frame
    std::uint32_t generation = 0;
    std::uint32_t place = 0;        ///< of its box among the fixed or the moving ones
    std::uint32_t previous = none;  ///< the index of the pose at the last update; none if not moved since
    std::uint64_t layers = 1, mask = ~std::uint64_t{0};
    std::int32_t group = 0;
    ShapeType type{};
    bool in_use : 1 = false;  ///< false if the slot is free
    bool fixed : 1 = false, sensor : 1 = false, continuous : 1 = false, enabled : 1 = true;
    bool pending : 1 = false;           ///< changed since the last update
    bool pending_in_box : 1 = false;    ///< then in one place alone: World::changed_boxes_
    bool settled : 1 = false;           ///< present at the last update with this shape
    bool ball_is_centered : 1 = false;  ///< the ball is about the origin of that frame: no rotation moves it

    ItemOptions<D> options() const { return {pose, user, layers, mask, fixed, sensor, continuous, group, enabled}; }
    void set(const ItemOptions<D>& options) {
        pose = options.pose;
        user = options.user;
        layers = options.layers;
        mask = options.mask;
        fixed = options.fixed;
        sensor = options.sensor;
        continuous = options.continuous;
        group = options.group;
        enabled = options.enabled;
    }
    /// With the margin of queries; empty if the item is not enabled.
    Aabb<D> bounds() const { return enabled ? stored.bounds_for_queries(pose) : Aabb<D>::empty(); }
    /// Whether the two are one item that differs in nothing but the pose.
    bool is_same_but_for_pose(const WorldItem& other) const {
        return generation == other.generation && stored.is_shared_with(other.stored) && user == other.user &&
               layers == other.layers && mask == other.mask && group == other.group && fixed == other.fixed &&
               sensor == other.sensor && continuous == other.continuous && enabled == other.enabled;
    }
    /// Whether the two pair by their types, groups and layers.
    bool may_pair(const WorldItem& other) const {
        if (type == ShapeType::half_space && other.type == ShapeType::half_space) return false;
        if (group != 0 && group == other.group) return group > 0;
        return (layers & other.mask) != 0 && (other.layers & mask) != 0;
    }
};

}  // namespace abut::detail
