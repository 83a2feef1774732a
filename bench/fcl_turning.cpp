// FCL's continuous collision: conservative advancement along straight ways with even turning.

#include "each_pair.hpp"
#include "fcl.hpp"
#include "turning.hpp"

#include <memory>

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/continuous_collision.h>

namespace abut::bench {

namespace {

struct Moving {
    fcl::Boxd box;
    fcl::Transform3d from, to;

    explicit Moving(const TurningBox<3>& moving)
        : box(2 * to_fcl(moving.box.half)), from(to_fcl(moving.from)), to(to_fcl(moving.to)) {}
};
struct Pair {
    Moving a, b;
};
struct Scene {
    std::vector<Pair> pairs;
};

}  // namespace

Side fcl_turning(const TurningScene<3>& scene) {
    auto own = std::make_shared<Scene>();
    for (const auto& [a, b] : scene.pairs) own->pairs.push_back({Moving(a), Moving(b)});
    const fcl::ContinuousCollisionRequestd request(10, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                   fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    return {"fcl", each_pair(std::shared_ptr<const Scene>(own), [request](const Pair& pair, std::size_t) {
                fcl::ContinuousCollisionResultd result;
                fcl::continuousCollide(&pair.a.box, pair.a.from, pair.a.to, &pair.b.box, pair.b.from, pair.b.to,
                                       request, result);
                return result.is_collide ? result.time_of_contact : no_meeting;
            })};
}

}  // namespace abut::bench
