#include <abut/shape/ball.hpp>
#include <abut/shape/box.hpp>
#include <abut/shape/capsule.hpp>
#include <abut/shape/given.hpp>
#include <abut/shape/polygon.hpp>
#include <abut/shape/polyhedron.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <type_traits>

namespace abut {
namespace {

template <class S, int D>
Convex<D> placed_as(const Given<D>& given) {
    const S& shape = given.template as<S>();
    if (given.pose == nullptr) return convex(shape);
    if constexpr (std::is_same_v<S, Polyhedron>)
        return convex(shape, affine(*given.pose));
    else
        return convex(shape, *given.pose);
}

}  // namespace

template <int D>
Convex<D> convex_of(const Given<D>& given) {
    switch (given.kind) {
        case ShapeKind::ball:
            return placed_as<Ball<D>>(given);
        case ShapeKind::capsule:
            return placed_as<Capsule<D>>(given);
        case ShapeKind::segment:
            return placed_as<Segment<D>>(given);
        case ShapeKind::triangle:
            return placed_as<Triangle<D>>(given);
        case ShapeKind::box:
            return placed_as<Box<D>>(given);
        default:
            return placed_as<std::conditional_t<D == 2, Polygon, Polyhedron>>(given);
    }
}

template Convex<2> convex_of(const Given<2>&);
template Convex<3> convex_of(const Given<3>&);

}  // namespace abut
