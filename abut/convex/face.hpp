#pragma once

// The face, edge or corner with which a convex set meets another.

#include <abut/convex/support.hpp>

namespace abut {

/// The cosine of the angle within which a face, a side or a flat end counts as looking along a direction, and a line as
/// lying across it: 1.8 degrees.
inline constexpr double aligned = 0.9995;

/// A corner, an edge, or a face as the loop of its points; of the core, in the world.
template <int D>
struct Face {
    /// Faces of more corners are thinned out to so many.
    static constexpr std::size_t capacity = D == 2 ? 2 : 64;

    std::array<DVec<D>, capacity> points;
    std::array<std::uint32_t, capacity> indices;  ///< of the points, in the shape
    std::size_t count = 0;
    DVec<D> normal{0.0};  ///< outwards, where there are D points or more

    Face() = default;
    Face(const Face& other) { *this = other; }
    /// Only as many points as there are: the room for them is large.
    Face& operator=(const Face& other) {
        count = other.count;
        normal = other.normal;
        std::copy_n(other.points.begin(), count, points.begin());
        std::copy_n(other.indices.begin(), count, indices.begin());
        return *this;
    }

    bool flat() const { return count >= static_cast<std::size_t>(D); }
    void push_back(const DVec<D>& point, std::uint32_t index) {
        points[count] = point;
        indices[count++] = index;
    }
};

/// The face that looks most along `direction` (of length 1); an edge or corner where the core has no faces.
Face<2> face_along(const Convex<2>& convex, const DVec<2>& direction);
Face<3> face_along(const Convex<3>& convex, const DVec<3>& direction);

/// Cuts away what lies in front of a plane, dot(normal, p) > offset. New points are named after the edge they cut.
template <int D>
void clip(Face<D>& face, const DVec<D>& normal, double offset, std::uint32_t plane_name);

}  // namespace abut
