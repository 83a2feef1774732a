#include <abut/math/assert.hpp>
#include <abut/shape/view.hpp>

namespace abut {
namespace {

/// The box of a box under an affine map, rounded outwards.
template <int D>
Aabb<D> mapped_box(const Aabb<D>& box, const Affine<D>& map) {
    Aabb<D> result;
    for (int i = 0; i < D; ++i) {
        double low = map.offset[i], high = map.offset[i];
        for (int j = 0; j < D; ++j) {
            const double factor = map.column[static_cast<std::size_t>(j)][i];
            if (factor == 0) continue;
            const double a = factor * static_cast<double>(box.min[j]), b = factor * static_cast<double>(box.max[j]);
            low += std::min(a, b);
            high += std::max(a, b);
        }
        result.min[i] = next_down(static_cast<float>(low));
        result.max[i] = next_up(static_cast<float>(high));
    }
    return result;
}

/// The box of a shape's own frame, and all that is rolled around it, where it is placed.
template <int D>
Aabb<D> placed_box(const Aabb<D>& own, const Placement<D>& placement) {
    if (!(own.min[0] <= own.max[0])) return Aabb<D>::empty();
    const Aabb<D> inner = placement.inner_radius > 0 ? grown(own, static_cast<float>(placement.inner_radius)) : own;
    const Aabb<D> box = mapped_box(inner, placement.place);
    return placement.radius > 0 ? grown(box, static_cast<float>(placement.radius)) : box;
}

template <int D>
double size_of_box(const Aabb<D>& box) {
    if (!(box.min[0] <= box.max[0])) return 0;
    return 0.5 * length(DVec<D>(box.max) - DVec<D>(box.min));
}

template <int D>
Aabb<D> everywhere() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    return {Vec<D>(-infinity), Vec<D>(infinity)};
}

template <int D>
bool bounded(const Aabb<D>& box) {
    constexpr float most = std::numeric_limits<float>::max();
    bool result = true;
    for (int i = 0; i < D; ++i) result = result && box.min[i] > -most && box.max[i] < most;
    return result;
}

/// A box of the world as a box of the shape's own frame; everywhere, where the placement has flattened the shape.
template <int D>
Aabb<D> unplaced_box(const Aabb<D>& box, const Placement<D>& placement) {
    const double volume = determinant(placement.place);
    if (volume == 0 || !bounded(box)) return everywhere<D>();
    const Affine<D> back = inverse(placement.place, volume);
    const Aabb<D> wide = grown(box, static_cast<float>(placement.radius));
    return grown(mapped_box(wide, back), static_cast<float>(placement.inner_radius));
}

/// The composite where it was made: its parts are where they are shown.
template <int D>
bool is_unplaced(const Placement<D>& placement) {
    return placement.similar && placement.scale == 1 && placement.radius == 0 && placement.inner_radius == 0 &&
           placement.place.offset == DVec<D>(0.0) && placement.place.column == Affine<D>().column;
}

/// A part of a composite, placed. Most parts have no placement of their own, so that there is nothing to find out about
/// the two together.
template <int D>
Convex<D> placed_part(const Convex<D>& part, const Composite<D>& composite) {
    const bool plain = part.place.column == Affine<D>().column && part.place.offset == DVec<D>(0.0) && part.similar &&
                       part.radius == 0 && part.inner_radius == 0;
    if (!plain) return placed(part, composite);
    Convex<D> result = part;
    static_cast<Placement<D>&>(result) = composite;
    return result;
}

/// The gap between two boxes along the axis on which it is widest; not below zero.
template <int D>
float gap(const Aabb<D>& a, const Aabb<D>& b) {
    float widest = 0;
    for (int i = 0; i < D; ++i) widest = std::max({widest, a.min[i] - b.max[i], b.min[i] - a.max[i]});
    return widest;
}

/// How long a way of length 1 in the world may be in the shape's own frame.
template <int D>
double longest_of_unit(const Placement<D>& placement, const Affine<D>& back) {
    if (placement.similar) return 1 / placement.scale;
    double sum = 0;
    for (const DVec<D>& column : back.column) sum += length_squared(column);
    return std::sqrt(sum);
}

/// Widens a box until some part is found, and then looks once more as far as that one is, since a box out there may
/// hold something nearer.
template <int D>
void each_part_by_widening(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit) {
    const Aabb<D> all = bounds(composite);
    if (!(all.min[0] <= all.max[0] && box.min[0] <= box.max[0])) return;
    constexpr float most = std::numeric_limits<float>::max();
    const float start = gap(all, box);
    double smaller = std::numeric_limits<double>::infinity();
    for (const Aabb<D>& one : {all, box})
        smaller = std::min(smaller, 0.5 * length(DVec<D>(one.max) - DVec<D>(one.min)));
    // An eighth of the smaller shape, and enough to matter beside `start`.
    float step = std::max(static_cast<float>(0.125 * smaller), 2 * (std::nextafter(start, most) - start));
    float looked = start, reach = std::numeric_limits<float>::infinity();
    const auto look = [&] {
        each_part<D>(composite, grown(box, looked), [&](const Convex<D>& part, std::uint32_t index) -> bool {
            reach = std::min(reach, visit(part, index));
            return reach >= 0;
        });
    };
    for (look(); reach > most && looked < most; look(), step *= 2) looked = std::min(start + step, most);
    if (reach <= looked || reach > most) return;
    looked = std::nextafter(reach, most);
    look();
}

}  // namespace

