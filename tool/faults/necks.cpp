#include "tool/faults/necks.hpp"

#include <abut/abut.hpp>
#include <abut/math/dvec.hpp>
#include <abut/math/union_find.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace abut::tool {

using namespace detail;

namespace {

// Tolerances relative to the width. Penetration of a surface into the ball of a neck.
constexpr double ball_tolerance = 1e-3;
// Deviation in direction and width of necks that count as translates of one another.
constexpr double translate_tolerance = 1e-3;
// Maximum distance of their sets of midpoints.
constexpr double max_offset = 0.5;

// All necks between two facets.
template <int D>
struct FacetNecks {
    std::size_t a = 0, b = 0;  // facets
    FacetGap<D> facing;
    std::vector<DVec<D>> free;  // some unobstructed midpoints
};

template <int D>
class NeckSearch {
public:
    NeckSearch(const FacetTree<D>& facets, const GapOptions<D>& options) : facets_(facets), options_(options) {}

    std::vector<Neck<D>> all();

private:
    bool can_face(std::size_t i, std::size_t j) const;
    bool is_partly_in_front(std::size_t i, std::size_t j) const;
    std::optional<FacetNecks<D>> facet_necks(std::size_t i, std::size_t j) const;
    bool is_in_front(const DVec<D>& end, const DVec<D>& outwards, std::uint32_t object, double width) const;
    bool is_free(const DVec<D>& middle, const FacetNecks<D>& facet_necks) const;
    bool is_buried(const DVec<D>& point) const;
    bool are_translates(const FacetNecks<D>& a, const FacetNecks<D>& b) const;
    Neck<D> neck_of(const std::vector<std::size_t>& group) const;

