#pragma once

// Contacts of parts of two shapes, as the whole shapes feel them, and others beside them. For .cpp files.

#include <abut/query/felt_by.hpp>
#include <abut/query/kept_parts.hpp>

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
        : a_(a),
          b_(b),
          others_(others),
          scale_(felt_scale_of(a, b)),
          by_size_(is_composite(a) && is_composite(b)),
          larger_(by_size_ ? abut::size(a) - abut::size(b) : 0),
          middle_of_a_(a),
          middle_of_b_(b) {}

    /// From now on it looks among these parts first, of the one of them that is composite.
    void look_among(const KeptParts<D>& kept) { kept_ = &kept; }
    /// So far from where the two touch it looks for what is felt there, mostly.
    double sight() const { return 5 * scale_; }

    /// Of what feels the surface.
    double size() const { return scale_ / felt_scale; }

    /// Who feels the normal between two of the parts: in the middle of the area in which they meet, or at the deepest
    /// point. manifold_of() tells that area.
    template <class PartA, class PartB, class Manifolds>
    FeltBy felt_by(const PartA& part_a, const PartB& part_b, const SignedDistance<D>& distance,
                   const Manifolds& manifold_of) const {
        FeltBy result;
        if (is_composite(b_) || others_.of_a != nullptr)
            result.a = feels(part_b, point_on_b(distance), -0.5, manifold_of, b_, others_.of_a,
                             [&] { return place_on_b(part_a, distance); });
        if (is_composite(a_) || others_.of_b != nullptr)
            result.b = feels(part_a, point_on_a(distance), 0.5, manifold_of, a_, others_.of_b,
                             [&] { return place_on_a(part_b, distance); });
        return result;
    }

    /// Puts the plane that is felt there, and its point, in place of a normal that is not, by those who don't feel it;
    /// of two composite shapes by the smaller, for which the other is a level. Of two such planes that which is left
    /// sooner, so that it is the same from either side. False where none is found, and all stays as it is.
    template <class PartA, class PartB>
    bool replace(const PartA& part_a, const PartB& part_b, const FeltBy& by, PartContact<D>& contact) {
        std::optional<PartContact<D>> for_a, for_b;
        if (by_size_ ? larger_ <= 0 : !by.a) {
            SeenFromMiddle<D> anew;
            const FeltPlace<D> place = place_on_b(part_a, contact.distance);
            const auto plane =
                felt_plane<D>(part_b, place, feet_on(b_, others_.of_a), has_own_middle(part_a, a_) ? anew : seen_by_a_);
            if (plane && !rest_on(part_a, *plane, for_a.emplace(contact))) for_a.reset();
        }
        if (by_size_ ? larger_ >= 0 : !by.b) {
            SeenFromMiddle<D> anew;
            const FeltPlace<D> place = place_on_a(part_b, contact.distance);
            const auto plane =
                felt_plane<D>(part_a, place, feet_on(a_, others_.of_b), has_own_middle(part_b, b_) ? anew : seen_by_b_);
            if (plane) {
                swap_roles(for_b.emplace(contact).distance);
                const bool rests = rest_on(part_b, *plane, *for_b);
                swap_roles(for_b->distance);
                if (!rests) for_b.reset();
            }
        }
        if (!for_a && !for_b) return false;
        contact = for_a && (!for_b || for_a->distance.distance >= for_b->distance.distance) ? *for_a : *for_b;
        return true;
    }

