#include <abut/math/simd/square_root.hpp>
#include <abut/shape/view/mapped_box.hpp>
#include <abut/shape/view/view.hpp>

namespace abut::detail {
namespace {

/// The world-space box of a local box with the rounding radii of a placement.
template <int D>
Aabb<D> world_box(const Aabb<D>& own, const Placement<D>& placement) {
    if (!(own.min[0] <= own.max[0])) return Aabb<D>::empty();
    const Aabb<D> inner = placement.inner_radius > 0 ? grown(own, static_cast<float>(placement.inner_radius)) : own;
    const Aabb<D> box = mapped_box(inner, placement.place);
    return placement.radius > 0 ? grown(box, static_cast<float>(placement.radius)) : box;
}

template <int D>
bool is_finite(const HalfSpaceView<D>& half_space) {
    return std::isfinite(length_squared(half_space.normal) + half_space.offset);
}

template <int D>
double size_of_box(const Aabb<D>& box) {
    if (!(box.min[0] <= box.max[0])) return 0;
    return 0.5 * length(DVec<D>(box.max) - DVec<D>(box.min));
}

}  // namespace

template <int D>
Aabb<D> bounds(const Composite<D>& composite) {
    return world_box(composite.bounds, composite);
}

template <int D>
Aabb<D> bounds(const DistanceFunction<D>& function) {
    return world_box(function.bounds, function);
}

template <int D>
Aabb<D> bounds(const View<D>& view) {
    return std::visit([](const auto& shape) { return bounds(shape); }, view);
}

template <int D>
double size(const View<D>& view) {
    const auto* convex = std::get_if<Convex<D>>(&view);
    if (convex != nullptr) return size(*convex);
    return std::holds_alternative<HalfSpaceView<D>>(view) ? std::numeric_limits<double>::infinity()
                                                          : size_of_box(bounds(view));
}

template <int D>
double size(const DistanceFunction<D>& function) {
    return size_of_box(bounds(function));
}

/// The inverse scales no vector by more than the square root of the largest absolute row sum of N^T N, or of N N^T.
/// This is exact if the columns of N, or of its transpose, are orthogonal.
template <int D>
double min_scale_factor(const Placement<D>& placement) {
    if (placement.similar) return placement.scale;
    const double det = determinant(placement.place);
    if (det == 0) return 0;
    const Affine<D> to_local = inverse(placement.place, det);
    Affine<D> transposed;
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j)
            transposed.column[static_cast<std::size_t>(i)][j] = to_local.column[static_cast<std::size_t>(j)][i];
    double bound = std::numeric_limits<double>::infinity();
    for (const Affine<D>* map : {&std::as_const(to_local), &std::as_const(transposed)}) {
        double max_row_sum = 0;
        for (const DVec<D>& row : map->column) {
            double sum = 0;
            for (const DVec<D>& column : map->column) sum += std::abs(dot(row, column));
            max_row_sum = std::max(max_row_sum, sum);
        }
        bound = std::min(bound, max_row_sum);
    }
    return bound > 0 ? 1 / square_root(bound) : 0;
}

template <int D>
bool is_finite(const View<D>& view) {
    return std::visit([](const auto& shape) { return is_finite(shape); }, view);
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

template <int D, PlacedView<D> V>
V mapped(const V& view, const Affine<D>& map) {
    V result = view;
    static_cast<Placement<D>&>(result) = mapped(static_cast<const Placement<D>&>(view), map);
    return result;
}

template <int D>
View<D> mapped(const View<D>& view, const Affine<D>& map) {
    return std::visit([&](const auto& shape) -> View<D> { return mapped(shape, map); }, view);
}

template <int D, PlacedView<D> V>
V moved(const V& view, const Affine<D>& rigid) {
    V result = view;
    result.place = rigid * view.place;
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
    if (radius > 0) result.solid = nullptr;  // the ball is added to the triangles
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

#define ABUT_INSTANTIATE(D)                                                            \
    template Aabb<D> bounds(const Composite<D>&);                                      \
    template Aabb<D> bounds(const DistanceFunction<D>&);                               \
    template Aabb<D> bounds(const View<D>&);                                           \
    template double size(const View<D>&);                                              \
    template double size(const DistanceFunction<D>&);                                  \
    template double min_scale_factor(const Placement<D>&);                             \
    template bool is_finite(const DistanceFunction<D>&);                               \
    template DistanceFunction<D> mapped(const DistanceFunction<D>&, const Affine<D>&); \
    template DistanceFunction<D> moved(const DistanceFunction<D>&, const Affine<D>&);  \
    template DistanceFunction<D> rounded(const DistanceFunction<D>&, double);          \
    template bool is_finite(const View<D>&);                                           \
    template bool is_finite(const Placement<D>&);                                      \
    template Convex<D> mapped(const Convex<D>&, const Affine<D>&);                     \
    template Composite<D> mapped(const Composite<D>&, const Affine<D>&);               \
    template View<D> mapped(const View<D>&, const Affine<D>&);                         \
    template Convex<D> moved(const Convex<D>&, const Affine<D>&);                      \
    template Composite<D> moved(const Composite<D>&, const Affine<D>&);                \
    template View<D> moved(const View<D>&, const Affine<D>&);                          \
    template Convex<D> rounded(const Convex<D>&, double);                              \
    template Composite<D> rounded(const Composite<D>&, double);                        \
    template View<D> rounded(const View<D>&, double);
ABUT_INSTANTIATE(2)
ABUT_INSTANTIATE(3)
#undef ABUT_INSTANTIATE

}  // namespace abut::detail