template <int D>
Aabb<D> bounds(const Composite<D>& composite) {
    return placed_box(composite.bounds, composite);
}

template <int D>
Aabb<D> bounds(const DistanceFunction<D>& function) {
    return placed_box(function.bounds, function);
}

template <int D>
Aabb<D> bounds(const View<D>& view) {
    return std::visit([](const auto& shape) { return bounds(shape); }, view);
}

template <int D>
void each_part(const Composite<D>& composite, const Aabb<D>& box, PartVisitor<D> visit) {
    // Levels mostly are, and each part is more to copy than to ask.
    if (is_unplaced<D>(composite)) return composite.each_part(composite.object, box, visit);
    const auto place_and_visit = [&](const Convex<D>& part, std::uint32_t index) -> bool {
        return visit(placed_part(part, composite), index);
    };
    composite.each_part(composite.object, unplaced_box(box, static_cast<const Placement<D>&>(composite)),
                        place_and_visit);
}

template <int D>
void each_part_along(const Composite<D>& composite, const MovingBox<D>& box, PartReachVisitor<D> visit) {
    const Aabb<D> all = bounds(composite);
    if (!(all.min[0] <= all.max[0])) return;
    const double across = length(DVec<D>(all.max) - DVec<D>(all.min));
    const double far = length(DVec<D>(center(all)) - box.center) + across + length(box.half);
    const double reach = std::min(box.length, far);
    // Parts count that a search takes for hit: they are a little wider than their boxes.
    const double slack = 2e-7 * across;
    const double volume = determinant(composite.place);
    // What rests goes along nothing: a box around it is all there is.
    if (composite.each_part_along != nullptr && volume != 0 && box.direction != DVec<D>(0.0)) {
        const Affine<D> back = inverse(composite.place, volume);
        MovingBox<D> own;
        own.center = back.point(box.center);
        own.direction = back.vector(box.direction);
        own.length = reach;
        for (int i = 0; i < D; ++i) {
            double squares = 0, half = 0;
            for (int j = 0; j < D; ++j) {
                const double factor = back.column[static_cast<std::size_t>(j)][i];
                squares += factor * factor;
                half += std::abs(factor) * box.half[j];
            }
            own.half[i] = half + std::sqrt(squares) * (composite.radius + slack) + composite.inner_radius;
        }
        composite.each_part_along(composite.object, own, [&](const Convex<D>& part, std::uint32_t index) -> float {
            return visit(placed_part(part, composite), index);
        });
        return;
    }
    const DVec<D> end = box.center + box.direction * reach;
    Aabb<D> way;
    for (int i = 0; i < D; ++i) {
        way.min[i] = static_cast<float>(std::min(box.center[i], end[i]) - box.half[i]);
        way.max[i] = static_cast<float>(std::max(box.center[i], end[i]) + box.half[i]);
    }
    each_part<D>(composite, grown(way, static_cast<float>(slack)),
                 [&](const Convex<D>& part, std::uint32_t index) -> bool { return visit(part, index) >= 0; });
}

