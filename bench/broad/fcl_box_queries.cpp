// Queries of FCL's DynamicAABBTreeCollisionManager.

#include "box_queries.hpp"
#include "broad_peers.hpp"
#include "fcl_boxes.hpp"

#include <cmath>
#include <memory>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>

namespace abut::bench {

namespace {

using Tree = FclBoxes<fcl::DynamicAABBTreeCollisionManagerd>;

struct NearestOfAll {
    Vec3 point;
    Nearest nearest;
};

/// Receives an object and the current search distance, which it may shorten.
bool add_distance(fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* data, double& reach) {
    auto& search = *static_cast<NearestOfAll*>(data);
    // The point is a box without extent; the tree decides which of the two comes first.
    const fcl::AABBd& box = a->getUserData() != nullptr ? a->getAABB() : b->getAABB();
    const Aabb3 found{Vec3(box.min_.x(), box.min_.y(), box.min_.z()), Vec3(box.max_.x(), box.max_.y(), box.max_.z())};
    search.nearest.add(squared_distance(search.point, found));
    reach = std::sqrt(static_cast<double>(search.nearest.farthest()));
    return false;
}

}  // namespace

Side fcl_regions(std::span<const Aabb3> boxes, std::span<const Aabb3> regions) {
    const auto tree = std::make_shared<const Tree>(boxes);
    return each_query("fcl", regions, [tree](const Aabb3& region) {
        std::size_t count = 0;
        tree->manager.collide(fcl_object(region).get(), &count, count_one);
        return static_cast<double>(count);
    });
}

Side fcl_nearest(std::span<const Aabb3> boxes, std::span<const Vec3> points, std::size_t count) {
    const auto tree = std::make_shared<Tree>(boxes);
    for (auto& object : tree->objects) object->setUserData(tree.get());
    const std::shared_ptr<fcl::CollisionObjectd> query = fcl_object({Vec3(0), Vec3(0)});
    return each_query("fcl", points, [tree, query, count](const Vec3& point) {
        move(*query, {point, point});
        NearestOfAll search{point, Nearest(count)};
        tree->manager.distance(query.get(), &search, add_distance);
        return search.nearest.sum_of_distances();
    });
}

}  // namespace abut::bench
