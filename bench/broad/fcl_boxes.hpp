#pragma once

// Boxes in FCL's broad phases, in double as Debian builds it.

#include "../fcl.hpp"
#include <abut/math/aabb.hpp>

#include <memory>
#include <span>
#include <vector>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision_object.h>

namespace abut::bench {

/// Moves an object made for a box of the same size.
inline void move(fcl::CollisionObjectd& object, const Aabb3& box) {
    object.setTranslation(0.5 * (to_fcl(box.min) + to_fcl(box.max)));
    object.computeAABB();
}

inline std::unique_ptr<fcl::CollisionObjectd> fcl_object(const Aabb3& box) {
    auto result =
        std::make_unique<fcl::CollisionObjectd>(std::make_shared<fcl::Boxd>(to_fcl(box.max) - to_fcl(box.min)));
    move(*result, box);
    return result;
}

/// A broad phase of FCL, with the data it refers to.
template <class Manager>
struct FclBoxes {
    explicit FclBoxes(std::span<const Aabb3> boxes) {
        for (const Aabb3& box : boxes) {
            objects.push_back(fcl_object(box));
            pointers.push_back(objects.back().get());
        }
        build();
    }

    void build() {
        manager.clear();
        manager.registerObjects(pointers);
        manager.setup();
    }

    std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects;
    std::vector<fcl::CollisionObjectd*> pointers;
    Manager manager;
};

/// The managers store the exact boxes: reported pairs overlap.
inline bool count_one(fcl::CollisionObjectd*, fcl::CollisionObjectd*, void* count) {
    ++*static_cast<std::size_t*>(count);
    return false;
}

}  // namespace abut::bench
