// FCL's mesh with a tree of oriented boxes and spheres, in double as Debian builds it.

#include "../fcl.hpp"
#include "levels.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/collision.h>

namespace abut::bench {

namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

struct FclLevel {
    explicit FclLevel(const LevelScene& scene) : model(std::make_shared<Model>()) {
        model->beginModel(static_cast<int>(scene.triangles.size()), static_cast<int>(scene.points.size()));
        std::vector<fcl::Vector3d> points;
        for (const Vec3& point : scene.points) points.push_back(to_fcl(point));
        std::vector<fcl::Triangle> triangles;
        for (const glm::uvec3& t : scene.triangles) triangles.emplace_back(t.x, t.y, t.z);
        model->addSubModel(points, triangles);
        model->endModel();
        own_frame = fcl::Transform3d::Identity();
        if (const auto* box = std::get_if<Box3>(&scene.shape)) {
            shape = std::make_shared<fcl::Boxd>(2 * to_fcl(box->half));
        } else {
            const Capsule3& capsule = std::get<Capsule3>(scene.shape);
            shape = std::make_shared<fcl::Capsuled>(capsule.radius, capsule.b.y - capsule.a.y);
            // FCL's capsules are along z.
            own_frame.linear() << 1, 0, 0, 0, 0, 1, 0, -1, 0;
        }
        for (const Pose3& pose : scene.poses) poses.push_back(to_fcl(pose) * own_frame);
    }

    /// The count of triangles touched, at most `max_contacts`.
    std::size_t touched(std::size_t i, std::size_t max_contacts, bool with_places) {
        const fcl::CollisionRequestd request(max_contacts, with_places);
        result.clear();
        return fcl::collide<double>(model.get(), fcl::Transform3d::Identity(), shape.get(), poses[i], request, result);
    }

    fcl::CollisionResultd result;  ///< its memory is reused
    std::shared_ptr<Model> model;
    std::shared_ptr<fcl::CollisionGeometryd> shape;
    fcl::Transform3d own_frame;
    std::vector<fcl::Transform3d> poses;
};

/// More than any scene has.
constexpr std::size_t all = 1000000;

Side touching(const SharedLevelScene& scene, std::size_t max_contacts, bool with_places) {
    return {"fcl", [level = std::make_shared<FclLevel>(*scene), max_contacts, with_places](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i)
                    values[i] = static_cast<double>(level->touched(i, max_contacts, with_places));
            }};
}

}  // namespace

Side fcl_level_overlaps(const SharedLevelScene& scene) {
    return touching(scene, 1, false);
}
Side fcl_level_contacts(const SharedLevelScene& scene) {
    return touching(scene, all, true);
}
Side fcl_level_touched(const SharedLevelScene& scene) {
    return touching(scene, all, false);
}

}  // namespace abut::bench
