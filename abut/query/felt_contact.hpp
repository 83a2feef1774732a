#pragma once

// Contacts of parts of two shapes, as the whole shapes feel them. For .cpp files.

#include <abut/query/felt_normal.hpp>

namespace abut {

/// Of two shapes, which are not copied: a part's surface is the shape's where that is composite.
template <int D>
class FeltPair {
public:
    FeltPair(const View<D>& a, const View<D>& b) : a_(a), b_(b), scale_(felt_scale_of(a, b)) {}

    /// Of what feels the surface.
    double size() const { return scale_ / felt_scale; }

    /// Whether the normal between two of the parts is felt, on both sides.
    template <class PartA, class PartB>
    bool is_felt(const PartA& part_a, const PartB& part_b, const SignedDistance<D>& distance) const {
        const auto on_a = feet_on(a_);
        const auto on_b = feet_on(b_);
        return (!is_composite(b_) || abut::is_felt<D>(part_b, place_on_b(part_a, distance), on_b)) &&
               (!is_composite(a_) || abut::is_felt<D>(part_a, place_on_a(part_b, distance), on_a));
    }

    /// Puts the plane that is felt there in place of a normal that is not; where none is found, that stays.
    template <class PartA, class PartB>
    void replace(const PartA& part_a, const PartB& part_b, PartContact<D>& contact) const {
        const auto on_a = feet_on(a_);
        const auto on_b = feet_on(b_);
        if (is_composite(b_)) {
            const FeltPlace<D> place = place_on_b(part_a, contact.distance);
            if (const auto plane = felt_plane<D>(part_b, place, on_b)) rest_on(part_a, *plane, contact);
        } else {
            const FeltPlace<D> place = place_on_a(part_b, contact.distance);
            const auto plane = felt_plane<D>(part_a, place, on_a);
            if (!plane) return;
            turn_round(contact.distance);
            rest_on(part_b, *plane, contact);
            turn_round(contact.distance);
        }
    }

private:
    static bool is_composite(const View<D>& view) { return std::holds_alternative<Composite<D>>(view); }

    static auto feet_on(const View<D>& view) {
        return [&view](const DVec<D>& point, double within, FunctionRef<void(const Foot<D>&)> visit) {
            each_foot_on(view, point, within, visit);
        };
    }

    template <class PartA>
    FeltPlace<D> place_on_b(const PartA& part_a, const SignedDistance<D>& distance) const {
        const DVec<D> point = distance.on_b();
        return {point, -distance.normal, middle_of(part_a, point), scale_};
    }
    template <class PartB>
    FeltPlace<D> place_on_a(const PartB& part_b, const SignedDistance<D>& distance) const {
        return {distance.on_a, distance.normal, middle_of(part_b, distance.on_a), scale_};
    }

    /// The contact of a part with what lies behind a plane; its normal is out of the part.
    static void rest_on(const Convex<D>& part, const FeltPlane<D>& plane, PartContact<D>& contact) {
        SignedDistance<D>& distance = contact.distance;
        distance.normal = -plane.normal;
        const CorePoint<D> deepest = core_support(part, distance.normal);
        distance.on_a = deepest.position + distance.normal * part.radius;
        distance.distance = dot(plane.normal, distance.on_a - plane.point);
        distance.corners.count = 1;
        distance.corners.a[0] = deepest.index;
        contact.manifold.count = 1;
        contact.manifold.points[0] = {distance.on_a + distance.normal * (0.5 * distance.distance), -distance.distance,
                                      0};
    }
    /// A half-space has its own.
    static void rest_on(const Solid<D>&, const FeltPlane<D>&, PartContact<D>&) {}

    const View<D>&a_, &b_;
    double scale_;
};

}  // namespace abut
