#pragma once

// Move and slide: a character that walks through a world.

#include <abut/world/world.hpp>

#include <memory>
#include <span>

namespace abut {

/// Lengths are of the world, angles in radians.
template <int D>
struct MoverOptions {
    Vec<D> up = second_axis();  ///< of any length; 0: there is none, such as seen from above or in water, and no ground
    float step_height = 0.3f;   ///< steps and edges up to so high are climbed
    float steepest = 0.87f;     ///< slopes that rise by at most this angle are ground; what is steeper is a wall
    float stick = 0.3f;         ///< on its way it is kept to ground that sinks by up to so much, for each move
    float skin = 0;             ///< the gap that it keeps to all things, about; 0: a hundredth of the shape's size
    Filter filter{};            ///< what it meets; the character itself, if it is in the world, is to be ignored

private:
    static constexpr Vec<D> second_axis() {
        Vec<D> result{};
        result[1] = 1;
        return result;
    }
};

/// What it meets: where, and how.
template <int D>
struct MoverTouch {
    Id id;
    Feature feature{};        ///< of what is met
    Vec<D> point{};           ///< on its surface
    Vec<D> normal{};          ///< of length 1, facing the mover, as the surface is felt
    bool is_ground = false;   ///< it can be stood on
    bool overlapped = false;  ///< told to `passes` alone: the mover was in it at the start of the move
};

template <int D>
struct Moved {
    Vec<D> position{};  ///< where it is now
    Vec<D> motion{};    ///< what is left of the motion that was asked for, as all that touches allows: for the velocity
    Vec<D> carried{};   ///< how far the ground took it along before that, in `position`
    Vec<D> pushed{};    ///< how far it was pushed out of what it was in, in `position`
    bool grounded = false;   ///< stands on something, or is held up by walls that leave no way down
    MoverTouch<D> ground{};  ///< if grounded: on what
    bool crushed = false;    ///< is in something, and there is no way out
    /// What it touches and what it ran against, once each, sorted by id and part; a field once for each of its sides.
    /// Valid until the next move.
    std::span<const MoverTouch<D>> touches;
};

/// Whether the mover goes through what it meets, such as a platform from below.
template <int D>
using MoverPasses = FunctionRef<bool(const MoverTouch<D>&)>;

/// A platform that is stood on, and passed from below and from the sides. For `passes`.
template <int D>
bool passes_one_way(const MoverTouch<D>& touch, const Vec<D>& up) {
    float rise = 0;
    for (int i = 0; i < D; ++i) rise += touch.normal[i] * up[i];
    return touch.overlapped || rise < 0.5f;
}

/// One for each character: it remembers the ground, to ride on it, and keeps its memory, so that moves don't allocate
/// once warm. A move looks at the world as it is, and changes nothing in it.
///
/// What a move does: it goes along with the ground if that has moved since; gets out of what it is in; then goes the
/// way asked, slides along what it meets and around corners, climbs steps, and goes down to ground that sinks. Every
/// way it goes has been swept, so that it never ends in anything, unless it is crushed. It never goes farther than
/// asked, but for climbing and sinking. A motion with a part along `up` leaves the ground.
///
/// On ground it goes along the slope at the speed asked, and what pulls it down is left out: it doesn't creep. Against
/// a wall, or a slope that is too steep, what is left of the motion is the nearest one that all planes of contact
/// allow at once, so it comes to rest in corners of any angle and stays there. What it slides over has no seams, see
/// each_contact.
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

    /// Moves a convex shape, which is about the mover's position. What is not finite trips ABUT_ASSERT and stays where
    /// it is.
    template <Shape S>
    requires(detail::is_convex_view<detail::ViewOf<S>>&& dimension<S> ==
             D) Moved<D> move(const World<D>& world, const S& shape, const Vec<D>& position, const Vec<D>& motion) {
        return move_convex(world, view(shape), position, motion, nullptr);
    }
    /// The same where `passes` is asked whether what it meets is passed.
    template <Shape S>
    requires(detail::is_convex_view<detail::ViewOf<S>>&& dimension<S> ==
             D) Moved<D> move(const World<D>& world, const S& shape, const Vec<D>& position, const Vec<D>& motion,
                              MoverPasses<D> passes) {
        return move_convex(world, view(shape), position, motion, &passes);
    }

private:
    struct Memory;

    Moved<D> move_convex(const World<D>& world, const Convex<D>& shape, const Vec<D>& position, const Vec<D>& motion,
                         const MoverPasses<D>* passes);

    MoverOptions<D> options_;
    std::unique_ptr<Memory> memory_;
};

using Mover2 = Mover<2>;
using Mover3 = Mover<3>;

extern template class Mover<2>;
extern template class Mover<3>;

}  // namespace abut
