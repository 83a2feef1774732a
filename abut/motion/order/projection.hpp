#pragma once

// Projections of shapes along a direction, and the depth of their overlap. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/convex/tolerance.hpp>
#include <abut/shape/polygon.hpp>

namespace abut::detail {

template <int D>
double tolerance_for(const Convex<D>& a, const Convex<D>& b) {
    const double size_a = size(a), size_b = size(b);
    const double apart = largest(reference_point(b) - reference_point(a));
    return tolerance_for(std::min(size_a, size_b), apart + size_a + size_b);
}

/// The projection of a 3D shape on a plane: a polygon with a radius, or a support function. Refers to the shape.
class Projection {
public:
    /// Projects on the plane with axes x and y, which are orthonormal.
    Projection(const Convex<3>& shape, const DVec<3>& x, const DVec<3>& y);
    Projection(const Projection&) = delete;
    Projection& operator=(const Projection&) = delete;

    const Convex<2>& shape() const { return projected_; }

private:
    DVec<2> project(const DVec<3>& v) const { return {dot(v, x_), dot(v, y_)}; }
    Vec2 support_point(const Vec2& direction) const;

    const Convex<3>* shape_;
    DVec<3> origin_, x_, y_;
    Polygon polygon_;
    Convex<2> projected_;
};

/// The penetration depth of the projections: the distance by which one shape has to be moved aside to pass the other
/// along a unit direction; 0 or negative if it passes.
double projected_depth(const Projection& a, const Projection& b);
double projected_depth(const Convex<2>& a, const Convex<2>& b, const DVec<2>& along);
double projected_depth(const Convex<3>& a, const Convex<3>& b, const DVec<3>& along);

}  // namespace abut::detail
