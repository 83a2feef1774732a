#pragma once

// How often triangles go round a point, by the solid angles that they fill. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// The winding number of triangles, closed or not: how much of the view from a point they fill, as a share of all of
/// it, positive where they turn their backs, so that a closed surface wound outwards gives 1 inside. Jacobson, Kavan,
/// Sorkine-Hornung (2013): "Robust inside-outside segmentation using generalized winding numbers".
class SolidAngles {
public:
    SolidAngles(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    bool empty() const { return corners_.empty(); }

    /// One triangle after the other. Nothing where the point lies in one of them, as far as rounding can tell.
    std::optional<double> exactly(const DVec<3>& point) const;

    /// Groups that are far away are told by the sums of their areas alone, as Barill, Dickson, Schmidt, Levin and
    /// Jacobson have it (2018): "Fast winding numbers for soups and clouds". On surfaces of all kinds it was off by
    /// less than 0.03. Nothing where the point lies in a triangle.
    std::optional<double> nearly(const DVec<3>& point) const;

private:
    struct Corners {
        DVec<3> a, b, c;
    };
    /// Triangles from `first` on, or, where `below` isn't 0, two groups: that number and the next.
    struct Group {
        DVec<3> middle{0.0}, area{0.0};  ///< the area is a vector along the normal
        double radius = 0;
        std::uint32_t first = 0, count = 0, below = 0;
    };

    void divide(std::uint32_t group);
    std::optional<double> exactly(const DVec<3>& point, std::uint32_t first, std::uint32_t count) const;

    std::vector<Corners> corners_;
    std::vector<Group> groups_;
};

}  // namespace abut
