#pragma once

// Move and slide: a character controller.

#include <abut/world/world.hpp>

#include <memory>
#include <span>

namespace abut {

/// Lengths are in world units, angles in radians.
template <int D>
struct MoverOptions {
    Vec<D> up = second_axis();  ///< of any length; 0: there is no up (top-down view, water), and no ground
    float step_height = 0.3f;   ///< maximum height of steps and edges that are climbed
    float steepest = 0.87f;     ///< maximum slope angle of ground; steeper slopes are walls
    float stick = 0.3f;         ///< maximum drop per move over which it is snapped down to the ground
    float skin = 0;             ///< gap left to all obstacles, approximately; 0: a hundredth of the shape's size
    Filter filter{};            ///< what it collides with; must exclude the character itself if it is in the world

private:
    static constexpr Vec<D> second_axis() {
        Vec<D> result{};
        result[1] = 1;
        return result;
    }
};

/// A contact of the mover.
template <int D>
struct MoverTouch {
    Id id;
    Feature feature{};        ///< feature of the obstacle
    Vec<D> point{};           ///< point on the obstacle's surface
    Vec<D> normal{};          ///< unit normal of the surface, facing the mover
    bool is_ground = false;   ///< true: the mover can stand on it
    bool overlapped = false;  ///< only for `passes`: the mover overlapped it at the start of the move
};

template <int D>
struct Moved {
    Vec<D> position{};       ///< the new position
    Vec<D> motion{};         ///< the requested motion as far as the contacts allow it; for the velocity
    Vec<D> carried{};        ///< translation by the moving ground, included in `position`
    Vec<D> pushed{};         ///< depenetration push, included in `position`
    bool grounded = false;   ///< stands on ground, or is supported by walls that leave no way down
    MoverTouch<D> ground{};  ///< the ground contact, if grounded
    bool crushed = false;    ///< overlaps something and can't be separated
    /// Contacts at the end and obstacles that stopped it, once each, sorted by id and part; a field appears once for
    /// each of its surface planes. Valid until the next move.
    std::span<const MoverTouch<D>> touches;
};

/// Returns true if the mover passes through the contact, such as a platform from below.
template <int D>
using MoverPasses = FunctionRef<bool(const MoverTouch<D>&)>;

/// A one-way platform: solid from above, passable from below and from the sides. For `passes`.
template <int D>
bool passes_one_way(const MoverTouch<D>& touch, const Vec<D>& up) {
    float rise = 0;
    for (int i = 0; i < D; ++i) rise += touch.normal[i] * up[i];
    return touch.overlapped || rise < 0.5f;
}

/// A character controller; each character needs its own. It remembers the ground, to move with it, and its buffers, so
/// moves don't allocate once warm. A move doesn't change the world.
///
/// A move first follows the ground if that has moved, then separates from what it overlaps. Then it moves by the
/// requested motion, slides along obstacles and around corners, climbs steps, and snaps down to sinking ground. Every
/// translation is swept, so it never ends in an obstacle unless it is crushed. It never moves farther than requested,
/// except for climbing and snapping. A motion with a component along `up` leaves the ground.
///
/// On ground it moves along the slope at the requested speed; the downward component is dropped, so it doesn't creep.
/// Against walls and steep slopes the remaining motion is the nearest one that all contact planes allow at once, so it
/// comes to rest in corners of any angle. Internal edges of the surface cause no ghost collisions, see each_contact.
///
/// In the spirit of b2World_CollideMover and b2SolvePlanes of Box2D 3.1, and of the clipped velocities of Quake.
template <int D>
class Mover {
public:
    explicit Mover(const MoverOptions<D>& options = {});
    ~Mover();
    Mover(Mover&&) noexcept;
    Mover& operator=(Mover&&) noexcept;

    const MoverOptions<D>& options() const { return options_; }
    void set_options(const MoverOptions<D>& options);

    /// Moves a convex shape, given relative to the mover's position. Input that isn't finite trips ABUT_ASSERT and
    /// doesn't move.
    template <Shape S>
    requires(detail::is_convex_view<detail::ViewOf<S>>&& dimension<S> ==
             D) Moved<D> move(const World<D>& world, const S& shape, const Vec<D>& position, const Vec<D>& motion) {
        detail::clear_upper_halves();
        return move_convex(world, view(shape), position, motion, nullptr);
    }
    /// The overload with a filter: `passes` is called for each contact and returns true to pass through it.
    template <Shape S>
    requires(detail::is_convex_view<detail::ViewOf<S>>&& dimension<S> ==
             D) Moved<D> move(const World<D>& world, const S& shape, const Vec<D>& position, const Vec<D>& motion,
                              MoverPasses<D> passes) {
        detail::clear_upper_halves();
        return move_convex(world, view(shape), position, motion, &passes);
    }

private:
    struct Memory;

    Moved<D> move_convex(const World<D>& world, const detail::Convex<D>& shape, const Vec<D>& position,
                         const Vec<D>& motion, const MoverPasses<D>* passes);

    MoverOptions<D> options_;
    std::unique_ptr<Memory> memory_;
};

using Mover2 = Mover<2>;
using Mover3 = Mover<3>;

extern template class Mover<2>;
extern template class Mover<3>;

}  // namespace abut
