#pragma once

// Where a character gets by walking from the spawns of a level, on a grid whose cells are as wide as its radius.
//
// In 3D the character is a capsule that stands on the ground. It climbs steps of a quarter of its height and slopes of
// 60 degrees, and falls any distance onto ground. In 2D, and without an up direction, it is a ball that moves anywhere.

#include "tool/faults/facet_tree.hpp"
#include "tool/faults/spawns.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace abut::tool {

template <int D>
class Walkable {
public:
    /// Refers to the facets. Without an up direction in 3D there is no ground.
    Walkable(const FacetTree<D>& facets, const Character& character, const std::optional<Vec<D>>& up,
             std::span<const Vec<D>> spawns);

    /// True if the character gets near this point: to a place that sees it, at most `distance` and two cells away, at a
    /// height at which its body passes the point. The point may be the end of a passage with this middle: then only
    /// places on the same side of the middle count, and none that looks through the passage.
    bool reaches(const DVec<D>& point, double distance, const std::optional<DVec<D>>& middle = std::nullopt) const;

    /// True if nothing is in the way of a character that passes the point upright, however thin it is. In 2D always.
    bool has_headroom(const DVec<D>& point) const;

    std::size_t size() const { return count_; }
    /// False if the level has more places than are visited.
    bool is_complete() const { return is_complete_; }

private:
    using Cell = std::array<std::int64_t, static_cast<std::size_t>(D)>;  // zero along the up direction

    struct Place {
        Cell cell{};
        double height = 0;
    };

    DVec<D> at(const Place& place) const;
    bool fits(const DVec<D>& bottom) const;
    std::optional<double> ground_below(const DVec<D>& point) const;
    bool add(const Place& place);
    void start(const DVec<D>& spawn);
    void visit_neighbours(const Place& place);
    bool has_ground() const { return D == 3 && up_axis_ >= 0; }
    double height_of(const DVec<D>& point) const { return has_ground() ? point[up_axis_] * sign_ : 0; }

    const FacetTree<D>& facets_;
    double radius_, height_, step_;
    Aabb<D> space_;  ///< around the level; a character without ground goes no farther
    int up_axis_ = -1;
    double sign_ = 1;
    DVec<D> up_{0.0};
    std::map<Cell, std::vector<double>> heights_;
    std::vector<Place> stack_;
    std::size_t count_ = 0;
    bool is_complete_ = true;
};

}  // namespace abut::tool
