#pragma once

// One move of a Mover, step by step. For .cpp files.

#include <abut/motion/mover.hpp>
#include <abut/motion/mover/nearby_surface.hpp>
#include <abut/motion/push/plane_solver.hpp>

namespace abut::detail {

/// The mover's options in double.
template <int D>
struct MoveSettings {
    DVec<D> up;  ///< unit vector, or 0: then nothing is ground and no slope too steep
    double step_height = 0, min_rise = 0, snap_distance = 0,
           skin = 0;  ///< min_rise: minimum component of a ground normal along `up`
};

template <int D>
class MoveAndSlide {
public:
    MoveAndSlide(NearbySurface<D>& near, const MoveSettings<D>& settings, const DVec<D>& at,
                 std::vector<MoverTouch<D>>& touches)
        : near_(near), settings_(settings), at_(at), touches_(touches) {}

    const DVec<D>& at() const { return at_; }
    double depth() const { return depth_; }

    /// Pushes the mover out of overlaps; returns the push.
    DVec<D> separate();
    /// Follows the motion of the ground until blocked.
    void carry(const DVec<D>& move);
    /// Moves and slides by the requested motion.
    void slide(const DVec<D>& motion);
    /// Snaps down to sinking ground.
    void snap_to_ground();

    /// The ground contact, or null. Valid until the next step.
    const NearContact<D>* ground();
    /// A contact that supports the mover without ground, such as both sides of a groove. Null if it would slide down.
    const NearContact<D>* supporting_groove();
    /// The part of a motion that all contacts allow.
    DVec<D> allowed(const DVec<D>& motion);
    /// Adds all contacts to the list.
    void report_contacts();

private:
    std::span<const NearContact<D>> contacts() { return near_.contacts(at_, 2 * settings_.skin); }
    DVec<D> level(const DVec<D>& v) const { return v - settings_.up * dot(v, settings_.up); }
    /// True if the contact is ground for a mover whose lowest point is at `lowest` along up.
    bool is_ground(const NearContact<D>& contact, double lowest);
    bool is_ground(const NearContact<D>& contact) { return is_ground(contact, lowest_at(at_)); }
    double lowest_at(const DVec<D>& at) const { return dot(settings_.up, support(near_.shape_at(at), -settings_.up)); }
    DVec<D> along_ground(const DVec<D>& motion, const NearContact<D>& ground) const;
    /// The nearest move that the planes allow; `wall` is set if a wall blocks `requested`.
    DVec<D> allowed_by_planes(const DVec<D>& requested, bool& wall);
    /// The fraction of an allowed move to make at once.
    double fraction_to_edges(const DVec<D>& move, const DVec<D>& requested);
    bool climb_step(const DVec<D>& ahead, double without);
    void report(const NearContact<D>& contact);

    NearbySurface<D>& near_;
    const MoveSettings<D>& settings_;
    DVec<D> at_;
    std::vector<MoverTouch<D>>& touches_;
    std::optional<MovePlane<D>> extra_;  // plane of an obstacle that stopped it and isn't among the contacts
    double depth_ = 0;
};

}  // namespace abut::detail
