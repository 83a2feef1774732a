#pragma once

// Views: what queries receive of a shape. Every public query turns its arguments into views and calls one function per
// dimension.
//
// A convex shape becomes a Convex, a half-space a HalfSpaceView, a composite shape a Composite, which visits its convex
// parts, and a signed distance function a DistanceFunction.

#include <abut/convex/support.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/simd/upper_halves.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view/distance_function.hpp>
#include <abut/shape/view/parts.hpp>
#include <abut/shape/view/shape_ref.hpp>

#include <concepts>
#include <type_traits>
#include <variant>

namespace abut {

/// The view of any shape, such as World::shape returns. One alternative is in this namespace, so that calls of queries
/// with views alone are found by argument-dependent lookup.
template <int D>
using View = std::variant<detail::Convex<D>, detail::HalfSpaceView<D>, detail::Composite<D>, DistanceFunction<D>>;

}  // namespace abut

namespace abut::detail {

/// The bounding box, rounded outwards. For a rotated or scaled composite it is the box around its mapped local box.
template <int D>
Aabb<D> bounds(const Composite<D>& composite);
template <int D>
Aabb<D> bounds(const DistanceFunction<D>& function);
template <int D>
Aabb<D> bounds(const View<D>& view);

/// The bounding radius; infinite for a half-space, and for a distance function without bounds.
template <int D>
double size(const View<D>& view);
template <int D>
double size(const DistanceFunction<D>& function);

/// False if a number of the view is NaN or infinite.
template <int D>
bool is_finite(const View<D>& view);
template <int D>
bool is_finite(const Placement<D>& placement);
template <int D>
bool is_finite(const DistanceFunction<D>& function);

/// Convex, Composite and DistanceFunction.
template <class V, int D>
concept PlacedView = std::derived_from<V, Placement<D>>;

template <int D, PlacedView<D> V>
V mapped(const V& view, const Affine<D>& map);
template <int D>
View<D> mapped(const View<D>& view, const Affine<D>& map);

/// The view after a rigid map, such as a pose. Equal to `mapped`, but cheaper.
template <int D, PlacedView<D> V>
V moved(const V& view, const Affine<D>& rigid);
template <int D>
View<D> moved(const View<D>& view, const Affine<D>& rigid);

template <int D>
Convex<D> rounded(const Convex<D>& convex, double radius);
template <int D>
Composite<D> rounded(const Composite<D>& composite, double radius);
template <int D>
DistanceFunction<D> rounded(const DistanceFunction<D>& function, double radius);
template <int D>
View<D> rounded(const View<D>& view, double radius);

// How a type becomes a view. The library's shapes provide `convex(shape)`; primitives and polytopes also provide
// `shape_ref(shape)`, which avoids the view if both shapes of a pair have it. A user's shape provides functions found
// by argument-dependent lookup: `bounds(shape)` and one of `support(shape, direction)`, `each_part(shape, box, visit)`
// or `signed_distance(shape, point)`. An ordered composite may also provide `each_part_along(shape, moving_box, visit)`
// and `each_part_near(shape, box, visit)`, for rays and distances. `triangle_tree(shape)` is for the library's triangle
// shapes only. `solid_contains(shape, point)` makes a composite solid in `contains`, and `part_neighbour(shape, part,
// side)` gives the adjacency that the internal-edge filter needs.
//
// A signed distance is a float, negative inside, and Lipschitz continuous with constant 1. It may be less than the true
// distance, such as a height above terrain times the cosine of the steepest slope. If it breaks that bound, queries may
// miss contacts, but no search loops forever. `distance_sample(shape, point)` may return a FieldSample with the
// gradient direction, which is otherwise found by differences. Reported distances are those of the function. Features
// narrower than an 8th of the other shape may be missed if the distance an 8th away doesn't show them. The bounds may
// be infinite; such a shape can't be paired with a half-space or with another unbounded shape.

template <class S>
concept HasConvex = requires(const S& shape) {
    convex(shape);
};

template <class B>
struct DimensionOfBox;
template <int D>
struct DimensionOfBox<Aabb<D>> : std::integral_constant<int, D> {};

template <class S>
concept HasShapeRef = requires(const S& shape) {
    shape_ref(shape);
};

template <class S>
concept HasBounds = requires(const S& shape) {
    DimensionOfBox<decltype(bounds(shape))>::value;
};

template <HasBounds S>
inline constexpr int box_dimension = DimensionOfBox<decltype(bounds(std::declval<const S&>()))>::value;

template <class S>
concept HasSupport = HasBounds<S> && requires(const S& shape) {
    { support(shape, Vec<box_dimension<S>>()) } -> std::convertible_to<Vec<box_dimension<S>>>;
};

/// The visitor that detects whether a user's shape has each_part.
template <int D>
struct AcceptsAnyPart {
    template <class Part>
    bool operator()(const Part&, std::uint32_t) const {
        return true;
    }
};

template <int D>
struct AcceptsAnyPartReach {
    template <class Part>
    float operator()(const Part&, std::uint32_t) const {
        return 0;
    }
};

template <class S>
concept HasParts = HasBounds<S> && requires(const S& shape) {
    each_part(shape, bounds(shape), AcceptsAnyPart<box_dimension<S>>());
};

template <class S>
concept HasDistance = HasBounds<S> && requires(const S& shape) {
    { signed_distance(shape, Vec<box_dimension<S>>()) } -> std::convertible_to<float>;
};

}  // namespace abut::detail

namespace abut {

template <int D>
const View<D>& view(const View<D>& shape) {
    return shape;
}
template <int D>
const detail::Convex<D>& view(const detail::Convex<D>& shape) {
    return shape;
}
template <int D>
const detail::Composite<D>& view(const detail::Composite<D>& shape) {
    return shape;
}
template <int D>
const DistanceFunction<D>& view(const DistanceFunction<D>& shape) {
    return shape;
}
template <int D>
detail::HalfSpaceView<D> view(const HalfSpace<D>& shape) {
    return detail::half_space_view(shape);
}

template <detail::HasConvex S>
auto view(const S& shape) {
    return convex(shape);
}

template <class S>
requires(!detail::HasConvex<S> && detail::HasSupport<S>) auto view(const S& shape) {
    constexpr int D = detail::box_dimension<S>;
    detail::Convex<D> result;
    result.core = detail::Core::function;
    result.object = &shape;
    result.function = [](const void* object, const Vec<D>& direction) -> Vec<D> {
        const Vec<D> farthest = support(*static_cast<const S*>(object), direction);
        detail::clear_upper_halves();
        return farthest;
    };
    return result;
}

namespace detail {

/// Wraps a visitor of views as a visitor of parts of any type.
template <class R, class Visit>
auto part_to(const Visit& visit) {
    return [&visit](const auto& part, std::uint32_t index) -> R {
        const auto& part_view = view(part);
        clear_upper_halves();
        return visit(part_view, index);
    };
}

}  // namespace detail

template <class S>
requires(!detail::HasConvex<S> && !detail::HasSupport<S> && detail::HasParts<S>) auto view(const S& shape) {
    constexpr int D = detail::box_dimension<S>;
    detail::Composite<D> result;
    result.bounds = bounds(shape);
    result.object = &shape;
    result.kind = detail::composite_kind<S>;
    result.each_part = [](const void* object, const Aabb<D>& box, detail::PartVisitor<D> visit) {
        each_part(*static_cast<const S*>(object), box, detail::part_to<bool>(visit));
        detail::clear_upper_halves();
    };
    if constexpr (requires { each_part_along(shape, MovingBox<D>(), detail::AcceptsAnyPartReach<D>()); })
        result.each_part_along = [](const void* object, const MovingBox<D>& box, detail::PartReachVisitor<D> visit) {
            each_part_along(*static_cast<const S*>(object), box, detail::part_to<float>(visit));
            detail::clear_upper_halves();
        };
    if constexpr (requires { each_part_near(shape, Aabb<D>(), detail::AcceptsAnyPartReach<D>()); })
        result.each_part_near = [](const void* object, const Aabb<D>& box, detail::PartReachVisitor<D> visit) {
            each_part_near(*static_cast<const S*>(object), box, detail::part_to<float>(visit));
            detail::clear_upper_halves();
        };
    if constexpr (requires {
                      { triangle_tree(shape) } -> std::same_as<const detail::MeshTree&>;
                  })
        result.triangles = &triangle_tree(shape);
    if constexpr (requires {
                      { solid_contains(shape, Vec<D>()) } -> std::same_as<bool>;
                  })
        result.contains = [](const void* object, const Vec<D>& point) {
            const bool inside = solid_contains(*static_cast<const S*>(object), point);
            detail::clear_upper_halves();
            return inside;
        };
    if constexpr (requires {
                      { part_neighbour(shape, 0u, 0u) } -> std::same_as<std::uint32_t>;
                  })
        result.neighbour = [](const void* object, std::uint32_t part, std::uint32_t side) {
            const std::uint32_t neighbour = part_neighbour(*static_cast<const S*>(object), part, side);
            detail::clear_upper_halves();
            return neighbour;
        };
    return result;
}

template <class S>
requires(!detail::HasConvex<S> && !detail::HasSupport<S> && !detail::HasParts<S> &&
         detail::HasDistance<S>) auto view(const S& shape) {
    constexpr int D = detail::box_dimension<S>;
    DistanceFunction<D> result;
    result.bounds = bounds(shape);
    result.object = &shape;
    result.distance = [](const void* object, const Vec<D>& point) -> float {
        const float distance = signed_distance(*static_cast<const S*>(object), point);
        detail::clear_upper_halves();
        return distance;
    };
    if constexpr (requires {
                      { distance_sample(shape, Vec<D>()) } -> std::same_as<FieldSample<D>>;
                  })
        result.sample = [](const void* object, const Vec<D>& point) -> FieldSample<D> {
            const FieldSample<D> sample = distance_sample(*static_cast<const S*>(object), point);
            detail::clear_upper_halves();
            return sample;
        };
    return result;
}

namespace detail {

template <class V>
struct DimensionOfView;
template <int D>
struct DimensionOfView<Convex<D>> : std::integral_constant<int, D> {};
template <int D>
struct DimensionOfView<HalfSpaceView<D>> : std::integral_constant<int, D> {};
template <int D>
struct DimensionOfView<Composite<D>> : std::integral_constant<int, D> {};
template <int D>
struct DimensionOfView<DistanceFunction<D>> : std::integral_constant<int, D> {};
template <int D>
struct DimensionOfView<View<D>> : std::integral_constant<int, D> {};

template <class S>
using ViewOf = std::remove_cvref_t<decltype(view(std::declval<const S&>()))>;

template <class V>
inline constexpr bool is_convex_view = false;
template <int D>
inline constexpr bool is_convex_view<Convex<D>> = true;

template <class V>
inline constexpr bool is_composite_view = false;
template <int D>
inline constexpr bool is_composite_view<Composite<D>> = true;

}  // namespace detail

/// A shape of this library, a view of one, or a user's shape.
template <class S>
concept Shape = requires {
    detail::DimensionOfView<detail::ViewOf<S>>::value;
};

namespace detail {

/// The form in which a pair query receives a shape: both as ShapeRef if both have one, both as Convex if both are
/// convex, else as View. For a query of one shape, Other is the shape itself.
template <Shape S, class Other>
decltype(auto) view_for_pair(const S& shape) {
    if constexpr (HasShapeRef<S> && HasShapeRef<Other>)
        return shape_ref(shape);
    else if constexpr (is_convex_view<ViewOf<S>> && is_convex_view<ViewOf<Other>>)
        return view(shape);
    else
        return View<DimensionOfView<ViewOf<S>>::value>(view(shape));
}

}  // namespace detail

/// 2 or 3.
template <Shape S>
inline constexpr int dimension = detail::DimensionOfView<detail::ViewOf<S>>::value;

/// Two shapes of one dimension, at most one of them a half-space.
template <class A, class B>
concept Pair = Shape<A> && Shape<B> && dimension<A>
== dimension<B> && !(std::same_as<detail::ViewOf<A>, detail::HalfSpaceView<dimension<A>>> &&
                     std::same_as<detail::ViewOf<B>, detail::HalfSpaceView<dimension<B>>>);

namespace detail {

/// All pair queries enter the library here: calls `query` with the views of the two shapes.
template <class A, class B, class F>
decltype(auto) with_views(const A& a, const B& b, const F& query) {
    clear_upper_halves();
    const auto& view_a = view_for_pair<A, B>(a);
    const auto& view_b = view_for_pair<B, A>(b);
    clear_upper_halves();
    return query(view_a, view_b);
}

/// All queries of one shape enter the library here: calls `query` with the view of the shape.
template <class S, class F>
decltype(auto) with_view(const S& shape, const F& query) {
    clear_upper_halves();
    const View<dimension<S>> shape_view(view(shape));
    clear_upper_halves();
    return query(shape_view);
}

}  // namespace detail

}  // namespace abut
