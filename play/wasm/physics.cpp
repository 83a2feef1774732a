// The small physics engine for the page.

#include "physics.h"

#include "numbers.hpp"

#include <scenes/small_physics.hpp>

using namespace abut::detail;
using abut::play::Numbers;
using abut::scenes::Real;
using abut::scenes::SmallPhysics;

struct abut_play_physics2 : SmallPhysics<2> {};
struct abut_play_physics3 : SmallPhysics<3> {};

namespace {

template <int D>
abut_code create(bool filter_edges, auto** out) {
    return entry({present(out, "out")}, [&] {
        auto made = std::make_unique<std::remove_pointer_t<std::remove_reference_t<decltype(*out)>>>();
        made->world = abut::World<D>({.filter_edges = filter_edges});
        *out = made.release();
    });
}

template <int D>
abut_code add_fixed(SmallPhysics<D>* physics, const ShapeHandle<D>* shape) {
    return entry({present(physics, "physics"), present(shape, "shape")},
                 [&] { physics->add_fixed(shape->shape, abut::Pose<D>()); });
}

glm::dvec2 in_double(const abut::Turn& turn) {
    return std::bit_cast<glm::vec2>(turn);
}
glm::dquat in_double(const glm::quat& rotation) {
    return rotation;
}

template <int D>
abut_code add_box(SmallPhysics<D>* physics, const typename CTypes<D>::Pose& pose, const typename CTypes<D>::Vec& half) {
    return entry({present(physics, "physics"), finite(pose, "pose"), finite(half, "half")}, [&] {
        const auto at = same_bytes<abut::Pose<D>>(pose);
        physics->add_box(Real<D>(at.position), in_double(at.rotation), same_bytes<abut::Vec<D>>(half));
    });
}

template <int D>
abut_code set_velocity(SmallPhysics<D>* physics, std::uint32_t box, const typename CTypes<D>::Vec& velocity) {
    const bool exists = physics != nullptr && box < physics->bodies().size();
    const Fault fault = exists ? Fault() : Fault{ABUT_INDEX_OUT_OF_RANGE, "box", "is no box"};
    return entry({present(physics, "physics"), fault, finite(velocity, "velocity")},
                 [&] { physics->set_velocity(box, Real<D>(same_bytes<abut::Vec<D>>(velocity))); });
}

template <int D>
abut_code step(SmallPhysics<D>* physics, float seconds) {
    const Fault fault = seconds > 0 && seconds <= 1 ? Fault() : Fault{ABUT_BAD_ARGUMENT, "seconds", "is not in (0, 1]"};
    return entry({present(physics, "physics"), fault}, [&] { physics->step(static_cast<double>(seconds)); });
}

template <int D>
abut_code boxes(const SmallPhysics<D>* physics, abut_buffer* out) {
    return entry({present(physics, "physics"), present(out, "out")}, [&] {
        Numbers numbers;
        for (const abut::scenes::Body<D>& body : physics->bodies()) {
            const abut::Pose<D> pose = body.pose();
            numbers.vec<D>(pose.position);
            numbers.rotation(pose.rotation);
            numbers.vec<D>(abut::Vec<D>(body.velocity));
        }
        numbers.write(*out);
    });
}

template <int D>
abut_code contacts(const SmallPhysics<D>* physics, abut_buffer* out) {
    return entry({present(physics, "physics"), present(out, "out")}, [&] {
        Numbers numbers;
        for (const abut::WorldContact<D>& touch : physics->world.contacts())
            for (const abut::ContactPoint<D>& point : touch.contact.points) {
                numbers.vec<D>(point.position);
                // A normal leads from a to b. It is drawn on the item that moves, and of two such on the upper one.
                const bool turned = physics->world.is_fixed(touch.b) ||
                                    (!physics->world.is_fixed(touch.a) && touch.contact.normal.y < 0);
                numbers.vec<D>(turned ? -touch.contact.normal : touch.contact.normal);
                numbers.number(point.depth);
                numbers.number(physics->world.is_fixed(touch.a) || physics->world.is_fixed(touch.b) ? 1.0f : 0.0f);
            }
        numbers.write(*out);
    });
}

template <int D>
abut_code persistence(const SmallPhysics<D>* physics, float* out) {
    return entry({present(physics, "physics"), present(out, "out")}, [&] {
        *out = physics->points() == 0
                   ? 1.0f
                   : static_cast<float>(physics->persistent_points()) / static_cast<float>(physics->points());
    });
}

}  // namespace

#define ABUT_PLAY_PHYSICS(D)                                                                                           \
    abut_code abut_play_physics##D##_create(bool filter_edges, abut_play_physics##D** out) {                           \
        return create<D>(filter_edges, out);                                                                           \
    }                                                                                                                  \
    void abut_play_physics##D##_release(abut_play_physics##D* physics) {                                               \
        delete physics;                                                                                                \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_add_fixed(abut_play_physics##D* physics, const abut_shape##D* shape) {            \
        return add_fixed<D>(physics, shape);                                                                           \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_add_box(abut_play_physics##D* physics, abut_pose##D pose, abut_vec##D half) {     \
        return add_box<D>(physics, pose, half);                                                                        \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_set_velocity(abut_play_physics##D* physics, uint32_t box, abut_vec##D velocity) { \
        return set_velocity<D>(physics, box, velocity);                                                                \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_step(abut_play_physics##D* physics, float seconds) {                              \
        return step<D>(physics, seconds);                                                                              \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_boxes(const abut_play_physics##D* physics, abut_buffer* out) {                    \
        return boxes<D>(physics, out);                                                                                 \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_contacts(const abut_play_physics##D* physics, abut_buffer* out) {                 \
        return contacts<D>(physics, out);                                                                              \
    }                                                                                                                  \
    abut_code abut_play_physics##D##_persistence(const abut_play_physics##D* physics, float* out) {                    \
        return persistence<D>(physics, out);                                                                           \
    }
ABUT_PLAY_PHYSICS(2)
ABUT_PLAY_PHYSICS(3)
#undef ABUT_PLAY_PHYSICS
