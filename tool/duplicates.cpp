#include "duplicates.hpp"

#include <abut/broad_phase/bvh.hpp>
#include <abut/math/groups.hpp>

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

// Sorted corners are the same for all turns.
template <int D>
std::vector<Facet<D>> sorted_facets(const std::vector<Facet<D>>& facets) {
    std::vector<Facet<D>> result = facets;
    for (Facet<D>& facet : result) std::sort(facet.begin(), facet.end());
    std::sort(result.begin(), result.end());
    return result;
}

// The same for all facets with the same corners in the same turn: the lowest corner first. A segment has but one
// order in each turn.
Facet<2> lowest_first(const Facet<2>& facet) {
    return facet;
}
Facet<3> lowest_first(Facet<3> facet) {
    std::rotate(facet.begin(), std::min_element(facet.begin(), facet.end()), facet.end());
    return facet;
}

template <int D>
Vec<D> middle(const Surface<D>& surface, const Facet<D>& facet) {
    Vec<D> sum{};
    for (const std::uint32_t corner : facet) sum += surface.points[corner] / static_cast<float>(D);
    return sum;
}

// Each point of a with its like among those of b, the nearest one; nothing where one has none, or shares it.
template <int D>
std::optional<std::vector<std::uint32_t>> likes(const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b,
                                                float tolerance, float& apart) {
    std::vector<Aabb<D>> boxes;
    boxes.reserve(b.size());
    for (const Vec<D>& p : b) boxes.push_back({p, p});
    Bvh<D> tree;
    tree.build(boxes);
    constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> result;
    std::vector<bool> taken(b.size());
    for (const Vec<D>& p : a) {
        std::uint32_t like = none;
        float least = std::numeric_limits<float>::infinity();
        tree.each_overlapping(grown(Aabb<D>{p, p}, tolerance), [&](std::uint32_t i) {
            const float distance = glm::distance(p, b[i]);
            if (distance > tolerance || distance > least || (distance == least && i > like)) return;
            least = distance;
            like = i;
        });
        if (like == none || taken[like]) return std::nullopt;
        taken[like] = true;
        apart = std::max(apart, least);
        result.push_back(like);
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

// Of convex bodies, whose corners are all there is to them.
template <int D>
std::optional<float> apart(const std::vector<Vec<D>>& a, const std::vector<Vec<D>>& b, float tolerance) {
    float distance = 0;
    if (a.size() != b.size() || !likes(a, b, tolerance, distance)) return std::nullopt;
    return distance;
}

template <int D>
void find_copies(const std::vector<StandingObject<D>>& objects, float tolerance, std::vector<CopyGroup<D>>& out) {
    std::vector<Aabb<D>> boxes;
    for (const StandingObject<D>& object : objects) boxes.push_back(object.box);
    Bvh<D> tree;
    tree.build(boxes);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    tree.sorted_pairs(pairs);
    Groups groups(objects.size());
    std::map<std::size_t, float> farthest;  // by the second of a pair
    for (const auto& [i, j] : pairs) {
        const StandingObject<D>&a = objects[i], &b = objects[j];
        const float allowed = tolerance * std::min(a.radius, b.radius);
        // Boxes of turned shapes may be a little wide.
        if (!are_near(a.box, b.box, 2 * allowed) || groups.lowest(i) == groups.lowest(j)) continue;
        const std::optional<float> distance = a.convex && b.convex ? apart(a.surface.points, b.surface.points, allowed)
                                                                   : apart(a.surface, b.surface, allowed);
        if (!distance) continue;
        groups.join(i, j);
        farthest[j] = std::max(farthest[j], *distance);
    }
    for (std::vector<std::size_t>& members : groups.all(2)) {
        CopyGroup<D> group;
        group.position = center(objects[members.front()].box);
        for (const std::size_t member : members)
            if (const auto found = farthest.find(member); found != farthest.end())
                group.apart = std::max(group.apart, found->second);
        group.objects = std::move(members);
        out.push_back(std::move(group));
    }
}

template <int D>
DoubledFacets<D> doubled_facets(const Surface<D>& surface) {
    std::vector<std::pair<Facet<D>, std::uint32_t>> all;
    for (std::uint32_t i = 0; i < surface.facets.size(); ++i) {
        Facet<D> facet = lowest_first(surface.facets[i]);
        if (surface.is_two_sided(i)) std::sort(facet.begin(), facet.end());
        all.emplace_back(facet, i);
    }
    std::sort(all.begin(), all.end());
    DoubledFacets<D> result;
    result.first = std::numeric_limits<std::uint32_t>::max();
    for (std::size_t i = 1; i < all.size(); ++i) {
        if (all[i].first != all[i - 1].first) continue;
        ++result.count;
        result.first = std::min(result.first, all[i].second);
    }
    if (result.count > 0) result.position = middle(surface, surface.facets[result.first]);
    return result;
}

}  // namespace

template <int D>
std::optional<float> apart(const Surface<D>& a, const Surface<D>& b, float tolerance) {
    if (a.points.size() != b.points.size() || a.facets.size() != b.facets.size()) return std::nullopt;
    float distance = 0;
    const std::optional<std::vector<std::uint32_t>> like = likes(a.points, b.points, tolerance, distance);
    if (!like) return std::nullopt;
    std::vector<Facet<D>> named_alike = a.facets;
    for (Facet<D>& facet : named_alike)
        for (std::uint32_t& corner : facet) corner = (*like)[corner];
    if (sorted_facets<D>(named_alike) != sorted_facets<D>(b.facets)) return std::nullopt;
    return distance;
}

template <int D>
Duplicates<D> find_duplicates(const std::vector<StandingObject<D>>& objects, float tolerance) {
    Duplicates<D> result;
    find_copies(objects, tolerance, result.groups);
    std::map<std::size_t, std::pair<std::size_t, std::size_t>> first_and_count;  // by model
    for (std::size_t i = 0; i < objects.size(); ++i)
        ++first_and_count.try_emplace(objects[i].model, i, 0).first->second.second;
    for (const auto& [model, objects_of] : first_and_count) {
        DoubledFacets<D> doubled = doubled_facets(objects[objects_of.first].surface);
        if (doubled.count == 0) continue;
        doubled.object = objects_of.first;
        doubled.objects = objects_of.second;
        result.facets.push_back(doubled);
    }
    std::sort(result.facets.begin(), result.facets.end(),
              [](const auto& a, const auto& b) { return a.object < b.object; });
    return result;
}

template std::optional<float> apart(const Surface<2>&, const Surface<2>&, float);
template std::optional<float> apart(const Surface<3>&, const Surface<3>&, float);
template Duplicates<2> find_duplicates(const std::vector<StandingObject<2>>&, float);
template Duplicates<3> find_duplicates(const std::vector<StandingObject<3>>&, float);

}  // namespace abut::tool
