#include <abut/motion/mover.hpp>
#include <abut/motion/walk.hpp>

namespace abut {
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

/// The cosine; the same bits everywhere.
double least_rise(float steepest) {
    return static_cast<double>(Turn::by(std::clamp(steepest, 0.0f, 1.55f)).cos);
}

}  // namespace

template <int D>
struct Mover<D>::Memory {
    NearSurface<D> near;
    std::vector<MoverTouch<D>> touches;
    // Where it was left standing, and on what, as that was then.
    Id ground;
    Pose<D> ground_pose;
    Vec<D> position{};

    /// How far the ground has taken since what stands at its position.
    Vec<D> ride(const World<D>& world, const Vec<D>& from) const {
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
    const bool finite = is_finite(options.up);
    ABUT_ASSERT(finite);
    options_ = options;
    if (!finite) options_.up = MoverOptions<D>{}.up;
}

template <int D>
Moved<D> Mover<D>::move_convex(const World<D>& world, const Convex<D>& shape, const Vec<D>& position,
                               const Vec<D>& motion, const MoverPasses<D>* passes) {
    Moved<D> result;
    result.position = position;
    const bool finite = is_finite(shape) && is_finite(position) && is_finite(motion);
    ABUT_ASSERT(finite);
    if (!finite) return result;

    Memory& memory = *memory_;
    memory.touches.clear();
    const auto goes_through = [&](const NearContact<D>& contact) { return (*passes)(touch_of(contact)); };
    const Passes<D> asks(goes_through);
    NearSurface<D>& near = memory.near;
    near.begin(world, options_.filter, shape, DVec<D>(position), passes != nullptr ? &asks : nullptr);

    WalkRules<D> rules;
    rules.up = normalized(DVec<D>(options_.up), DVec<D>(0.0));
    rules.step_height = static_cast<double>(options_.step_height);
    rules.stick = static_cast<double>(options_.stick);
    rules.least_rise = least_rise(options_.steepest);
    rules.skin = options_.skin > 0 ? static_cast<double>(options_.skin) : 0.01 * near.size();

    // What it will probably ask about, at once.
    const DVec<D> wanted(motion);
    const DVec<D> ridden(memory.ride(world, position));
    near.expect(ridden + wanted, rules.up * rules.skin, rules.up * -rules.stick, 4 * rules.skin);

    Walk<D> walk(near, rules, DVec<D>(position), memory.touches);
    if (ridden != DVec<D>(0.0)) walk.go_along(ridden);
    result.carried = to_float(walk.at() - DVec<D>(position));
    result.pushed = to_float(walk.get_out());

    const bool walks = dot(wanted, rules.up) <= 1e-6 * length(wanted);
    const bool stood = walks && walk.ground() != nullptr;
    walk.slide(wanted);
    if (stood) walk.stick();

    walk.tell_contacts();
    result.position = to_float(walk.at());
    result.motion = to_float(walk.allowed(wanted));
    result.crushed = walk.depth() > 0.1 * rules.skin;
    memory.ground = {};
    const NearContact<D>* ground = walks ? walk.ground() : nullptr;
    if (ground == nullptr && walks) ground = walk.groove();
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
