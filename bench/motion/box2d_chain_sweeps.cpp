// Box2D's sweeps at a chain, without a world.

#include "../narrow/box2d_shape.hpp"
#include "chain_sweeps.hpp"

#include <optional>

#include <box2d/b2_chain_shape.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_dynamic_tree.h>
#include <box2d/b2_time_of_impact.h>

namespace abut::bench {

namespace {

struct Scene {
    explicit Scene(const ChainSweeps& sweeps)
        : swept(
              std::visit([](const auto& s) -> std::unique_ptr<b2Shape> { return box2d::shape_of(s); }, sweeps.shape)) {
        std::vector<b2Vec2> points;
        for (const Vec2& point : sweeps.points) points.push_back(to_box2d(point));
        chain.CreateChain(points.data(), static_cast<int32>(points.size()), points.front(), points.back());
        chain.m_radius = 0;
        b2Transform none;
        none.SetIdentity();
        b2AABB own;
        swept->ComputeAABB(&own, none, 0);
        for (int32 i = 0; i < chain.GetChildCount(); ++i) {
            b2AABB box;
            chain.ComputeAABB(&box, none, i);
            box.lowerBound -= own.upperBound;
            box.upperBound -= own.lowerBound;
            const int32 proxy = tree.CreateProxy(box, nullptr);
            if (static_cast<std::size_t>(proxy) >= child_of_proxy.size())
                child_of_proxy.resize(static_cast<std::size_t>(proxy) + 1);
            child_of_proxy[static_cast<std::size_t>(proxy)] = i;
        }
    }

    std::unique_ptr<b2Shape> swept;
    b2ChainShape chain;
    b2DynamicTree tree;
    std::vector<int32> child_of_proxy;
};

/// b2ShapeCast. The cast moves shape B.
struct ByCast {
    b2ShapeCastInput input;

    ByCast(const b2Shape& swept, const b2Vec2& from) {
        input.proxyB.Set(&swept, 0);
        input.transformA.SetIdentity();
        input.transformB.Set(from, 0);
    }
    std::optional<float> fraction(const b2ChainShape& chain, int32 child, const b2Vec2& motion) {
        input.proxyA.Set(&chain, child);
        input.translationB = motion;
        b2ShapeCastOutput output;
        return b2ShapeCast(&output, &input) ? std::optional(output.lambda) : std::nullopt;
    }
};

struct ByImpact {
    b2TOIInput input;

    ByImpact(const b2Shape& swept, const b2Vec2& from) {
        input.proxyB.Set(&swept, 0);
        input.tMax = 1;
        for (b2Sweep* sweep : {&input.sweepA, &input.sweepB}) {
            sweep->localCenter.SetZero();
            sweep->c0 = sweep->c = b2Vec2(0, 0);
            sweep->a0 = sweep->a = sweep->alpha0 = 0;
        }
        input.sweepB.c0 = from;
    }
    std::optional<float> fraction(const b2ChainShape& chain, int32 child, const b2Vec2& motion) {
        input.proxyA.Set(&chain, child);
        input.sweepB.c = input.sweepB.c0 + motion;
        b2TOIOutput output;
        b2TimeOfImpact(&output, &input);
        const bool hit = output.state == b2TOIOutput::e_touching || output.state == b2TOIOutput::e_failed;
        return hit ? std::optional(output.t) : std::nullopt;
    }
};

/// The callback of the tree's ray cast. The motion ends at the first hit known.
template <class Method>
struct FirstHit {
    const Scene& scene;
    Method method;
    b2Vec2 motion;
    std::optional<float> first;

    float RayCastCallback(const b2RayCastInput& input, int32 proxy) {
        const int32 child = scene.child_of_proxy[static_cast<std::size_t>(proxy)];
        const std::optional<float> fraction = method.fraction(scene.chain, child, input.maxFraction * motion);
        if (!fraction) return input.maxFraction;
        first = *fraction * input.maxFraction;
        return *first;
    }
};

template <class Method>
Side sweeps_by(const char* who, const SharedChainSweeps& scene) {
    return {who, [scene, own = std::make_shared<const Scene>(*scene)](std::span<double> values) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    const b2Vec2 from = to_box2d(scene->casts[i].from), motion = to_box2d(scene->casts[i].motion);
                    b2RayCastInput ray;
                    ray.p1 = from;
                    ray.p2 = from + motion;
                    ray.maxFraction = 1;
                    FirstHit<Method> found{*own, Method(*own->swept, from), motion, std::nullopt};
                    own->tree.RayCast(&found, ray);
                    values[i] = found.first ? double{*found.first * motion.Length()} : -1.0;
                }
            }};
}

}  // namespace

Side box2d_chain_sweeps(const SharedChainSweeps& scene) {
    return sweeps_by<ByCast>("box2d", scene);
}
Side box2d_chain_sweeps_by_impact(const SharedChainSweeps& scene) {
    return sweeps_by<ByImpact>("box2d impact", scene);
}

}  // namespace abut::bench
