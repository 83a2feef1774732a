#pragma once

// The generalized winding number of triangles around a point, by solid angles. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut::detail {

/// The generalized winding number of triangles, closed or not: the sum of their signed solid angles as seen from a
/// point, divided by 4 pi. A closed surface that is oriented outwards gives 1 inside. Jacobson, Kavan, Sorkine-Hornung
/// (2013): "Robust inside-outside segmentation using generalized winding numbers".
class GeneralizedWindingNumber {
public:
    GeneralizedWindingNumber(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    bool empty() const { return corners_.empty(); }

    /// Sums over all triangles. Returns nothing if the point lies in a triangle, within rounding.
    std::optional<double> exact(const DVec<3>& point) const;

    /// Approximates distant groups by their dipoles (the sum of their area vectors), after Barill, Dickson, Schmidt,
    /// Levin and Jacobson (2018): "Fast winding numbers for soups and clouds". The largest error measured over open and
    /// closed surfaces was below 0.03. Returns nothing if the point lies in a triangle.
    std::optional<double> approximate(const DVec<3>& point) const;

private:
    struct Corners {
        DVec<3> a, b, c;
    };
    /// Triangles from `first` on. If `below` isn't 0, the groups `below` and `below` + 1 are its children.
    struct Group {
        DVec<3> middle{0.0}, area{0.0};  ///< the area vector is along the normal
        double radius = 0;
        std::uint32_t first = 0, count = 0, below = 0;
    };

    void divide(std::uint32_t group);
    std::optional<double> exact(const DVec<3>& point, std::uint32_t first, std::uint32_t count) const;

    std::vector<Corners> corners_;
    std::vector<Group> groups_;
};

}  // namespace abut::detail
