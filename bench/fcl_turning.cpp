// FCL's continuous collision: conservative advancement along straight ways with even turning. By the GJK of libccd: its
// own one misses nearly all.

#include "each_pair.hpp"
#include "fcl.hpp"
#include "turning.hpp"

#include <csetjmp>
#include <csignal>
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
    bool can_be_asked = true;
};
struct Scene {
    std::vector<Pair> pairs;
};

double ask(const Pair& pair) {
    const fcl::ContinuousCollisionRequestd request(10, 1e-4, fcl::CCDM_LINEAR, fcl::GST_LIBCCD,
                                                   fcl::CCDC_CONSERVATIVE_ADVANCEMENT);
    fcl::ContinuousCollisionResultd result;
    fcl::continuousCollide(&pair.a.box, pair.a.from, pair.a.to, &pair.b.box, pair.b.from, pair.b.to, request, result);
    return result.is_collide ? result.time_of_contact : no_meeting;
}

sigjmp_buf before_asking;

/// An assertion of FCL's own ends the program on about one pair in some thousands; those are not asked again.
bool can_be_asked(const Pair& pair) {
    const auto usual = std::signal(SIGABRT, [](int) { siglongjmp(before_asking, 1); });
    volatile bool ends_well = false;
    if (sigsetjmp(before_asking, 1) == 0) {
        ask(pair);
        ends_well = true;
    }
    std::signal(SIGABRT, usual);
    return ends_well;
}

}  // namespace

Side fcl_turning(const TurningScene<3>& scene) {
    auto own = std::make_shared<Scene>();
    for (const auto& [a, b] : scene.pairs) own->pairs.push_back({Moving(a), Moving(b)});
    for (Pair& pair : own->pairs) pair.can_be_asked = can_be_asked(pair);
    return {"fcl", each_pair(std::shared_ptr<const Scene>(own),
                             [](const Pair& pair, std::size_t) { return pair.can_be_asked ? ask(pair) : no_meeting; })};
}

}  // namespace abut::bench