    const FacetTree<D>& facets_;
    const GapOptions<D>& options_;
    std::vector<FacetNecks<D>> facet_necks_;
};

// True if a vertex of the second facet is in front of the first one, or next to it at its boundary.
template <int D>
bool NeckSearch<D>::is_partly_in_front(std::size_t i, std::size_t j) const {
    const PlacedFacet<D>&facet = facets_[i], &other = facets_[j];
    if (facet.two_sided) return true;
    const double margin = 0.01 * options_.min_width,
                 min_height = facet.has_boundary && other.has_boundary ? -margin : margin;
    const double height = dot(facet.front, DVec<D>(corners<D>(facet.shape)[0]));
    for (const Vec<D>& corner : corners<D>(other.shape))
        if (dot(facet.front, DVec<D>(corner)) - height > min_height) return true;
    return false;
}

template <int D>
bool NeckSearch<D>::can_face(std::size_t i, std::size_t j) const {
    if (options_.is_selected && !options_.is_selected(facets_[i].object, facets_[j].object)) return false;
    return is_partly_in_front(i, j) && is_partly_in_front(j, i);
}

// Several facets of an object may share the end of a neck: the one with the largest absolute cosine to the neck's
// direction decides.
template <int D>
bool NeckSearch<D>::is_in_front(const DVec<D>& end, const DVec<D>& outwards, std::uint32_t object, double width) const {
    double max_cosine = 0;
    bool two_sided = false;
    facets_.each_within(end, ball_tolerance * width, [&](std::uint32_t i) {
        const PlacedFacet<D>& facet = facets_[i];
        if (facet.object != object) return;
        two_sided = two_sided || facet.two_sided;
        const double cosine = dot(facet.front, outwards);
        if (std::abs(cosine) > std::abs(max_cosine) ||
            (std::abs(cosine) == std::abs(max_cosine) && cosine > max_cosine))
            max_cosine = cosine;
    });
    return two_sided || max_cosine > -ball_tolerance;
}

// True if the first surface above the point is an open one and is seen from behind: the point is below a ground.
template <int D>
bool NeckSearch<D>::is_buried(const DVec<D>& point) const {
    if (!options_.up) return false;
    const auto above = facets_.first_hit(point, *options_.up, std::numeric_limits<double>::infinity());
    return above && above->from_behind && !facets_[above->facet].two_sided;
}

template <int D>
bool NeckSearch<D>::is_free(const DVec<D>& middle, const FacetNecks<D>& facet_necks) const {
    const FacetGap<D>& facing = facet_necks.facing;
    const double half = 0.5 * facing.width;
    if (facets_.has_within(middle, half * (1 - ball_tolerance))) return false;
    if (!is_in_front(middle - facing.across * half, facing.across, facets_[facet_necks.a].object, facing.width) ||
        !is_in_front(middle + facing.across * half, -facing.across, facets_[facet_necks.b].object, facing.width))
        return false;
    return !facets_.is_inside(middle) && !is_buried(middle);
}

template <int D>
std::optional<FacetNecks<D>> NeckSearch<D>::facet_necks(std::size_t i, std::size_t j) const {
    std::optional<FacetGap<D>> facing =
        tool::facet_gap<D>(facets_[i].shape, facets_[j].shape, options_.min_width, options_.width);
    if (!facing) return std::nullopt;
    FacetNecks<D> result{i, j, *std::move(facing), {}};
    const DVec<D>& centroid = result.facing.centroid;
    if (is_free(centroid, result)) result.free.push_back(centroid);
    if (result.facing.midpoints.size() > 1 && result.free.empty())
        for (const DVec<D>& corner : result.facing.midpoints)
            if (const DVec<D> between = (corner + centroid) * 0.5; is_free(between, result))
                result.free.push_back(between);
    return result.free.empty() ? std::nullopt : std::optional(std::move(result));
}

template <int D>
bool NeckSearch<D>::are_translates(const FacetNecks<D>& a, const FacetNecks<D>& b) const {
    const FacetGap<D>&first = a.facing, &second = b.facing;
    if (std::abs(first.width - second.width) > translate_tolerance * first.width) return false;
    if (std::abs(dot(first.across, second.across)) < 1 - 0.5 * translate_tolerance * translate_tolerance) return false;
    const auto set_of = [](const FacetGap<D>& facing) {
        std::vector<Vec<D>> points;
        for (const DVec<D>& middle : facing.midpoints) points.push_back(Vec<D>(middle));
        return points;
    };
    const std::vector<Vec<D>> set_a = set_of(first), set_b = set_of(second);
    const auto hull = [](const std::vector<Vec<D>>& points) {
        Convex<D> convex;
        convex.core = Core::points;
        convex.points = points.data();
        convex.count = static_cast<std::uint32_t>(points.size());
        return convex;
    };
    return static_cast<double>(closest(hull(set_a), hull(set_b)).distance) <= max_offset * first.width;
}

// The principal axes of points, perpendicular to a direction.
std::array<DVec<2>, 1> axes_of(const std::vector<DVec<2>>&, const DVec<2>&, const DVec<2>& across) {
    return {perpendicular(across)};
}
std::array<DVec<3>, 2> axes_of(const std::vector<DVec<3>>& points, const DVec<3>& middle, const DVec<3>& across) {
    const DVec<3> x = perpendicular(across), y = cross(across, x);
    double xx = 0, xy = 0, yy = 0;
    for (const DVec<3>& point : points) {
        const double u = dot(point - middle, x), v = dot(point - middle, y);
        xx += u * u;
        xy += u * v;
        yy += v * v;
    }
    const double half_difference = 0.5 * (xx - yy), root = std::sqrt(half_difference * half_difference + xy * xy);
    // The eigenvector of the larger eigenvalue, from the row that doesn't vanish.
    const DVec<2> main =
        normalized(half_difference >= 0 ? DVec<2>(half_difference + root, xy) : DVec<2>(xy, root - half_difference));
    return {x * main.x + y * main.y, y * main.x - x * main.y};
}

template <int D>
Neck<D> NeckSearch<D>::neck_of(const std::vector<std::size_t>& group) const {
    // Sets with an area are weighted by it; others by their extent.
    DVec<D> weighted(0.0), unweighted(0.0);
    double total = 0;
    std::vector<DVec<D>> points, free;
    for (const std::size_t i : group) {
        const FacetNecks<D>& facet_necks = facet_necks_[i];
        double reach = 0;
        for (const DVec<D>& middle : facet_necks.facing.midpoints)
            reach = std::max(reach, length(middle - facet_necks.facing.centroid));
        double weight = reach;
        if constexpr (D == 3) {
            const std::vector<DVec<3>>& m = facet_necks.facing.midpoints;
            weight = 0;
            for (std::size_t k = 2; k < m.size(); ++k) weight += length(cross(m[k - 1] - m[0], m[k] - m[0]));
        }
        weighted += facet_necks.facing.centroid * weight;
        unweighted += facet_necks.facing.centroid;
        total += weight;
        points.insert(points.end(), facet_necks.facing.midpoints.begin(), facet_necks.facing.midpoints.end());
        free.insert(free.end(), facet_necks.free.begin(), facet_necks.free.end());
    }
    const FacetNecks<D>& narrowest =
        facet_necks_[*std::min_element(group.begin(), group.end(), [&](std::size_t i, std::size_t j) {
            return facet_necks_[i].facing.width < facet_necks_[j].facing.width;
        })];
    const DVec<D> middle = total > 0 ? weighted / total : unweighted / static_cast<double>(group.size());
    Neck<D> neck{facets_[narrowest.a].object,
                 facets_[narrowest.b].object,
                 narrowest.facing.across,
                 narrowest.facing.width,
                 middle,
                 axes_of(points, middle, narrowest.facing.across)};
    // The common midpoint may be obstructed or lie beside the facets.
    const double half = 0.5 * neck.width;
    const auto is_neck = [&](const DVec<D>& place) {
        return facets_.has_within(place - neck.across * half, ball_tolerance * neck.width) &&
               facets_.has_within(place + neck.across * half, ball_tolerance * neck.width) && is_free(place, narrowest);
    };
    if (is_neck(middle)) return neck;
    const auto nearer = [&](const DVec<D>& a, const DVec<D>& b) {
        return length_squared(a - middle) < length_squared(b - middle);
    };
    neck.middle = *std::min_element(free.begin(), free.end(), nearer);
    return neck;
}

template <int D>
std::vector<Neck<D>> NeckSearch<D>::all() {
    const auto half_width = static_cast<float>(0.5 * options_.width);
    std::vector<Aabb<D>> boxes;
    for (std::size_t i = 0; i < facets_.size(); ++i) boxes.push_back(grown(facets_.box(i), half_width));
    Bvh<D> tree;
    tree.build(boxes);
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        if (i > j) std::swap(i, j);
        if (!can_face(i, j)) return;
        if (std::optional<FacetNecks<D>> found = facet_necks(i, j)) facet_necks_.push_back(*std::move(found));
    });
    std::sort(facet_necks_.begin(), facet_necks_.end(),
              [](const FacetNecks<D>& a, const FacetNecks<D>& b) { return std::pair(a.a, a.b) < std::pair(b.a, b.b); });

    boxes.clear();
    for (const FacetNecks<D>& facet_necks : facet_necks_) {
        Aabb<D> box = Aabb<D>::empty();
        for (const DVec<D>& middle : facet_necks.facing.midpoints)
            box = merged(box, Aabb<D>{Vec<D>(middle), Vec<D>(middle)});
        boxes.push_back(grown(box, static_cast<float>(0.5 * max_offset * facet_necks.facing.width)));
    }
    tree.build(boxes);
    UnionFind groups(facet_necks_.size());
    tree.each_pair([&](std::uint32_t i, std::uint32_t j) {
        if (groups.find(i) != groups.find(j) && are_translates(facet_necks_[i], facet_necks_[j])) groups.unite(i, j);
    });
    std::vector<Neck<D>> result;
    for (const std::vector<std::size_t>& group : groups.all()) result.push_back(neck_of(group));
    return result;
}

}  // namespace

template <int D>
std::vector<Neck<D>> find_necks(const FacetTree<D>& facets, const GapOptions<D>& options) {
    return NeckSearch<D>(facets, options).all();
}

template std::vector<Neck<2>> find_necks(const FacetTree<2>&, const GapOptions<2>&);
template std::vector<Neck<3>> find_necks(const FacetTree<3>&, const GapOptions<3>&);

}  // namespace abut::tool
