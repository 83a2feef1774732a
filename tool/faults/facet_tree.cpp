#include "tool/faults/facet_tree.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>

#include <algorithm>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

DVec<2> front_of(const Segment<2>& segment) {
    const DVec<2> along = DVec<2>(segment.b) - DVec<2>(segment.a);
    return normalized(DVec<2>(along.y, -along.x), DVec<2>(0.0));
}
DVec<3> front_of(const Triangle<3>& triangle) {
    const DVec<3> a(triangle.a);
    return normalized(cross(DVec<3>(triangle.b) - a, DVec<3>(triangle.c) - a), DVec<3>(0.0));
}

Segment<2> shape_of(const Surface<2>& surface, const Surface<2>::Facet& facet) {
    return {surface.points[facet[0]], surface.points[facet[1]]};
}
Triangle<3> shape_of(const Surface<3>& surface, const Surface<3>::Facet& facet) {
    return {surface.points[facet[0]], surface.points[facet[1]], surface.points[facet[2]]};
}

// A side of a facet: its vertices without one of them.
template <int D>
using Side = std::array<std::uint32_t, static_cast<std::size_t>(D) - 1>;

template <int D>
Side<D> side_of(const typename Surface<D>::Facet& facet, std::size_t without) {
    Side<D> side;
    std::size_t count = 0;
    for (std::size_t corner = 0; corner < facet.size(); ++corner)
        if (corner != without) side[count++] = facet[corner];
    std::sort(side.begin(), side.end());
    return side;
}

// Per facet: true if one of its sides belongs to no other facet.
template <int D>
std::vector<bool> boundary_facets(const Surface<D>& surface) {
    std::vector<std::pair<Side<D>, std::uint32_t>> sides;
    for (std::uint32_t i = 0; i < surface.facets.size(); ++i)
        for (std::size_t without = 0; without < surface.facets[i].size(); ++without)
            sides.emplace_back(side_of<D>(surface.facets[i], without), i);
    std::sort(sides.begin(), sides.end());
    std::vector<bool> result(surface.facets.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const bool before = i > 0 && sides[i - 1].first == sides[i].first;
        const bool after = i + 1 < sides.size() && sides[i + 1].first == sides[i].first;
        if (!before && !after) result[sides[i].second] = true;
    }
    return result;
}

}  // namespace

template <>
std::array<Vec2, 2> corners<2>(const Segment<2>& facet) {
    return {facet.a, facet.b};
}
template <>
std::array<Vec3, 3> corners<3>(const Triangle<3>& facet) {
    return {facet.a, facet.b, facet.c};
}

template <int D>
FacetTree<D>::FacetTree(const std::vector<ViewedObject<D>>& objects) : objects_(objects) {
    std::vector<Aabb<D>> object_boxes;
    for (std::uint32_t object = 0; object < objects.size(); ++object) {
        const Surface<D>& surface = objects[object].surface;
        const std::vector<bool> has_boundary = boundary_facets(surface);
        for (std::size_t i = 0; i < surface.facets.size(); ++i) {
            PlacedFacet<D> facet;
            facet.shape = shape_of(surface, surface.facets[i]);
            facet.object = object;
            facet.front = front_of(facet.shape);
            facet.two_sided = surface.is_two_sided(i);
            facet.has_boundary = has_boundary[i];
            facets_.push_back(facet);
            boxes_.push_back(bounds(view(facet.shape)));
        }
        object_boxes.push_back(objects[object].filled ? objects[object].box : Aabb<D>::empty());
    }
    tree_.build(boxes_);
    object_tree_.build(object_boxes);
}

template <int D>
double FacetTree<D>::distance_to(std::uint32_t facet, const Vec<D>& point) const {
    return static_cast<double>(closest(facets_[facet].shape, point).distance);
}

template <int D>
bool FacetTree<D>::has_within(const DVec<D>& point, double distance) const {
    const Vec<D> place(point);
    bool found = false;
    tree_.each_overlapping(grown(Aabb<D>{place, place}, static_cast<float>(distance)), [&](std::uint32_t i) {
        found = distance_to(i, place) < distance;
        return !found;
    });
    return found;
}

template <int D>
bool FacetTree<D>::has_within(const DVec<D>& a, const DVec<D>& b, double distance) const {
    const Segment<D> segment{Vec<D>(a), Vec<D>(b)};
    bool found = false;
    tree_.each_overlapping(grown(bounds(view(segment)), static_cast<float>(distance)), [&](std::uint32_t i) {
        found = static_cast<double>(closest(facets_[i].shape, segment).distance) < distance;
        return !found;
    });
    return found;
}

template <int D>
std::optional<FacetHit<D>> FacetTree<D>::first_hit(const DVec<D>& origin, const DVec<D>& direction,
                                                   double length) const {
    const Ray<D> ray{Vec<D>(origin), Vec<D>(direction), static_cast<float>(length)};
    std::optional<FacetHit<D>> first;
    tree_.raycast(ray, [&](std::uint32_t i) {
        if (const std::optional<Hit<D>> hit = abut::raycast(ray, facets_[i].shape)) {
            const auto distance = static_cast<double>(hit->distance);
            if (!first || distance < first->distance || (distance == first->distance && i < first->facet))
                first = {distance, i, dot(facets_[i].front, direction) > 0};
        }
        return first ? static_cast<float>(first->distance) : ray.length;
    });
    return first;
}

template <int D>
bool FacetTree<D>::is_visible(const DVec<D>& a, const DVec<D>& b) const {
    const double distance = length(b - a);
    return distance == 0 || !first_hit(a, (b - a) / distance, distance);
}

template <int D>
bool FacetTree<D>::is_inside(const DVec<D>& point) const {
    const Vec<D> place(point);
    bool inside = false;
    object_tree_.each_overlapping(Aabb<D>{place, place}, [&](std::uint32_t i) {
        inside = contains(objects_[i].shape, place);
        return !inside;
    });
    return inside;
}

template class FacetTree<2>;
template class FacetTree<3>;

}  // namespace abut::tool