private:
    /// Of the box around a shape, found where first asked for; of a half-space, the origin.
    class Middle {
    public:
        explicit Middle(const View<D>& view) : view_(view) {}
        const DVec<D>& get() const {
            if (!found_)
                found_ =
                    std::holds_alternative<HalfSpaceView<D>>(view_) ? DVec<D>(0.0) : DVec<D>(center(bounds(view_)));
            return *found_;
        }

    private:
        const View<D>& view_;
        mutable std::optional<DVec<D>> found_;
    };

    static bool is_composite(const View<D>& view) { return std::holds_alternative<Composite<D>>(view); }

    /// Of a shape and what is felt beside it.
    auto feet_on(const View<D>& view, const EachFoot<D>* others) const {
        const KeptParts<D>* const kept = is_composite(view) ? kept_ : nullptr;
        return [&view, others, kept](const DVec<D>& point, double within, ClosestPointVisitor<D> visit) {
            double wanted = within;
            const auto visit_own = [&](const Foot<D>& foot) { return wanted = visit(foot); };
            if (kept == nullptr || !kept->each_foot(point, within, visit_own))
                each_foot_on<D>(view, point, within, visit_own);
            if (others != nullptr && wanted > no_others) (*others)(point, wanted, visit);
        };
    }

    /// Whether the normal of a part of `shape` is a surface normal at a point. The points of the manifold lie midway
    /// between two surfaces; `to_surface` of their depths along the normal brings them to this one. Nearly always
    /// nothing else is near, which is found out first; `place_of()`, the place with the middle of what feels it, takes
    /// longer.
    template <class Part, class Manifolds, class PlaceOf>
    bool feels(const Part& part, const FeltPlace<D>& point, double to_surface, const Manifolds& manifold_of,
               const View<D>& shape, const EachFoot<D>* others, const PlaceOf& place_of) const {
        const bool is_one_part = !is_composite(shape);
        if (is_one_part && is_alone(point, *others)) return true;
        const FeltPlace<D> place = place_of();
        const auto feet = feet_on(shape, others);
        const Manifold<D>& manifold = manifold_of();
        if (manifold.count > 1) {
            const DVec<D> normal = to_surface < 0 ? -place.out : place.out;
            DVec<D> sum(0.0);
            for (std::size_t i = 0; i < manifold.count; ++i)
                sum += manifold.points[i].position + normal * (to_surface * manifold.points[i].depth);
            FeltPlace<D> middle = place;
            middle.point = sum / static_cast<double>(manifold.count);
            if (is_one_part && is_alone(middle, *others) ? has_normal<D>(part, middle)
                                                         : is_felt_there<D>(part, middle, feet))
                return true;
        }
        return abut::is_felt<D>(part, place, feet);
    }

    /// Whether no other is as near to p + s n as a part that has p, by far more than rounding.
    static bool is_alone(const FeltPlace<D>& place, const EachFoot<D>& others) {
        bool alone = true;
        others(place.point + place.out * place.scale, 1.1 * place.scale, [&](const Foot<D>&) {
            alone = false;
            return no_others;
        });
        return alone;
    }

    /// Not one that is the whole shape, nor a flat part of a shape, which looks from the middle of the whole.
    static bool has_own_middle(const Convex<D>& part, const View<D>& shape) {
        const bool flat = part.core == Core::points && part.count <= D && part.radius == 0;
        return !flat && is_composite(shape);
    }
    static bool has_own_middle(const HalfSpaceView<D>&, const View<D>&) { return true; }
    static bool has_own_middle(const DistanceFunction<D>&, const View<D>&) { return false; }

    static DVec<D> middle_beside(const Convex<D>& part, const View<D>& shape, const DVec<D>& of_shape, const DVec<D>&) {
        return has_own_middle(part, shape) ? middle_of(part, {}) : of_shape;
    }
    static DVec<D> middle_beside(const HalfSpaceView<D>& part, const View<D>&, const DVec<D>&, const DVec<D>& beside) {
        return middle_of(part, beside);
    }

    static DVec<D> middle_beside(const DistanceFunction<D>&, const View<D>&, const DVec<D>& of_shape, const DVec<D>&) {
        return of_shape;
    }

    /// Without the middle.
    FeltPlace<D> point_on_b(const SignedDistance<D>& distance) const {
        return {distance.on_b(), -distance.normal, DVec<D>(0.0), scale_};
    }
    FeltPlace<D> point_on_a(const SignedDistance<D>& distance) const {
        return {distance.on_a, distance.normal, DVec<D>(0.0), scale_};
    }
    template <class PartA>
    FeltPlace<D> place_on_b(const PartA& part_a, const SignedDistance<D>& distance) const {
        FeltPlace<D> place = point_on_b(distance);
        place.middle = middle_beside(part_a, a_, middle_of_a_.get(), place.point);
        return place;
    }
    template <class PartB>
    FeltPlace<D> place_on_a(const PartB& part_b, const SignedDistance<D>& distance) const {
        FeltPlace<D> place = point_on_a(distance);
        place.middle = middle_beside(part_b, b_, middle_of_b_.get(), place.point);
        return place;
    }

    /// The contact of a part with what lies behind a plane; its normal is out of the part.
    static bool rest_on(const Convex<D>& part, const FeltPlane<D>& plane, PartContact<D>& contact) {
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
        return true;
    }
    /// A half-space has its own.
    static bool rest_on(const HalfSpaceView<D>&, const FeltPlane<D>&, PartContact<D>&) { return false; }
    /// Of a function it would have to be searched.
    static bool rest_on(const DistanceFunction<D>&, const FeltPlane<D>&, PartContact<D>&) { return false; }

    const View<D>&a_, &b_;
    Others<D> others_;
    double scale_;
    bool by_size_;   ///< of two composite shapes the smaller feels
    double larger_;  ///< by how much A then is
    Middle middle_of_a_, middle_of_b_;
    const KeptParts<D>* kept_ = nullptr;
    SeenFromMiddle<D> seen_by_a_, seen_by_b_;
};

}  // namespace abut
