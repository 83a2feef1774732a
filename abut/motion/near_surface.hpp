#pragma once

// What a convex shape is near to in a world, wherever it is put: planes to keep to, and first touches on its way. For
// .cpp files.

#include <abut/motion/function_sides.hpp>
#include <abut/motion/near_parts.hpp>

namespace abut {

/// A place where the shape is near a part, or in it, as the whole surface is felt.
template <int D>
struct NearContact {
    PartName name;
    DVec<D> normal{0.0};  ///< of length 1, facing the shape
    DVec<D> point{0.0};   ///< on the surface
    double gap = 0;       ///< below zero inside
    Feature feature{};
    bool overlapped = false;  ///< the part and the shape at its start
    bool has_sides = false;   ///< the part may be met at several sides at once: it is known by its distance alone
};

template <int D>
struct FirstTouch {
    double fraction = 1;
    NearContact<D> contact;
};

/// Whether the shape goes through what it meets there.
template <int D>
using Passes = FunctionRef<bool(const NearContact<D>&)>;

/// Keeps its memory from use to use.
template <int D>
class NearSurface {
public:
    /// From now on it is about this shape, which may be put anywhere; what it refers to must last. `start` is where it
    /// is in the beginning, for `passes`, which may be null.
    void begin(const World<D>& world, const Filter& filter, const Convex<D>& shape, const DVec<D>& start,
               const Passes<D>* passes);
    /// So far from the start it will probably be asked, and up and down from there: may be less than it comes to, and
    /// no answer depends on it.
    void expect(const DVec<D>& move, const DVec<D>& lift, const DVec<D>& drop, double around);

    /// The bounding radius of the shape.
    double size() const { return size_; }
    Convex<D> shape_at(const DVec<D>& at) const;

    /// What is at most so far from the shape there. Valid until the next call.
    std::span<const NearContact<D>> contacts(const DVec<D>& at, double reach);
    /// Of the shape, grown by so much, on its way from there.
    std::optional<FirstTouch<D>> first_touch(const DVec<D>& at, const DVec<D>& move, double grown_by);
    /// The way out of all that is there, as seen from a little above a point on the surface; `up` is of length 1.
    std::optional<DVec<D>> normal_above(const DVec<D>& point, const DVec<D>& up);

private:
    void need(const Aabb<D>& box);
    void each_foot(const DVec<D>& point, double within, ClosestPointVisitor<D> visit) const;
    template <class Part>
    bool passes(const Part& part, NearContact<D>& contact);
    bool is_passed(const PartName& name) const;
    /// Finds the one-sided parts that the shape is on its way through, there.
    void find_passed_fronts(const Convex<D>& shape, const Aabb<D>& box);
    bool is_passed_front(const PartName& name) const;
    /// Whether a place of a one-sided part lies on one of those as well.
    bool is_on_passed_front(const DVec<D>& point) const;
    /// Of all parts but one.
    void each_foot_of_others(const PartName& but, const DVec<D>& point, double within,
                             ClosestPointVisitor<D> visit) const;
    bool is_covered(const PartName& name, const FunctionSide<D>& side) const;
    void add_sides(const NearContact<D>& nearest, const Convex<D>& shape, const DistanceFunction<D>& part,
                   double reach);
    void tell_ghosts(const Convex<D>& shape, double reach);

    struct Ghost {
        NearContact<D> contact;
        std::optional<FeltPlane<D>> plane;
    };

    const World<D>* world_ = nullptr;
    const Passes<D>* passes_ = nullptr;
    Filter filter_;
    Convex<D> shape_;
    DVec<D> start_{0.0};
    double size_ = 0, scale_ = 0;
    NearParts<D> parts_;
    std::vector<NearContact<D>> contacts_;
    std::vector<Ghost> ghosts_;
    std::vector<PartName> passed_;         // at the place that was asked about last
    std::vector<PartName> passed_fronts_;  // there, by their sides
    bool contacts_known_ = false;
    DVec<D> contacts_at_{0.0};
    double contacts_reach_ = 0;
};

extern template class NearSurface<2>;
extern template class NearSurface<3>;

}  // namespace abut
