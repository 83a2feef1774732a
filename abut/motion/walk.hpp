#pragma once

// One move of a Mover, step by step. For .cpp files.

#include <abut/motion/mover.hpp>
#include <abut/motion/near_surface.hpp>
#include <abut/motion/plane_solver.hpp>

namespace abut {

/// The options of a mover as the arithmetic takes them.
template <int D>
struct WalkRules {
    DVec<D> up;  ///< of length 1, or 0: then nothing is ground, and no slope too steep
    double step_height = 0, least_rise = 0, stick = 0, skin = 0;  ///< least_rise: of a normal along `up`, on ground
};

template <int D>
class Walk {
public:
    Walk(NearSurface<D>& near, const WalkRules<D>& rules, const DVec<D>& at, std::vector<MoverTouch<D>>& touches)
        : near_(near), rules_(rules), at_(at), touches_(touches) {}

    const DVec<D>& at() const { return at_; }
    double depth() const { return depth_; }

    /// Out of what it is in. How far it was pushed.
    DVec<D> get_out();
    /// The way of what carries it, as far as nothing is in the way.
    void go_along(const DVec<D>& move);
    /// The way asked.
    void slide(const DVec<D>& motion);
    /// Down to ground that sinks away.
    void stick();

    /// What is stood on; or null. Valid until the next step.
    const NearContact<D>* ground();
    /// What holds it up, though none of it is ground: such as both sides of a groove. Null where it would slide down.
    const NearContact<D>* groove();
    /// What all that touches allows of a motion.
    DVec<D> allowed(const DVec<D>& motion);
    /// Adds all that touches to the list.
    void tell_contacts();

private:
    std::span<const NearContact<D>> contacts() { return near_.contacts(at_, 2 * rules_.skin); }
    DVec<D> level(const DVec<D>& v) const { return v - rules_.up * dot(v, rules_.up); }
    /// For one that has its lowest point so far up.
    bool is_ground(const NearContact<D>& contact, double lowest);
    bool is_ground(const NearContact<D>& contact) { return is_ground(contact, lowest_at(at_)); }
    double lowest_at(const DVec<D>& at) const { return dot(rules_.up, support(near_.shape_at(at), -rules_.up)); }
    DVec<D> along_ground(const DVec<D>& motion, const NearContact<D>& ground) const;
    /// The nearest move that the planes allow; walls in the way of `wanted` are told.
    DVec<D> allowed_by_planes(const DVec<D>& wanted, bool& wall);
    /// How much of a move that the planes allow there is to be gone at once.
    double part_to_edges(const DVec<D>& move, const DVec<D>& asked);
    bool climb(const DVec<D>& ahead, double without);
    void tell(const NearContact<D>& contact);

    NearSurface<D>& near_;
    const WalkRules<D>& rules_;
    DVec<D> at_;
    std::vector<MoverTouch<D>>& touches_;
    std::optional<MovePlane<D>> extra_;  // of something that stops it, and isn't among what it touches
    double depth_ = 0;
};

}  // namespace abut
