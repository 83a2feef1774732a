#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>
#include <abut/shape/view/shape_ref.hpp>

#include <type_traits>

namespace abut::detail {
namespace {

template <class S, int D>
Convex<D> placed_as(const ShapeRef<D>& ref) {
    const S& shape = ref.template as<S>();
    if (ref.pose == nullptr) return convex(shape);
    if constexpr (std::is_same_v<S, Polyhedron>)
        return convex(shape, affine(*ref.pose));
    else
        return convex(shape, *ref.pose);
}

}  // namespace

template <int D>
Convex<D> convex_of(const ShapeRef<D>& ref) {
    switch (ref.kind) {
        case ShapeKind::ball:
            return placed_as<Ball<D>>(ref);
        case ShapeKind::capsule:
            return placed_as<Capsule<D>>(ref);
        case ShapeKind::segment:
            return placed_as<Segment<D>>(ref);
        case ShapeKind::triangle:
            return placed_as<Triangle<D>>(ref);
        case ShapeKind::box:
            return placed_as<Box<D>>(ref);
        default:
            return placed_as<std::conditional_t<D == 2, Polygon, Polyhedron>>(ref);
    }
}

template Convex<2> convex_of(const ShapeRef<2>&);
template Convex<3> convex_of(const ShapeRef<3>&);

}  // namespace abut::detail
