// Box2D's time of impact: bilateral advancement on the separating axes of features.

#include "../box2d.hpp"
#include "../each_pair.hpp"
#include "rotation.hpp"

#include <memory>

#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_time_of_impact.h>

namespace abut::bench {

namespace {

struct Pair {
    b2PolygonShape a, b;
    b2TOIInput input;
};
struct Scene {
    std::vector<Pair> pairs;
};

b2Sweep sweep_of(const RotatingBox<2>& moving) {
    b2Sweep result;
    result.localCenter.SetZero();
    result.c0 = to_box2d(moving.from.position);
    result.c = to_box2d(moving.to.position);
    result.a0 = to_box2d(moving.from).q.GetAngle();
    result.a = result.a0 + moving.turn;
    result.alpha0 = 0;
    return result;
}

}  // namespace

Side box2d_rotation(const RotationScene<2>& scene) {
    auto own = std::make_shared<Scene>();
    own->pairs.resize(scene.pairs.size());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
        Pair& pair = own->pairs[i];
        const auto& [a, b] = scene.pairs[i];
        pair.a.SetAsBox(a.box.half.x, a.box.half.y);
        pair.b.SetAsBox(b.box.half.x, b.box.half.y);
        pair.a.m_radius = pair.b.m_radius = 0;
        pair.input.proxyA.Set(&pair.a, 0);
        pair.input.proxyB.Set(&pair.b, 0);
        pair.input.sweepA = sweep_of(a);
        pair.input.sweepB = sweep_of(b);
        pair.input.tMax = 1;
    }
    return {"box2d", each_pair(std::shared_ptr<const Scene>(own), [](const Pair& pair, std::size_t) {
                b2TOIOutput output;
                b2TimeOfImpact(&output, &pair.input);
                const bool collides = output.state == b2TOIOutput::e_touching || output.state == b2TOIOutput::e_failed;
                return collides ? double{output.t} : no_impact;
            })};
}

}  // namespace abut::bench
