#pragma once

// The surface near a convex shape in a world: contact planes and times of impact, with the internal-edge (ghost
// collision) filter. For .cpp files.

#include <abut/motion/mover/nearby_parts.hpp>

namespace abut::detail {

/// A contact of the shape with a part, with the normal of the whole surface.
template <int D>
struct NearContact {
    PartName name;
    DVec<D> normal{0.0};  ///< unit normal, facing the shape
    DVec<D> point{0.0};   ///< point on the surface
    double gap = 0;       ///< negative: penetration
    Feature feature{};
    bool overlapped = false;  ///< the part overlapped the shape at its start
    bool is_sdf = false;      ///< the part is a signed distance function and may have several contact planes
};

/// A contact plane of the part, at the support point of the shape along it.
template <int D>
struct SdfPlane {
    DVec<D> normal{0.0};  ///< unit normal, facing the shape
    DVec<D> point{0.0};   ///< point on the surface
    double gap = 0;       ///< distance from the shape along the normal; at least 0
};

template <int D>
struct FirstTouch {
    double fraction = 1;
    NearContact<D> contact;
};

/// Returns true if the shape passes through the contact.
template <int D>
using Passes = FunctionRef<bool(const NearContact<D>&)>;

/// Reuses its memory.
template <int D>
class NearbySurface {
public:
    /// Starts queries for a shape, whose data must outlive them. `start` is its initial position, for `passes`, which
    /// may be null.
    void begin(const World<D>& world, const Filter& filter, const Convex<D>& shape, const DVec<D>& start,
               const Passes<D>* passes);
    /// Prefetches the region of a move, with a lift and a drop. It doesn't affect results.
    void prefetch(const DVec<D>& move, const DVec<D>& lift, const DVec<D>& drop, double around);

    /// The bounding radius of the shape.
    double size() const { return size_; }
    Convex<D> shape_at(const DVec<D>& at) const;

    /// The contacts within `reach` of the shape at a position. Valid until the next call.
    std::span<const NearContact<D>> contacts(const DVec<D>& at, double reach);
    /// The first contact of the shape, padded by `grown_by`, on a move.
    std::optional<FirstTouch<D>> first_touch(const DVec<D>& at, const DVec<D>& move, double grown_by);
    /// The surface normal slightly above a surface point; `up` has length 1.
    std::optional<DVec<D>> normal_above(const DVec<D>& point, const DVec<D>& up);

private:
    void gather(const Aabb<D>& box);
    void each_closest_point(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;
    bool passes(const Part<D>& part, NearContact<D>& contact);
    bool is_passed(const PartName& name) const;
    /// Finds the one-sided parts within `reach` that the shape is passing through.
    void find_passed_fronts(const DVec<D>& at, double reach);
    bool is_passed_front(const PartName& name) const;
    /// True if a point of a one-sided part is also on a passed front.
    bool is_on_passed_front(const DVec<D>& point) const;
    /// Closest points of all parts except one.
    void each_closest_point_of_others(const PartName& but, const DVec<D>& point, double within,
                                      ClosestPointVisitor<D> visit) const;
    bool is_covered(const PartName& name, const SdfPlane<D>& side) const;
    void add_sides(const NearContact<D>& nearest, const Convex<D>& shape, const DistanceFunction<D>& part,
                   double reach);
    void resolve_ghosts(double reach);

    struct Ghost {
        NearContact<D> contact;    ///< with the plane of the surface, if there is one
        bool is_on_ridge = false;  ///< then with its own
    };

    const World<D>* world_ = nullptr;
    const Passes<D>* passes_ = nullptr;
    Filter filter_;
    Convex<D> shape_;
    DVec<D> start_{0.0};
    double size_ = 0, scale_ = 0;
    NearbyParts<D> parts_;
    std::vector<NearContact<D>> contacts_;
    std::vector<Ghost> ghosts_;
    std::vector<PartName> passed_;         // at the position of the last query
    std::vector<PartName> passed_fronts_;  // there, by their sides
    bool contacts_valid_ = false;
    DVec<D> contacts_at_{0.0};
    double contacts_reach_ = 0;
};

extern template class NearbySurface<2>;
extern template class NearbySurface<3>;

}  // namespace abut::detail
