// The kinematic character controller: it moves a shape through a world by move and slide, without forces.

#include <abut/math/simd/library_entry.hpp>
#include <abut/motion/mover.hpp>
#include <abut/motion/mover/move_and_slide.hpp>
#include <abut/query/detail/valid_query.hpp>

namespace abut {

using namespace detail;

namespace {

template <int D>
MoverTouch<D> touch_of(const NearContact<D>& contact) {
    MoverTouch<D> result;
    result.id = contact.name.id;
    result.feature = contact.feature;
    result.point = to_float(contact.point);
    result.normal = to_float(contact.normal);
    result.overlapped = contact.overlapped;
    return result;
}

/// The cosine of the slope angle; the same bits on every machine.
double min_rise_for(float steepest) {
    return static_cast<double>(Turn::by(std::clamp(steepest, 0.0f, 1.55f)).cos);
}

}  // namespace

template <int D>
struct Mover<D>::Memory {
    NearbySurface<D> near;
    std::vector<MoverTouch<D>> touches;
    // The ground at the end of the last move, with its pose then, and the mover's position.
    Id ground;
    Pose<D> ground_pose;
    Vec<D> position{};

    /// The translation of the ground since then, at the mover's position.
    Vec<D> carried_by_ground(const World<D>& world, const Vec<D>& from) const {
        if (!ground || from != position || !world.contains(ground)) return Vec<D>(0.0f);
        const Pose<D> now = world.pose(ground);
        if (now == ground_pose) return Vec<D>(0.0f);
        const Affine<D> then = affine(ground_pose);
        const DVec<D> own = then.transposed(DVec<D>(from) - then.offset);
        return to_float(affine(now).point(own) - DVec<D>(from));
    }
};

template <int D>
Mover<D>::Mover(const MoverOptions<D>& options) : memory_(std::make_unique<Memory>()) {
    set_options(options);
}
template <int D>
Mover<D>::~Mover() = default;
template <int D>
Mover<D>::Mover(Mover&&) noexcept = default;
template <int D>
Mover<D>& Mover<D>::operator=(Mover&&) noexcept = default;

template <int D>
void Mover<D>::set_options(const MoverOptions<D>& options) {
    detail::enter_library();
    options_ = options;
    if (!detail::is_valid_query(options.up)) options_.up = MoverOptions<D>{}.up;
}

template <int D>
Moved<D> Mover<D>::move_convex(const World<D>& world, const Convex<D>& shape, const Vec<D>& position,
                               const Vec<D>& motion, const MoverPasses<D>* passes) {
    detail::enter_library();
    Moved<D> result;
    result.position = position;
    if (!detail::is_valid_query(shape, position, motion)) return result;

    Memory& memory = *memory_;
    memory.touches.clear();
    const auto goes_through = [&](const NearContact<D>& contact) { return (*passes)(touch_of(contact)); };
    const Passes<D> filter(goes_through);
    NearbySurface<D>& near = memory.near;
    near.begin(world, options_.filter, shape, DVec<D>(position), passes != nullptr ? &filter : nullptr);

    MoveSettings<D> settings;
    settings.up = normalized(DVec<D>(options_.up), DVec<D>(0.0));
    settings.step_height = static_cast<double>(options_.step_height);
    settings.snap_distance = static_cast<double>(options_.stick);
    settings.min_rise = min_rise_for(options_.steepest);
    settings.skin = options_.skin > 0 ? static_cast<double>(options_.skin) : 0.01 * near.size();

    // The region that the move will probably need.
    const DVec<D> requested(motion);
    const DVec<D> carried(memory.carried_by_ground(world, position));
    near.prefetch(carried + requested, settings.up * settings.skin, settings.up * -settings.snap_distance,
                  4 * settings.skin);

    MoveAndSlide<D> solver(near, settings, DVec<D>(position), memory.touches);
    if (carried != DVec<D>(0.0)) solver.carry(carried);
    result.carried = to_float(solver.at() - DVec<D>(position));
    result.pushed = to_float(solver.separate());

    const bool may_stand = dot(requested, settings.up) <= 1e-6 * length(requested);
    const bool stood_before = may_stand && solver.ground() != nullptr;
    solver.slide(requested);
    if (stood_before) solver.snap_to_ground();

    solver.report_contacts();
    result.position = to_float(solver.at());
    result.motion = to_float(solver.allowed(requested));
    result.crushed = solver.depth() > 0.1 * settings.skin;
    memory.ground = {};
    const NearContact<D>* ground = may_stand ? solver.ground() : nullptr;
    if (ground == nullptr && may_stand) ground = solver.supporting_groove();
    if (ground != nullptr) {
        result.grounded = true;
        result.ground = touch_of(*ground);
        result.ground.is_ground = true;
        memory.ground = ground->name.id;
        memory.ground_pose = world.pose(memory.ground);
    }
    memory.position = result.position;
    result.touches = memory.touches;
    return result;
}

template class Mover<2>;
template class Mover<3>;

}  // namespace abut
