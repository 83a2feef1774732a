#include "tool/faults/duplicates.hpp"

#include <abut/broad_phase/bvh.hpp>
#include <abut/math/union_find.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <glm/geometric.hpp>

namespace abut::tool {
namespace {

template <int D>
using Facet = typename Surface<D>::Facet;

// Sorts vertices, so that the orientation doesn't matter.
template <int D>
std::vector<Facet<D>> sorted_facets(const std::vector<Facet<D>>& facets) {
    std::vector<Facet<D>> result = facets;
    for (Facet<D>& facet : result) std::sort(facet.begin(), facet.end());
    std::sort(result.begin(), result.end());
    return result;
}

// A canonical form of facets with equal orientation: the lowest vertex first. A segment is canonical already.
Facet<2> canonical(const Facet<2>& facet) {
    return facet;
}
Facet<3> canonical(Facet<3> facet) {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
}

template <int D>
Vec<D> centroid(const Surface<D>& surface, const Facet<D>& facet) {
    Vec<D> sum{};
    for (const std::uint32_t corner : facet) sum += surface.points[corner] / static_cast<float>(D);
    return sum;
}

// Maps each point of `a` to its nearest point of `b`; nothing if one has none within the tolerance, or two share one.
template <int D>
std::optional<std::vector<std::uint32_t>> match_points(const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b,
                                                       float tolerance, float& max_distance) {
    std::vector<Aabb<D>> boxes;
    boxes.reserve(b.size());
    for (const Vec<D>& p : b) boxes.push_back({p, p});
    Bvh<D> tree;
    tree.build(boxes);
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> result;
    std::vector<bool> used(b.size());
    for (const Vec<D>& p : a) {
        std::uint32_t match = none;
        float min_distance = std::numeric_limits<float>::infinity();
        tree.each_overlapping(grown(Aabb<D>{p, p}, tolerance), [&](std::uint32_t i) {
            const float distance = glm::distance(p, b[i]);
            if (distance > tolerance || distance > min_distance || (distance == min_distance && i > match)) return;
            min_distance = distance;
            match = i;
        });
        if (match == none || used[match]) return std::nullopt;
        used[match] = true;
        max_distance = std::max(max_distance, min_distance);
        result.push_back(match);
    }
    return result;
}

template <int D>
bool are_near(const Aabb<D>& a, const Aabb<D>& b, float tolerance) {
    bool near = true;
    for (int i = 0; i < D; ++i)
        near = near && std::abs(a.min[i] - b.min[i]) <= tolerance && std::abs(a.max[i] - b.max[i]) <= tolerance;
    return near;
}

// For convex bodies, which their vertices determine.
template <int D>
std::optional<float> surface_distance(const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b, float tolerance) {
    float distance = 0;
    if (a.size() != b.size() || !match_points(a, b, tolerance, distance)) return std::nullopt;
    return distance;
}

template <int D>
void find_copies(const std::vector<ViewedObject<D>>& objects, float tolerance, std::vector<CopyGroup<D>>& out) {
    // Copies have the same low corner. Few others do, while all of a level may overlap.
    std::vector<Aabb<D>> corners;
    for (const ViewedObject<D>& object : objects) corners.push_back({object.box.min, object.box.min});
    Bvh<D> tree;
    tree.build(corners);
    detail::UnionFind groups(objects.size());
    std::map<std::size_t, float> max_distances;  // by the second object of a pair
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < objects.size(); ++i) {
        near.clear();
        tree.each_overlapping(grown(corners[i], 2 * tolerance * objects[i].radius), [&](std::uint32_t j) {
            if (j > i) near.push_back(j);
        });
        std::sort(near.begin(), near.end());
        for (const std::uint32_t j : near) {
            const ViewedObject<D>&a = objects[i], &b = objects[j];
            const float allowed = tolerance * std::min(a.radius, b.radius);
            // Boxes of rotated shapes may be slightly too large.
            if (!are_near(a.box, b.box, 2 * allowed) || groups.find(i) == groups.find(j)) continue;
            const std::optional<float> distance = a.convex && b.convex
                                                      ? surface_distance(a.surface.points, b.surface.points, allowed)
                                                      : surface_distance(a.surface, b.surface, allowed);
            if (!distance) continue;
            groups.unite(i, j);
            max_distances[j] = std::max(max_distances[j], *distance);
        }
    }
    for (std::vector<std::size_t>& members : groups.all(2)) {
        CopyGroup<D> group;
        group.position = center(objects[members.front()].box);
        for (const std::size_t member : members)
            if (const auto found = max_distances.find(member); found != max_distances.end())
                group.apart = std::max(group.apart, found->second);
        group.objects = std::move(members);
        out.push_back(std::move(group));
    }
}

template <int D>
DuplicateFacets<D> duplicate_facets(const Surface<D>& surface) {
    std::vector<std::pair<Facet<D>, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < surface.facets.size(); ++i) {
        Facet<D> facet = canonical(surface.facets[i]);
        if (surface.is_two_sided(i)) std::sort(facet.begin(), facet.end());
        all.emplace_back(facet, i);
    }
    std::sort(all.begin(), all.end());
    DuplicateFacets<D> result;
    result.first = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].first != all[i - 1].first) continue;
        ++result.count;
        result.first = std::min(result.first, all[i].second);
    }
    if (result.count > 0) result.position = centroid(surface, surface.facets[result.first]);
    return result;
}

}  // namespace

template <int D>
std::optional<float> surface_distance(const Surface<D>& a, const Surface<D>& b, float tolerance) {
    if (a.points.size() != b.points.size() || a.facets.size() != b.facets.size()) return std::nullopt;
    float distance = 0;
    const std::optional<std::vector<std::uint32_t>> match = match_points(a.points, b.points, tolerance, distance);
    if (!match) return std::nullopt;
    std::vector<Facet<D>> renamed = a.facets;
    for (Facet<D>& facet : renamed)
        for (std::uint32_t& corner : facet) corner = (*match)[corner];
    if (sorted_facets<D>(renamed) != sorted_facets<D>(b.facets)) return std::nullopt;
    return distance;
}

template <int D>
Duplicates<D> find_duplicates(const std::vector<ViewedObject<D>>& objects, float tolerance) {
    Duplicates<D> result;
    find_copies(objects, tolerance, result.groups);
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> first_and_count;  // by model
    for (std::size_t i = 0; i < objects.size(); ++i)
        ++first_and_count.try_emplace(objects[i].model, i, 0).first->second.second;
    for (const auto& [model, objects_of] : first_and_count) {
        DuplicateFacets<D> duplicate = duplicate_facets(objects[objects_of.first].surface);
        if (duplicate.count == 0) continue;
        duplicate.object = objects_of.first;
        duplicate.objects = objects_of.second;
        result.facets.push_back(duplicate);
    }
    std::sort(result.facets.begin(), result.facets.end(),
              [](const auto& a, const auto& b) { return a.object < b.object; });
    return result;
}

template std::optional<float> surface_distance(const Surface<2>&, const Surface<2>&, float);
template std::optional<float> surface_distance(const Surface<3>&, const Surface<3>&, float);
template Duplicates<2> find_duplicates(const std::vector<ViewedObject<2>>&, float);
template Duplicates<3> find_duplicates(const std::vector<ViewedObject<3>>&, float);

}  // namespace abut::tool
