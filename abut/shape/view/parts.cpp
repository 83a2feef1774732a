#include <abut/math/simd/square_root.hpp>
#include <abut/shape/view/mapped_box.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {
namespace {

template <int D>
bool bounded(const Aabb<D>& box) {
    constexpr float largest_float = std::numeric_limits<float>::max();
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && box.min[i] > -largest_float && box.max[i] < largest_float;
    return result;
}

/// A world-space box in the local frame. It is infinite if the placement flattens the shape.
template <int D>
Aabb<D> local_box(const Aabb<D>& box, const Placement<D>& placement) {
    const double det = determinant(placement.place);
    if (det == 0 || !bounded(box)) return everywhere<D>();
    const Affine<D> to_local = inverse(placement.place, det);
    const Aabb<D> wide = grown(box, static_cast<float>(placement.radius));
    return grown(mapped_box(wide, to_local), static_cast<float>(placement.inner_radius));
}

/// True if the placement is the identity, so that parts are in world space already.
template <int D>
bool has_identity_placement(const Placement<D>& placement) {
    return placement.similar && placement.scale == 1 && placement.radius == 0 && placement.inner_radius == 0 &&
           placement.place.offset == DVec<D>(0.0) && placement.place.column == Affine<D>().column;
}

/// A part of a composite in world space. Most parts have no placement of their own, so the two needn't be combined.
template <int D>
Convex<D> placed_part(const Convex<D>& part, const Composite<D>& composite) {
    const bool has_no_placement = part.place.column == Affine<D>().column && part.place.offset == DVec<D>(0.0) &&
                                  part.similar && part.radius == 0 && part.inner_radius == 0;
    if (!has_no_placement) return placed(part, composite);
    Convex<D> result = part;
    static_cast<Placement<D>&>(result) = composite;
    return result;
}

/// The largest gap between two boxes along an axis, at least 0.
template <int D>
float gap(const Aabb<D>& a, const Aabb<D>& b) {
    float widest = 0;
    for (int i = 0; i < D; ++i) widest = std::max({widest, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    return widest;
}

/// An upper bound of the local length of a world-space vector of length 1.
template <int D>
double max_local_length(const Placement<D>& placement, const Affine<D>& to_local) {
    if (placement.similar) return 1 / placement.scale;
    double sum = 0;
    for (const DVec<D>& column : to_local.column) sum += length_squared(column);
    return square_root(sum);
}

/// Grows the box until some part is found. Then searches once more up to the distance of that part, since a nearer one
/// may lie outside the last box.
template <int D>
void each_part_by_growing_box(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit) {
    const Aabb<D> all = bounds(composite);
    if (!(all.min[0] <= all.max[0] && box.min[0] <= box.max[0])) return;
    constexpr float largest_float = std::numeric_limits<float>::max();
    const float start = gap(all, box);
    double smaller = std::numeric_limits<double>::infinity();
    for (const Aabb<D>& one : {all, box})
        smaller = std::min(smaller, 0.5 * length(DVec<D>(one.max) - DVec<D>(one.min)));
    // An eighth of the smaller shape, and enough to change `start` after rounding.
    float step = std::max(static_cast<float>(0.125 * smaller), 2 * (std::nextafter(start, largest_float) - start));
    float searched = start, reach = std::numeric_limits<float>::infinity();
    const auto search = [&] {
        each_part<D>(composite, grown(box, searched), [&](const Convex<D>& part, std::uint32_t index) -> bool {
            reach = std::min(reach, visit(part, index));
            return reach >= 0;
        });
    };
    for (search(); reach > largest_float && searched < largest_float; search(), step *= 2)
        searched = std::min(start + step, largest_float);
    if (reach <= searched || reach > largest_float) return;
    searched = std::nextafter(reach, largest_float);
    search();
}

}  // namespace

template <int D>
void each_part(const Composite<D>& composite, const Aabb<D>& box, PartVisitor<D> visit) {
    // Levels mostly have the identity placement, and copying a part costs more than this test.
    if (has_identity_placement<D>(composite)) return composite.each_part(composite.object, box, visit);
    const auto place_and_visit = [&](const Convex<D>& part, std::uint32_t index) -> bool {
        return visit(placed_part(part, composite), index);
    };
    composite.each_part(composite.object, local_box(box, static_cast<const Placement<D>&>(composite)), place_and_visit);
}

template <int D>
void each_part_along(const Composite<D>& composite, const MovingBox<D>& box, PartReachVisitor<D> visit) {
    const Aabb<D> all = bounds(composite);
    if (!(all.min[0] <= all.max[0])) return;
    const double across = length(DVec<D>(all.max) - DVec<D>(all.min));
    const double far = length(DVec<D>(center(all)) - box.center) + across + length(box.half);
    const double reach = std::min(box.length, far);
    // A ray may hit a part slightly outside its box, so boxes are padded.
    const double tolerance = 2e-7 * across;
    const double det = determinant(composite.place);
    // A box at rest has no direction; the plain box query covers it.
    if (composite.each_part_along != nullptr && det != 0 && box.direction != DVec<D>(0.0)) {
        MovingBox<D> own = box;
        own.length = reach;
        if (has_identity_placement<D>(composite)) {
            own.half += tolerance;
            return composite.each_part_along(composite.object, own, visit);
        }
        const Affine<D> to_local = inverse(composite.place, det);
        own.center = to_local.point(box.center);
        own.direction = to_local.vector(box.direction);
        for (int i = 0; i < D; ++i) {
            double squares = 0, half = 0;
            for (int j = 0; j < D; ++j) {
                const double factor = to_local.column[static_cast<std::size_t>(j)][i];
                squares += factor * factor;
                half += std::abs(factor) * box.half[j];
            }
            own.half[i] = half + square_root(squares) * (composite.radius + tolerance) + composite.inner_radius;
        }
        const auto place_and_visit = [&](const Convex<D>& part, std::uint32_t index) -> float {
            return visit(placed_part(part, composite), index);
        };
        return composite.each_part_along(composite.object, own, place_and_visit);
    }
    const DVec<D> end = box.center + box.direction * reach;
    Aabb<D> swept;
    for (int i = 0; i < D; ++i) {
        swept.min[i] = static_cast<float>(std::min(box.center[i], end[i]) - box.half[i]);
        swept.max[i] = static_cast<float>(std::max(box.center[i], end[i]) + box.half[i]);
    }
    each_part<D>(composite, grown(swept, static_cast<float>(tolerance)),
                 [&](const Convex<D>& part, std::uint32_t index) -> bool { return visit(part, index) >= 0; });
}

template <int D>
void each_part_along(const Composite<D>& composite, const DVec<D>& origin, const DVec<D>& direction,
                     double length_of_ray, PartReachVisitor<D> visit) {
    each_part_along(composite, MovingBox<D>{origin, DVec<D>(0.0), direction, length_of_ray}, visit);
}

template <int D>
void each_part_near(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit) {
    const double det = determinant(composite.place);
    if (composite.each_part_near == nullptr || det == 0) return each_part_by_growing_box(composite, box, visit);
    const Placement<D>& placement = composite;
    const double longest = max_local_length(placement, inverse(composite.place, det)) * (1 + 1e-6);
    composite.each_part_near(composite.object, local_box(box, placement),
                             [&](const Convex<D>& part, std::uint32_t index) -> float {
                                 const double reach = static_cast<double>(visit(placed_part(part, composite), index));
                                 return static_cast<float>(reach * longest);
                             });
}

template <int D>
bool contains_inside(const Composite<D>& composite, const Vec<D>& point) {
    const double det = determinant(composite.place);
    if (composite.contains == nullptr || det == 0) return false;
    return composite.contains(composite.object, to_float(inverse(composite.place, det).point(DVec<D>(point))));
}

#define ABUT_INSTANTIATE(D)                                                                                          \
    template void each_part(const Composite<D>&, const Aabb<D>&, PartVisitor<D>);                                    \
    template void each_part_along(const Composite<D>&, const MovingBox<D>&, PartReachVisitor<D>);                    \
    template void each_part_along(const Composite<D>&, const DVec<D>&, const DVec<D>&, double, PartReachVisitor<D>); \
    template void each_part_near(const Composite<D>&, const Aabb<D>&, PartReachVisitor<D>);                          \
    template bool contains_inside(const Composite<D>&, const Vec<D>&);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
