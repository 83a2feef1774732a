#include <abut/math/assert.hpp>
#include <abut/shape/view.hpp>

namespace abut {
namespace {

/// The box of a box under an affine map, rounded outwards.
template <int D>
Aabb<D> mapped_box(const Aabb<D>& box, const Affine<D>& map) {
    Aabb<D> result;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (int i = 0; i < D; ++i) {
        double low = map.offset[i], high = map.offset[i];
        for (int j = 0; j < D; ++j) {
            const double factor = map.column[static_cast<std::size_t>(j)][i];
            if (factor == 0) continue;
            const double a = factor * static_cast<double>(box.min[j]), b = factor * static_cast<double>(box.max[j]);
            low += std::min(a, b);
            high += std::max(a, b);
        }
        result.min[i] = std::nextafter(static_cast<float>(low), -infinity);
        result.max[i] = std::nextafter(static_cast<float>(high), infinity);
    }
    return result;
}

double determinant(const Affine<2>& map) {
    return cross(map.column[0], map.column[1]);
}
double determinant(const Affine<3>& map) {
    return dot(map.column[0], cross(map.column[1], map.column[2]));
}

Affine<2> inverse_of(const Affine<2>& map, double determinant) {
    Affine<2> result;
    result.column[0] = DVec<2>(map.column[1].y, -map.column[0].y) / determinant;
    result.column[1] = DVec<2>(-map.column[1].x, map.column[0].x) / determinant;
    result.offset = -result.vector(map.offset);
    return result;
}
Affine<3> inverse_of(const Affine<3>& map, double determinant) {
    const DVec<3> x = cross(map.column[1], map.column[2]) / determinant;
    const DVec<3> y = cross(map.column[2], map.column[0]) / determinant;
    const DVec<3> z = cross(map.column[0], map.column[1]) / determinant;
    Affine<3> result;
    for (int i = 0; i < 3; ++i) result.column[static_cast<std::size_t>(i)] = DVec<3>(x[i], y[i], z[i]);
    result.offset = -result.vector(map.offset);
    return result;
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
    const Affine<D> back = inverse_of(placement.place, volume);
    const Aabb<D> wide = grown(box, static_cast<float>(placement.radius));
    return grown(mapped_box(wide, back), static_cast<float>(placement.inner_radius));
}

}  // namespace

template <int D>
Aabb<D> bounds(const Composite<D>& composite) {
    if (!(composite.bounds.min[0] <= composite.bounds.max[0])) return Aabb<D>::empty();
    const Aabb<D> inner = composite.inner_radius > 0
                              ? grown(composite.bounds, static_cast<float>(composite.inner_radius))
                              : composite.bounds;
    const Aabb<D> box = mapped_box(inner, composite.place);
    return composite.radius > 0 ? grown(box, static_cast<float>(composite.radius)) : box;
}

template <int D>
Aabb<D> bounds(const View<D>& view) {
    return std::visit([](const auto& shape) { return bounds(shape); }, view);
}

template <int D>
void each_part(const Composite<D>& composite, const Aabb<D>& box, PartVisitor<D> visit) {
    const auto place_and_visit = [&](const Convex<D>& part, std::uint32_t index) -> bool {
        return visit(placed(part, composite), index);
    };
    composite.each_part(composite.object, unplaced_box(box, static_cast<const Placement<D>&>(composite)),
                        place_and_visit);
}

template <int D>
bool contains_inside(const Composite<D>& composite, const Vec<D>& point) {
    const double volume = determinant(composite.place);
    if (composite.contains == nullptr || volume == 0) return false;
    return composite.contains(composite.object, to_float(inverse_of(composite.place, volume).point(DVec<D>(point))));
}

template <int D>
double size(const View<D>& view) {
    if (std::holds_alternative<Solid<D>>(view)) return std::numeric_limits<double>::infinity();
    if (const auto* convex = std::get_if<Convex<D>>(&view)) return size(*convex);
    const Aabb<D> box = bounds(std::get<Composite<D>>(view));
    if (!(box.min[0] <= box.max[0])) return 0;
    return 0.5 * length(DVec<D>(box.max) - DVec<D>(box.min));
}

template <int D>
bool is_finite(const View<D>& view) {
    if (const auto* convex = std::get_if<Convex<D>>(&view)) return is_finite(*convex);
    if (const auto* solid = std::get_if<Solid<D>>(&view))
        return std::isfinite(length_squared(solid->normal) + solid->offset);
    Convex<D> placement;
    static_cast<Placement<D>&>(placement) = std::get<Composite<D>>(view);
    return is_finite(placement);
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
View<D> rounded(const View<D>& view, double radius) {
    return std::visit([&](const auto& shape) -> View<D> { return rounded(shape, radius); }, view);
}

#define ABUT_INSTANTIATE(D)                                                       \
    template Aabb<D> bounds(const Composite<D>&);                                 \
    template Aabb<D> bounds(const View<D>&);                                      \
    template void each_part(const Composite<D>&, const Aabb<D>&, PartVisitor<D>); \
    template bool contains_inside(const Composite<D>&, const Vec<D>&);            \
    template double size(const View<D>&);                                         \
    template bool is_finite(const View<D>&);                                      \
    template Convex<D> mapped(const Convex<D>&, const Affine<D>&);                \
    template Composite<D> mapped(const Composite<D>&, const Affine<D>&);          \
    template View<D> mapped(const View<D>&, const Affine<D>&);                    \
    template Convex<D> moved(const Convex<D>&, const Affine<D>&);                 \
    template Composite<D> moved(const Composite<D>&, const Affine<D>&);           \
    template View<D> moved(const View<D>&, const Affine<D>&);                     \
    template Convex<D> rounded(const Convex<D>&, double);                         \
    template Composite<D> rounded(const Composite<D>&, double);                   \
    template View<D> rounded(const View<D>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut
