#pragma once

// What the questions see of a shape. Every front door turns its arguments into views and calls one function a
// dimension.
//
// A convex shape is a Convex, a half-space a Solid, a composite one gives its convex parts where it is asked to, and
// what is known by its distance alone is a DistanceFunction.

#include <abut/convex/support.hpp>
#include <abut/math/function_ref.hpp>
#include <abut/math/ray.hpp>
#include <abut/math/upper_halves.hpp>
#include <abut/shape/distance_function.hpp>
#include <abut/shape/given.hpp>
#include <abut/shape/half_space.hpp>
#include <abut/shape/neighbour.hpp>
#include <abut/shape/triangle.hpp>

#include <concepts>
#include <type_traits>
#include <variant>

namespace abut {

/// Is given one convex part of a composite shape with its number; returns false to stop.
template <int D>
using PartVisitor = FunctionRef<bool(const Convex<D>& part, std::uint32_t index)>;

/// Is given one convex part with its number while the parts are asked for in some order; returns how far on they are
/// still wanted: the new, shorter reach.
template <int D>
using PartReachVisitor = FunctionRef<float(const Convex<D>& part, std::uint32_t index)>;

struct MeshTree;

/// A composite shape: the union of its parts. Refers to the shape and must not outlive it.
template <int D>
struct Composite : Placement<D> {
    Aabb<D> bounds;  ///< in the shape's own frame, before the placement
    const void* object = nullptr;
    /// Visits at least the parts whose boxes overlap `box`, both in the shape's own frame.
    void (*each_part)(const void* object, const Aabb<D>& box, PartVisitor<D> visit) = nullptr;
    /// Visits at least the parts whose boxes the moving box meets within reach, roughly the first first. Null: they are
    /// asked for by a box around the whole way.
    void (*each_part_along)(const void* object, const MovingBox<D>& box, PartReachVisitor<D> visit) = nullptr;
    /// Visits at least the parts whose boxes are within reach of `box`, roughly the nearest first. Null: they are asked
    /// for by wider and wider boxes.
    void (*each_part_near)(const void* object, const Aabb<D>& box, PartReachVisitor<D> visit) = nullptr;
    /// Where all parts are the triangles of a tree; else null.
    const MeshTree* triangles = nullptr;
    /// Whether a point of the shape's own frame is inside it; null where the shape is the union of its parts and no
    /// more.
    bool (*contains)(const void* object, const Vec<D>& point) = nullptr;
    /// What is beyond a side of a part, as neighbour.hpp tells. Null where that is not known.
    std::uint32_t (*neighbour)(const void* object, std::uint32_t part, std::uint32_t side) = nullptr;
};

/// Any shape.
template <int D>
using View = std::variant<Convex<D>, Solid<D>, Composite<D>, DistanceFunction<D>>;

/// The least box around a shape, rounded outwards; for a composite turned or stretched, the box of its turned box.
template <int D>
Aabb<D> bounds(const Composite<D>& composite);
template <int D>
Aabb<D> bounds(const DistanceFunction<D>& function);
template <int D>
Aabb<D> bounds(const View<D>& view);

/// Visits at least the parts whose boxes overlap `box`, placed as the composite is; box and parts in the world.
template <int D>
void each_part(const Composite<D>& composite, const Aabb<D>& box, PartVisitor<D> visit);

/// Visits at least the parts that a ray of the world meets within reach, which is a distance along it; roughly the
/// first first.
template <int D>
void each_part_along(const Composite<D>& composite, const DVec<D>& origin, const DVec<D>& direction, double length,
                     PartReachVisitor<D> visit);

/// Visits at least the parts that a box moving in the world meets within reach, which is in lengths of the way it goes,
/// `box.direction`, of length 1; roughly the first first.
template <int D>
void each_part_along(const Composite<D>& composite, const MovingBox<D>& box, PartReachVisitor<D> visit);

/// Visits at least the parts whose boxes are within reach of `box`, roughly the nearest first; box and parts in the
/// world. A part may be visited more than once.
template <int D>
void each_part_near(const Composite<D>& composite, const Aabb<D>& box, PartReachVisitor<D> visit);

/// Whether a point of the world is inside a composite that is solid, without its parts and without what was rounded
/// onto it.
template <int D>
bool contains_inside(const Composite<D>& composite, const Vec<D>& point);

/// The bounding radius; infinite for a half-space, and for a distance function without bounds.
template <int D>
double size(const View<D>& view);
template <int D>
double size(const DistanceFunction<D>& function);

/// False where a number of it is NaN or infinite.
template <int D>
bool is_finite(const View<D>& view);
template <int D>
bool is_finite(const Placement<D>& placement);
template <int D>
bool is_finite(const DistanceFunction<D>& function);

template <int D>
Convex<D> mapped(const Convex<D>& convex, const Affine<D>& map);
template <int D>
Composite<D> mapped(const Composite<D>& composite, const Affine<D>& map);
template <int D>
DistanceFunction<D> mapped(const DistanceFunction<D>& function, const Affine<D>& map);
template <int D>
View<D> mapped(const View<D>& view, const Affine<D>& map);

/// By a map that keeps all lengths, such as a pose: the same as `mapped`, with less to find out.
template <int D>
Convex<D> moved(const Convex<D>& convex, const Affine<D>& rigid);
template <int D>
Composite<D> moved(const Composite<D>& composite, const Affine<D>& rigid);
template <int D>
DistanceFunction<D> moved(const DistanceFunction<D>& function, const Affine<D>& rigid);
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

// From here on: how a type becomes a view. The library's own shapes give `convex(shape)`, the plain ones also
// `given(shape)`, which saves the view where both of a pair have it; a user's give `bounds(shape)`
// and `support(shape, direction)`, `each_part(shape, box, visit)` or `signed_distance(shape, point)`, found by
// argument-dependent lookup. A
// composite one that has its parts in some order may also give `each_part_along(shape, moving_box, visit)` and
// `each_part_near(shape, box, visit)`, for rays and distances; the library's own of triangles has
// `triangle_tree(shape)`, for rays. `solid_contains(shape, point)` makes it solid in `contains`, and
// `part_neighbour(shape, part, side)` tells which of its parts meet in a seam.
//
// A signed distance, a float below zero inside, is promised to differ by no more than the way between two points: it
// may be less than the true one, such as a height above hills times the cosine of the steepest slope. Where it breaks
// that promise, things are missed; no search goes on for ever. `distance_sample(shape, point)` may tell a
// FieldSample, with the direction that else is found by differences. Distances are then those of the function: less
// than the true ones where it is. What is narrower than an 8th of what it is asked about, without changing the
// distance an 8th away, may be missed. The bounds may be infinite; such a shape doesn't pair with a half-space or with
// another without bounds.

namespace detail {

template <class S>
concept HasConvex = requires(const S& shape) {
    convex(shape);
};

template <class B>
struct DimensionOfBox;
template <int D>
struct DimensionOfBox<Aabb<D>> : std::integral_constant<int, D> {};

template <class S>
concept HasGiven = requires(const S& shape) {
    given(shape);
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

/// The visitor that a user's each_part is called with in order to find out whether it has one.
template <int D>
struct AnyPart {
    template <class Part>
    bool operator()(const Part&, std::uint32_t) const {
        return true;
    }
};

template <int D>
struct AnyPartReach {
    template <class Part>
    float operator()(const Part&, std::uint32_t) const {
        return 0;
    }
};

template <class S>
concept HasParts = HasBounds<S> && requires(const S& shape) {
    each_part(shape, bounds(shape), AnyPart<box_dimension<S>>());
};

template <class S>
concept HasDistance = HasBounds<S> && requires(const S& shape) {
    { signed_distance(shape, Vec<box_dimension<S>>()) } -> std::convertible_to<float>;
};

}  // namespace detail

template <int D>
const View<D>& view(const View<D>& shape) {
    return shape;
}
template <int D>
const Convex<D>& view(const Convex<D>& shape) {
    return shape;
}
template <int D>
const Composite<D>& view(const Composite<D>& shape) {
    return shape;
}
template <int D>
const DistanceFunction<D>& view(const DistanceFunction<D>& shape) {
    return shape;
}
template <int D>
Solid<D> view(const HalfSpace<D>& shape) {
    return solid(shape);
}

template <detail::HasConvex S>
auto view(const S& shape) {
    return convex(shape);
}

template <class S>
requires(!detail::HasConvex<S> && detail::HasSupport<S>) auto view(const S& shape) {
    constexpr int D = detail::box_dimension<S>;
    Convex<D> result;
    result.core = Core::function;
    result.object = &shape;
    result.function = [](const void* object, const Vec<D>& direction) -> Vec<D> {
        const Vec<D> farthest = support(*static_cast<const S*>(object), direction);
        detail::clear_upper_halves();
        return farthest;
    };
    return result;
}

namespace detail {

/// A part of any type, handed to the library as a view.
template <class R, class Visit>
auto part_to(const Visit& visit) {
    return [&visit](const auto& part, std::uint32_t index) -> R {
        const auto& seen = view(part);
        clear_upper_halves();
        return visit(seen, index);
    };
}

}  // namespace detail

template <class S>
requires(!detail::HasConvex<S> && !detail::HasSupport<S> && detail::HasParts<S>) auto view(const S& shape) {
    constexpr int D = detail::box_dimension<S>;
    Composite<D> result;
    result.bounds = bounds(shape);
    result.object = &shape;
    result.each_part = [](const void* object, const Aabb<D>& box, PartVisitor<D> visit) {
        each_part(*static_cast<const S*>(object), box, detail::part_to<bool>(visit));
        detail::clear_upper_halves();
    };
    if constexpr (requires { each_part_along(shape, MovingBox<D>(), detail::AnyPartReach<D>()); })
        result.each_part_along = [](const void* object, const MovingBox<D>& box, PartReachVisitor<D> visit) {
            each_part_along(*static_cast<const S*>(object), box, detail::part_to<float>(visit));
            detail::clear_upper_halves();
        };
    if constexpr (requires { each_part_near(shape, Aabb<D>(), detail::AnyPartReach<D>()); })
        result.each_part_near = [](const void* object, const Aabb<D>& box, PartReachVisitor<D> visit) {
            each_part_near(*static_cast<const S*>(object), box, detail::part_to<float>(visit));
            detail::clear_upper_halves();
        };
    if constexpr (requires {
                      { triangle_tree(shape) } -> std::same_as<const MeshTree&>;
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
struct DimensionOfView<Solid<D>> : std::integral_constant<int, D> {};
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

/// Anything that can be asked questions: a shape of this library, a view of one, or a user's own.
template <class S>
concept Shape = requires {
    detail::DimensionOfView<detail::ViewOf<S>>::value;
};

namespace detail {

/// What a question is asked of: two plain shapes as they were given, two convex ones by their Convex, anything else by
/// a View. A shape alone stands beside itself.
template <Shape S, class Other>
decltype(auto) view_beside(const S& shape) {
    if constexpr (HasGiven<S> && HasGiven<Other>)
        return given(shape);
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
== dimension<B> &&
    !(std::same_as<detail::ViewOf<A>, Solid<dimension<A>>> && std::same_as<detail::ViewOf<B>, Solid<dimension<B>>>);

namespace detail {

/// All questions of two shapes pass from the caller's code to the library here: `question` takes what the library sees
/// of them and calls it.
template <class A, class B, class F>
decltype(auto) ask(const A& a, const B& b, const F& question) {
    clear_upper_halves();
    const auto& seen_a = view_beside<A, B>(a);
    const auto& seen_b = view_beside<B, A>(b);
    clear_upper_halves();
    return question(seen_a, seen_b);
}

/// And all of one shape here.
template <class S, class F>
decltype(auto) ask_view(const S& shape, const F& question) {
    clear_upper_halves();
    const View<dimension<S>> seen(view(shape));
    clear_upper_halves();
    return question(seen);
}

}  // namespace detail

}  // namespace abut
