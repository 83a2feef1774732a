#pragma once

// Shapes as seen along a direction: what passes what, and by how much. For .cpp files.

#include <abut/convex/support.hpp>
#include <abut/shape/polygon.hpp>

namespace abut {

/// A shape of space as it is seen along a direction: a polygon with a ball around it, or what its support function
/// tells. Refers to the shape.
class Shadow {
public:
    /// On a plane with the axes x and y, of length 1 and across the direction.
    Shadow(const Convex<3>& shape, const DVec<3>& x, const DVec<3>& y);
    Shadow(const Shadow&) = delete;
    Shadow& operator=(const Shadow&) = delete;

    const Convex<2>& outline() const { return outline_; }

private:
    DVec<2> seen(const DVec<3>& v) const { return {dot(v, x_), dot(v, y_)}; }
    Vec2 farthest(const Vec2& direction) const;

    const Convex<3>* shape_;
    DVec<3> origin_, x_, y_;
    Polygon polygon_;
    Convex<2> outline_;
};

/// How far one of the two has to be moved aside before it passes the other on its way along a direction of length 1;
/// zero or below where it does.
double depth_aside(const Shadow& a, const Shadow& b);
double depth_aside(const Convex<2>& a, const Convex<2>& b, const DVec<2>& along);
double depth_aside(const Convex<3>& a, const Convex<3>& b, const DVec<3>& along);

}  // namespace abut
