#pragma once

// The winding number of the triangles that close a surface's holes. For .cpp files.

#include <abut/math/dvec.hpp>
#include <abut/math/vec.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/ext/vector_uint3.hpp>

namespace abut {

/// How much of the view from a point its triangles fill, as a share of all of it: positive where they turn their backs,
/// so that a closed surface wound outwards gives 1 inside.
///
/// Groups that are far away are told by the sums of their areas alone, as Barill, Dickson, Schmidt, Levin and Jacobson
/// have it (2018): "Fast winding numbers for soups and clouds".
class FieldCap {
public:
    FieldCap(std::span<const Vec3> points, std::span<const glm::uvec3> triangles);

    bool empty() const { return corners_.empty(); }

    /// The winding number, without its sign, of the surface alone that with the cap goes round the point as often as
    /// `together` says. Near 0.5 all triangles are told one by one: there, and so on either side of 0.5, it is exact.
    double without(const DVec<3>& point, std::int32_t together) const;

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
    /// In parts of the full angle.
    double exactly(const DVec<3>& point, std::uint32_t first, std::uint32_t count) const;
    double nearly(const DVec<3>& point) const;

    std::vector<Corners> corners_;
    std::vector<Group> groups_;
};

}  // namespace abut
