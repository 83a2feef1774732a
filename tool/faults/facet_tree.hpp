#pragma once

// A tree of all facets of a level: proximity queries and ray casts.

#include "tool/objects/level_view.hpp"
#include <abut/broad_phase/bvh.hpp>
#include <abut/shape/segment.hpp>
#include <abut/shape/triangle.hpp>

#include <optional>
#include <type_traits>
#include <vector>

namespace abut::tool {

using detail::DVec;

template <int D>
using FacetShape = std::conditional_t<D == 2, Segment<D>, Triangle<D>>;

/// A facet of an object's surface, in world space.
template <int D>
struct PlacedFacet {
    FacetShape<D> shape;
    std::uint32_t object = 0;
    DVec<D> front{0.0};  ///< unit normal of the front side; zero for a degenerate facet
    bool two_sided = false;
    bool has_boundary = false;  ///< one of its edges is a boundary edge
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
    explicit FacetTree(const std::vector<ViewedObject<D>>& objects);

    std::size_t size() const { return facets_.size(); }
    const PlacedFacet<D>& operator[](std::size_t i) const { return facets_[i]; }
    const Aabb<D>& box(std::size_t i) const { return boxes_[i]; }

    /// True if a facet is closer to the point than `distance`.
    bool has_within(const DVec<D>& point, double distance) const;

    /// True if a facet is closer to the segment than `distance`.
    bool has_within(const DVec<D>& a, const DVec<D>& b, double distance) const;

    /// Calls visit(index) for each facet at most `distance` from the point, in the order of the tree.
    template <class Visit>
    void each_within(const DVec<D>& point, double distance, Visit&& visit) const {
        const Vec<D> place(point);
        tree_.each_overlapping(grown(Aabb<D>{place, place}, static_cast<float>(distance)), [&](std::uint32_t i) {
            if (distance_to(i, place) <= distance) visit(i);
        });
    }

    /// The first facet that a ray along a unit direction hits.
    std::optional<FacetHit<D>> first_hit(const DVec<D>& origin, const DVec<D>& direction, double length) const;

    /// True if no facet is between two points.
    bool is_visible(const DVec<D>& a, const DVec<D>& b) const;

    /// True if the point is inside a filled object.
    bool is_inside(const DVec<D>& point) const;

private:
    double distance_to(std::uint32_t facet, const Vec<D>& point) const;

    const std::vector<ViewedObject<D>>& objects_;
    std::vector<PlacedFacet<D>> facets_;
    std::vector<Aabb<D>> boxes_;
    Bvh<D> tree_, object_tree_;
};

}  // namespace abut::tool
