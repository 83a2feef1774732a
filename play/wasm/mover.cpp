// The character controller for the page.

#include "mover.h"

#include "numbers.hpp"
#include <abut/c/detail/answers.hpp>
#include <abut/motion/mover.hpp>

using namespace abut::detail;

namespace {

template <int D>
struct Character {
    abut::Mover<D> mover;
    std::vector<abut::MoverTouch<D>> touches{};
};

}  // namespace

struct abut_play_mover2 : Character<2> {};
struct abut_play_mover3 : Character<3> {};

namespace {

template <int D>
abut_code create(const abut_play_mover_options& options, auto** out) {
    using Handle = std::remove_pointer_t<std::remove_reference_t<decltype(*out)>>;
    return entry({present(out, "out"), finite(options, "options")}, [&] {
        const abut::MoverOptions<D> own{
            .step_height = options.step_height, .steepest = options.steepest, .stick = options.stick};
        *out = new Handle{{.mover = abut::Mover<D>(own)}};
    });
}

template <int D>
abut_code move(Character<D>* mover, const WorldHandle<D>* world, const ShapeHandle<D>* shape,
               const typename CTypes<D>::Vec& position, const typename CTypes<D>::Vec& motion, auto* moved) {
    return entry({present(mover, "mover"), present(world, "world"), present(shape, "shape"),
                  finite(position, "position"), finite(motion, "motion"), present(moved, "moved")},
                 [&]() -> abut_code {
                     const abut::View<D> view = shape->shape.view();
                     const auto* convex = std::get_if<Convex<D>>(&view);
                     if (convex == nullptr) return report(Fault{ABUT_WRONG_SHAPE, "shape", "is not convex"});
                     const abut::Moved<D> result = mover->mover.move(
                         world->world, *convex, same_bytes<abut::Vec<D>>(position), same_bytes<abut::Vec<D>>(motion));
                     mover->touches.assign(result.touches.begin(), result.touches.end());
                     *moved = {.position = to_c<D>(result.position),
                               .motion = to_c<D>(result.motion),
                               .ground_normal = to_c<D>(result.ground.normal),
                               .ground = to_c(result.ground.id),
                               .grounded = result.grounded,
                               .crushed = result.crushed};
                     return ABUT_OK;
                 });
}

template <int D>
abut_code touches(const Character<D>* mover, abut_buffer* out) {
    return entry({present(mover, "mover"), present(out, "out")}, [&] {
        abut::play::Numbers numbers;
        for (const abut::MoverTouch<D>& touch : mover->touches) {
            numbers.vec<D>(touch.point);
            numbers.vec<D>(touch.normal);
            numbers.number(touch.is_ground ? 1.0f : 0.0f);
        }
        numbers.write(*out);
    });
}

}  // namespace

#define ABUT_PLAY_MOVER(D)                                                                                    \
    abut_code abut_play_mover##D##_create(abut_play_mover_options options, abut_play_mover##D** out) {        \
        return create<D>(options, out);                                                                       \
    }                                                                                                         \
    void abut_play_mover##D##_release(abut_play_mover##D* mover) {                                            \
        delete mover;                                                                                         \
    }                                                                                                         \
    abut_code abut_play_mover##D##_move(abut_play_mover##D* mover, const abut_world##D* world,                \
                                        const abut_shape##D* shape, abut_vec##D position, abut_vec##D motion, \
                                        abut_play_moved##D* moved) {                                          \
        return move<D>(mover, world, shape, position, motion, moved);                                         \
    }                                                                                                         \
    abut_code abut_play_mover##D##_touches(const abut_play_mover##D* mover, abut_buffer* out) {               \
        return touches<D>(mover, out);                                                                        \
    }
ABUT_PLAY_MOVER(2)
ABUT_PLAY_MOVER(3)
#undef ABUT_PLAY_MOVER