template <int D>
void each_part_along(const Composite<D>& composite, const DVec<D>& origin, const DVec<D>& direction,
                     double length_of_ray, PartReachVisitor<D> visit) {
    each_part_along(composite, MovingBox<D>{origin, DVec<D>(0.0), direction, length_of_ray}, visit);
}

template <int D>
void each_part_near(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit) {
    const double volume = determinant(composite.place);
    if (composite.each_part_near == nullptr || volume == 0) return each_part_by_widening(composite, box, visit);
    const Placement<D>& placement = composite;
    const double longest = longest_of_unit(placement, inverse(composite.place, volume)) * (1 + 1e-6);
    composite.each_part_near(composite.object, unplaced_box(box, placement),
                             [&](const Convex<D>& part, std::uint32_t index) -> float {
                                 const double reach = static_cast<double>(visit(placed_part(part, composite), index));
                                 return static_cast<float>(reach * longest);
                             });
}

template <int D>
bool contains_inside(const Composite<D>& composite, const Vec<D>& point) {
    const double volume = determinant(composite.place);
    if (composite.contains == nullptr || volume == 0) return false;
    return composite.contains(composite.object, to_float(inverse(composite.place, volume).point(DVec<D>(point))));
}

template <int D>
double size(const View<D>& view) {
    if (std::holds_alternative<Solid<D>>(view)) return std::numeric_limits<double>::infinity();
    if (const auto* convex = std::get_if<Convex<D>>(&view)) return size(*convex);
    return size_of_box(bounds(view));
}

template <int D>
double size(const DistanceFunction<D>& function) {
    return size_of_box(bounds(function));
}

/// The way back lengthens nothing by more than the root of the largest sum of a row of N^T N, or of N N^T; where the
/// columns of the one are at right angles to each other that is the true one.
template <int D>
double least_factor(const Placement<D>& placement) {
    if (placement.similar) return placement.scale;
    const double volume = determinant(placement.place);
    if (volume == 0) return 0;
    const Affine<D> back = inverse(placement.place, volume);
    Affine<D> turned;
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            turned.column[static_cast<std::size_t>(i)][j] = back.column[static_cast<std::size_t>(j)][i];
    double least = std::numeric_limits<double>::infinity();
    for (const Affine<D>* map : {&std::as_const(back), &std::as_const(turned)}) {
        double most = 0;
        for (const DVec<D>& row : map->column) {
            double sum = 0;
            for (const DVec<D>& column : map->column) sum += std::abs(dot(row, column));
            most = std::max(most, sum);
        }
        least = std::min(least, most);
    }
    return least > 0 ? 1 / std::sqrt(least) : 0;
}

template <int D>
bool is_finite(const View<D>& view) {
    if (const auto* convex = std::get_if<Convex<D>>(&view)) return is_finite(*convex);
    if (const auto* solid = std::get_if<Solid<D>>(&view))
        return std::isfinite(length_squared(solid->normal) + solid->offset);
    if (const auto* function = std::get_if<DistanceFunction<D>>(&view)) return is_finite(*function);
    return is_finite(static_cast<const Placement<D>&>(std::get<Composite<D>>(view)));
}

template <int D>
bool is_finite(const DistanceFunction<D>& function) {
    return is_finite(static_cast<const Placement<D>&>(function)) && determinant(function.place) != 0;
}

template <int D>
bool is_finite(const Placement<D>& placement) {
    double sum = placement.radius + placement.inner_radius;
    for (int i = 0; i < D; ++i) {
        sum += placement.place.offset[i];
        for (const DVec<D>& column : placement.place.column) sum += column[i];
    }
    return std::isfinite(sum);
}

template <int D>
Convex<D> mapped(const Convex<D>& convex, const Affine<D>& map) {
    Convex<D> result = convex;
    static_cast<Placement<D>&>(result) = mapped(static_cast<const Placement<D>&>(convex), map);
    return result;
}

template <int D>
Composite<D> mapped(const Composite<D>& composite, const Affine<D>& map) {
    Composite<D> result = composite;
    static_cast<Placement<D>&>(result) = mapped(static_cast<const Placement<D>&>(composite), map);
    return result;
}

