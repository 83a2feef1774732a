#pragma once

// Contacts of parts of two shapes, as the whole shapes feel them, and others beside them. For .cpp files.

#include <abut/query/felt_by.hpp>
#include <abut/query/felt_normal.hpp>

namespace abut {

/// What each of two shapes feels beside the other one, as one surface with it; null: nothing. It must last.
template <int D>
struct Others {
    const EachFoot<D>* of_a = nullptr;  ///< what A feels beside B
    const EachFoot<D>* of_b = nullptr;  ///< what B feels beside A
};

/// Of two shapes, which are not copied: a part's surface is the shape's where that is composite, with that of the
/// others.
template <int D>
class FeltPair {
public:
    FeltPair(const View<D>& a, const View<D>& b, const Others<D>& others = {})
        : a_(a), b_(b), others_(others), scale_(felt_scale_of(a, b)) {}

    /// Of what feels the surface.
    double size() const { return scale_ / felt_scale; }

    /// Who feels the normal between two of the parts: at the deepest point, or where that lies in a corner, in the
    /// middle of the area in which they meet.
    template <class PartA, class PartB>
    FeltBy felt_by(const PartA& part_a, const PartB& part_b, const PartContact<D>& contact) const {
        const SignedDistance<D>& distance = contact.distance;
        FeltBy result;
        if (is_composite(b_) || others_.of_a != nullptr)
            result.a = feels(part_b, place_on_b(part_a, distance), -0.5, contact.manifold, b_, others_.of_a);
        if (is_composite(a_) || others_.of_b != nullptr)
            result.b = feels(part_a, place_on_a(part_b, distance), 0.5, contact.manifold, a_, others_.of_b);
        return result;
    }

    /// Puts the plane that is felt there in place of a normal that is not, by those who don't feel it: of two such
    /// planes that which is left sooner, so that it is the same from either side. Where none is found, the normal
    /// stays.
    template <class PartA, class PartB>
    void replace(const PartA& part_a, const PartB& part_b, const FeltBy& by, PartContact<D>& contact) const {
        std::optional<PartContact<D>> for_a, for_b;
        if (!by.a) {
            const FeltPlace<D> place = place_on_b(part_a, contact.distance);
            if (const auto plane = felt_plane<D>(part_b, place, feet_on(b_, others_.of_a)))
                rest_on(part_a, *plane, for_a.emplace(contact));
        }
        if (!by.b) {
            const FeltPlace<D> place = place_on_a(part_b, contact.distance);
            if (const auto plane = felt_plane<D>(part_a, place, feet_on(a_, others_.of_b))) {
                turn_round(for_b.emplace(contact).distance);
                rest_on(part_b, *plane, *for_b);
                turn_round(for_b->distance);
            }
        }
        if (for_a && (!for_b || for_a->distance.distance >= for_b->distance.distance))
            contact = *for_a;
        else if (for_b)
            contact = *for_b;
    }

private:
    static bool is_composite(const View<D>& view) { return std::holds_alternative<Composite<D>>(view); }

    /// Of a shape and what is felt beside it.
    static auto feet_on(const View<D>& view, const EachFoot<D>* others) {
        return [&view, others](const DVec<D>& point, double within, FunctionRef<void(const Foot<D>&)> visit) {
            each_foot_on(view, point, within, visit);
            if (others != nullptr) (*others)(point, within, visit);
        };
    }

    /// Whether the normal of a part of `shape` is felt. The points of the manifold lie midway between two surfaces;
    /// `to_surface` of their depths along the normal brings them to this one.
    template <class Part>
    static bool feels(const Part& part, FeltPlace<D> place, double to_surface, const Manifold<D>& manifold,
                      const View<D>& shape, const EachFoot<D>* others) {
        if (!is_composite(shape) && is_alone(place, *others)) return true;
        const auto feet = feet_on(shape, others);
        if (abut::is_felt<D>(part, place, feet)) return true;
        if (manifold.count < 2) return false;
        const DVec<D> normal = to_surface < 0 ? -place.out : place.out;
        DVec<D> sum(0.0);
        for (std::size_t i = 0; i < manifold.count; ++i)
            sum += manifold.points[i].position + normal * (to_surface * manifold.points[i].depth);
        place.point = sum / static_cast<double>(manifold.count);
        // If the part has its surface there.
        const double own = foot_on(part, place.point + place.out * place.scale).distance;
        return own > 0.99 * place.scale && abut::is_felt<D>(part, place, feet);
    }

    /// Whether no other is as near to p + s n as a part that has p, by far more than rounding.
    static bool is_alone(const FeltPlace<D>& place, const EachFoot<D>& others) {
        bool alone = true;
        others(place.point + place.out * place.scale, 1.1 * place.scale, [&](const Foot<D>&) { alone = false; });
        return alone;
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
    Others<D> others_;
    double scale_;
};

}  // namespace abut
