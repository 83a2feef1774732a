#pragma once

// The face, edge or vertex of a convex set that supports it along a direction, for contact manifolds.

#include <abut/convex/support.hpp>

namespace abut::detail {

/// The cosine of 1.8 degrees. Within this angle a face, an edge in 2D or a flat end counts as facing a direction, and a
/// line as orthogonal to it.
inline constexpr double aligned = 0.9995;

/// A vertex, an edge, or a face as the loop of its points; of the core, in the world.
template <int D>
struct Face {
    /// Faces of more vertices are reduced to half of this number.
    static constexpr std::size_t capacity = D == 2 ? 2 : 64;

    std::array<DVec<D>, capacity> points;
    std::array<std::uint32_t, capacity> indices;  ///< of the points, in the shape
    std::size_t count = 0;
    DVec<D> normal{0.0};  ///< outwards, if there are D points or more

    Face() = default;
    Face(const Face& other) { *this = other; }
    /// Copies only `count` points, because the capacity is large.
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

/// The face whose normal is nearest to `direction` (of length 1); an edge or vertex if the core has no faces.
Face<2> face_along(const Convex<2>& convex, const DVec<2>& direction);
Face<3> face_along(const Convex<3>& convex, const DVec<3>& direction);

/// Cuts off the part in front of a plane, dot(normal, p) > offset. New points are named after the edge that they cut.
template <int D>
void clip(Face<D>& face, const DVec<D>& normal, double offset, std::uint32_t plane_name);

}  // namespace abut::detail
