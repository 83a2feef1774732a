#pragma once

// All surfaces of a level at once: what is near a place, and what is in the way.

#include "level_view.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <optional>
#include <type_traits>
#include <vector>

namespace abut::tool {

template <int D>
using FacetShape = std::conditional_t<D == 2, Segment<D>, Triangle<D>>;

/// One flat piece of the surface of an object.
template <int D>
struct PlacedFacet {
    FacetShape<D> shape;
    std::uint32_t object = 0;
    DVec<D> front{0.0};  ///< of length 1, away from it; zero where it has no area
    bool two_sided = false;
    bool has_border = false;  ///< the surface ends at one of its sides
};

template <int D>
std::array<Vec<D>, static_cast<std::size_t>(D)> corners(const FacetShape<D>& facet);

template <int D>
struct FacetHit {
    double distance = 0;
    std::uint32_t facet = 0;
    bool from_behind = false;
};

template <int D>
class FacetTree {
public:
    /// Refers to the objects.
    explicit FacetTree(const std::vector<StandingObject<D>>& objects);

    std::size_t size() const { return facets_.size(); }
    const PlacedFacet<D>& operator[](std::size_t i) const { return facets_[i]; }
    const Aabb<D>& box(std::size_t i) const { return boxes_[i]; }

    /// Whether some facet is nearer to a point than `distance`.
    bool has_within(const DVec<D>& point, double distance) const;

    /// visit(index) for the facets at most `distance` from a point; in an order of the tree's own.
    template <class Visit>
    void each_within(const DVec<D>& point, double distance, Visit&& visit) const {
        const Vec<D> place(point);
        tree_.each_overlapping(grown(Aabb<D>{place, place}, static_cast<float>(distance)), [&](std::uint32_t i) {
            if (distance_to(i, place) <= distance) visit(i);
        });
    }

    /// The first facet along a direction of length 1.
    std::optional<FacetHit<D>> first_hit(const DVec<D>& origin, const DVec<D>& direction, double length) const;

    /// Whether there is none between two points.
    bool sees(const DVec<D>& a, const DVec<D>& b) const;

    /// Whether a point is inside of an object that is filled.
    bool is_inside(const DVec<D>& point) const;

private:
    double distance_to(std::uint32_t facet, const Vec<D>& point) const;

    const std::vector<StandingObject<D>>& objects_;
    std::vector<PlacedFacet<D>> facets_;
    std::vector<Aabb<D>> boxes_;
    Bvh<D> tree_, object_tree_;
};

}  // namespace abut::tool
