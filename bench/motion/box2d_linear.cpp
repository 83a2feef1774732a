// Box2D's shape cast, and its time of impact without rotation.

#include "../each_pair.hpp"
#include "../narrow/box2d_shape.hpp"
#include "linear.hpp"

#include <box2d/b2_distance.h>
#include <box2d/b2_time_of_impact.h>

namespace abut::bench {

namespace {

struct Moving {
    b2ShapeCastInput cast;
    b2TOIInput impact;
    double length;
};
struct Scene {
    explicit Scene(const LinearScene<2>& scene) : shapes(box2d::shapes_of(scene.pairs.shapes)) {
        for (std::size_t i = 0; i < scene.motions.size(); ++i) {
            const auto& [a, b] = scene.pairs.pairs[i];
            const b2Vec2 motion = to_box2d(scene.motions[i]);
            Moving& pair = pairs.emplace_back();
            // The cast moves shape B.
            pair.cast.proxyA.Set(shapes[b.shape].get(), 0);
            pair.cast.proxyB.Set(shapes[a.shape].get(), 0);
            pair.cast.transformA = to_box2d(b.pose);
            pair.cast.transformB = to_box2d(a.pose);
            pair.cast.translationB = motion;
            pair.impact.proxyA = pair.cast.proxyA;
            pair.impact.proxyB = pair.cast.proxyB;
            pair.impact.sweepA = sweep_of(b.pose, b2Vec2(0, 0));
            pair.impact.sweepB = sweep_of(a.pose, motion);
            pair.impact.tMax = 1;
            pair.length = double{motion.Length()};
        }
    }
    static b2Sweep sweep_of(const Pose2& pose, const b2Vec2& motion) {
        b2Sweep result;
        result.localCenter.SetZero();
        result.c0 = to_box2d(pose.position);
        result.c = result.c0 + motion;
        result.a0 = result.a = to_box2d(pose).q.GetAngle();
        result.alpha0 = 0;
        return result;
    }

    std::vector<std::unique_ptr<b2Shape>> shapes;
    std::vector<Moving> pairs;
};

}  // namespace

Side box2d_linear(const LinearScene<2>& scene) {
    return {"box2d", each_pair(std::make_shared<const Scene>(scene), [](const Moving& pair, std::size_t) {
                b2ShapeCastOutput output;
                return b2ShapeCast(&output, &pair.cast) ? double{output.lambda} * pair.length : no_touch;
            })};
}

Side box2d_linear_by_impact(const LinearScene<2>& scene) {
    return {"box2d impact", each_pair(std::make_shared<const Scene>(scene), [](const Moving& pair, std::size_t) {
                b2TOIOutput output;
                b2TimeOfImpact(&output, &pair.impact);
                const bool hit = output.state == b2TOIOutput::e_touching || output.state == b2TOIOutput::e_failed;
                return hit ? double{output.t} * pair.length : no_touch;
            })};
}

}  // namespace abut::bench
