// Box2D's world: a step of no duration moves nothing, but finds all pairs and their contacts.

#include "../box2d.hpp"
#include "crowd.hpp"

#include <box2d/b2_body.h>
#include <box2d/b2_circle_shape.h>
#include <box2d/b2_contact.h>
#include <box2d/b2_fixture.h>
#include <box2d/b2_polygon_shape.h>
#include <box2d/b2_world.h>

namespace abut::bench {

namespace {

struct Shaken {
    explicit Shaken(const Crowd<2>& items) : shaken(items) {
        for (std::size_t i = 0; i < items.items.size(); ++i) {
            const auto& item = items.items[i];
            b2BodyDef body;
            body.type = item.fixed ? b2_staticBody : b2_dynamicBody;
            body.allowSleep = false;
            body.position = to_box2d(shaken.poses[i].position);
            body.angle = angle(shaken.poses[i]);
            bodies.push_back(world.CreateBody(&body));
            std::visit([&](const auto& shape) { add(shape); }, item.shape);
        }
    }
    static float angle(const Pose2& pose) { return std::atan2(pose.rotation.sin, pose.rotation.cos); }
    void add(const Circle& circle) {
        b2CircleShape shape;
        shape.m_radius = circle.radius;
        bodies.back()->CreateFixture(&shape, 1);
    }
    void add(const Box2& box) {
        b2PolygonShape shape;
        shape.SetAsBox(box.half.x, box.half.y);
        shape.m_radius = 0;
        bodies.back()->CreateFixture(&shape, 1);
    }
    /// Box2D has no capsules.
    void add(const Capsule2&) {}

    ShakenCrowd<2> shaken;
    b2World world{b2Vec2(0, 0)};
    std::vector<b2Body*> bodies;
};

}  // namespace

Side box2d_world(const Crowd<2>& crowd) {
    const auto state = std::make_shared<Shaken>(crowd);
    const auto run = [state](std::span<double> values) {
        for (std::size_t i = 0; i < state->bodies.size(); ++i)
            if (!state->shaken.crowd.items[i].fixed)
                state->bodies[i]->SetTransform(to_box2d(state->shaken.poses[i].position),
                                               Shaken::angle(state->shaken.poses[i]));
        state->world.Step(0, 1, 1);
        std::size_t touching = 0;
        for (const b2Contact* contact = state->world.GetContactList(); contact != nullptr; contact = contact->GetNext())
            touching += contact->IsTouching() ? 1u : 0u;
        values[0] = static_cast<double>(touching);
    };
    return {"box2d", run, [state] { state->shaken.shake(); }};
}

}  // namespace abut::bench
