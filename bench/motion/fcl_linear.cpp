// FCL's continuous collision of boxes without rotation: conservative advancement with libccd's GJK.

#include "../each_pair.hpp"
#include "../fcl.hpp"
#include "linear.hpp"

#include <memory>
#include <variant>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/continuous_collision.h>

namespace abut::bench {

namespace {

struct Moving {
    fcl::Boxd a, b;
    fcl::Transform3d from, to, there;
    double length;
};
struct Scene {
    std::vector<Moving> pairs;
};

}  // namespace

Side fcl_linear(const LinearScene<3>& scene) {
    auto own = std::make_shared<Scene>();
    for (std::size_t i = 0; i < scene.motions.size(); ++i) {
        const auto& [a, b] = scene.pairs.pairs[i];
        const auto box = [&](std::size_t shape) {
            return fcl::Boxd(2 * to_fcl(std::get<Box3>(scene.pairs.shapes[shape]).half));
        };
        const fcl::Transform3d from = to_fcl(a.pose);
        fcl::Transform3d to = from;
        const fcl::Vector3d motion = to_fcl(scene.motions[i]);
        to.translation() += motion;
        own->pairs.push_back({box(a.shape), box(b.shape), from, to, to_fcl(b.pose), motion.norm()});
    }
    return {"fcl", each_pair(std::shared_ptr<const Scene>(own), [](const Moving& pair, std::size_t) {
                const fcl::ContinuousCollisionRequestd request(10, 1e-4, fcl::CCDM_TRANS, fcl::GST_LIBCCD,
                                                               fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
                fcl::ContinuousCollisionResultd result;
                fcl::continuousCollide(&pair.a, pair.from, pair.to, &pair.b, pair.there, pair.there, request, result);
                return result.is_collide ? result.time_of_contact * pair.length : no_touch;
            })};
}

}  // namespace abut::bench