template <int D>
DistanceFunction<D> mapped(const DistanceFunction<D>& function, const Affine<D>& map) {
    DistanceFunction<D> result = function;
    static_cast<Placement<D>&>(result) = mapped(static_cast<const Placement<D>&>(function), map);
    return result;
}

template <int D>
View<D> mapped(const View<D>& view, const Affine<D>& map) {
    return std::visit([&](const auto& shape) -> View<D> { return mapped(shape, map); }, view);
}

template <int D>
Convex<D> moved(const Convex<D>& convex, const Affine<D>& rigid) {
    Convex<D> result = convex;
    result.place = rigid * convex.place;
    return result;
}

template <int D>
Composite<D> moved(const Composite<D>& composite, const Affine<D>& rigid) {
    Composite<D> result = composite;
    result.place = rigid * composite.place;
    return result;
}

template <int D>
DistanceFunction<D> moved(const DistanceFunction<D>& function, const Affine<D>& rigid) {
    DistanceFunction<D> result = function;
    result.place = rigid * function.place;
    return result;
}

template <int D>
View<D> moved(const View<D>& view, const Affine<D>& rigid) {
    return std::visit([&](const auto& shape) -> View<D> { return moved(shape, rigid); }, view);
}

template <int D>
Convex<D> rounded(const Convex<D>& convex, double radius) {
    Convex<D> result = convex;
    result.radius += radius;
    return result;
}

template <int D>
Composite<D> rounded(const Composite<D>& composite, double radius) {
    Composite<D> result = composite;
    result.radius += radius;
    return result;
}

template <int D>
DistanceFunction<D> rounded(const DistanceFunction<D>& function, double radius) {
    DistanceFunction<D> result = function;
    result.radius += radius;
    return result;
}

template <int D>
View<D> rounded(const View<D>& view, double radius) {
    return std::visit([&](const auto& shape) -> View<D> { return rounded(shape, radius); }, view);
}

#define ABUT_INSTANTIATE(D)                                                                                          \
    template Aabb<D> bounds(const Composite<D>&);                                                                    \
    template Aabb<D> bounds(const DistanceFunction<D>&);                                                             \
    template Aabb<D> bounds(const View<D>&);                                                                         \
    template void each_part(const Composite<D>&, const Aabb<D>&, PartVisitor<D>);                                    \
    template void each_part_along(const Composite<D>&, const MovingBox<D>&, PartReachVisitor<D>);                    \
    template void each_part_along(const Composite<D>&, const DVec<D>&, const DVec<D>&, double, PartReachVisitor<D>); \
    template void each_part_near(const Composite<D>&, const Aabb<D>&, PartReachVisitor<D>);                          \
    template bool contains_inside(const Composite<D>&, const Vec<D>&);                                               \
    template double size(const View<D>&);                                                                            \
    template double size(const DistanceFunction<D>&);                                                                \
    template double least_factor(const Placement<D>&);                                                               \
    template bool is_finite(const DistanceFunction<D>&);                                                             \
    template DistanceFunction<D> mapped(const DistanceFunction<D>&, const Affine<D>&);                               \
    template DistanceFunction<D> moved(const DistanceFunction<D>&, const Affine<D>&);                                \
    template DistanceFunction<D> rounded(const DistanceFunction<D>&, double);                                        \
    template bool is_finite(const View<D>&);                                                                         \
    template bool is_finite(const Placement<D>&);                                                                    \
    template Convex<D> mapped(const Convex<D>&, const Affine<D>&);                                                   \
    template Composite<D> mapped(const Composite<D>&, const Affine<D>&);                                             \
    template View<D> mapped(const View<D>&, const Affine<D>&);                                                       \
    template Convex<D> moved(const Convex<D>&, const Affine<D>&);                                                    \
    template Composite<D> moved(const Composite<D>&, const Affine<D>&);                                              \
    template View<D> moved(const View<D>&, const Affine<D>&);                                                        \
    template Convex<D> rounded(const Convex<D>&, double);                                                            \
    template Composite<D> rounded(const Composite<D>&, double);                                                      \
    template View<D> rounded(const View<D>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
